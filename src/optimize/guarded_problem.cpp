#include "optimize/guarded_problem.hpp"

namespace formotion {
namespace {

class GuardedStages final : public StagedProblem {
 public:
  GuardedStages(const StagedProblem& stages, const Quarantine& quarantine, CrashMarks* marks)
      : stages_(stages), quarantine_(quarantine), marks_(marks) {}

  std::span<const StageState> states() const override { return stages_.states(); }
  std::span<const StageKind> kinds() const override { return stages_.kinds(); }
  std::span<const StageUse> stages(int topology) const override { return stages_.stages(topology); }
  const std::vector<std::vector<int>>& goals() const override { return stages_.goals(); }
  std::vector<std::vector<double>> starts(int kind) const override { return stages_.starts(kind); }
  std::vector<double> objectives(const Composition& composition) const override {
    return stages_.objectives(composition);
  }
  std::optional<std::size_t> tolerance_objective() const override { return stages_.tolerance_objective(); }
  std::optional<double> displacement_mm(int kind, std::span<const double> half_widths) const override {
    return stages_.displacement_mm(kind, half_widths);
  }

  StageResult pass(int kind, std::span<const double> values) const override {
    StageResult failed;
    failed.violation = kFailedViolation;
    failed.ends.resize(states().size());
    return guarded(kind, values, failed, [&] { return stages_.pass(kind, values); });
  }
  StageTolerance tolerance(int kind, std::span<const double> values, const StageResult& result,
                           const StageDemand& demanded, double at_most_mm) const override {
    return guarded(kind, values, StageTolerance{},
                   [&] { return stages_.tolerance(kind, values, result, demanded, at_most_mm); });
  }
  bool bears(int kind, std::span<const double> values, int state, bool kept, double error_mm,
             std::int64_t& work) const override {
    return guarded(kind, values, false, [&] { return stages_.bears(kind, values, state, kept, error_mm, work); });
  }

 private:
  template <class Result, class Work>
  Result guarded(int kind, std::span<const double> values, const Result& failed, const Work& work) const {
    const Subject subject{true, kind, {values.begin(), values.end()}};
    if (quarantine_.find(subject)) return failed;
    const CrashMarks::Scoring scoring(marks_, subject);
    return work();
  }

  const StagedProblem& stages_;
  const Quarantine& quarantine_;
  CrashMarks* marks_;
};

// Pieces crash on behalf of the candidate at which they were taken.
class GuardedPieces final : public SmoothPieces {
 public:
  GuardedPieces(std::unique_ptr<SmoothPieces> pieces, Subject subject, CrashMarks* marks)
      : pieces_(std::move(pieces)), subject_(std::move(subject)), marks_(marks) {}
  int residuals() const override { return pieces_->residuals(); }
  bool lasts(int residual) const override { return pieces_->lasts(residual); }
  int steps() const override { return pieces_->steps(); }
  bool evaluate(std::span<const double> values, double* residuals, double* jacobian) const override {
    const CrashMarks::Scoring scoring(marks_, subject_);
    return pieces_->evaluate(values, residuals, jacobian);
  }

 private:
  std::unique_ptr<SmoothPieces> pieces_;
  Subject subject_;
  CrashMarks* marks_;
};

class GuardedSmooth final : public SmoothProblem {
 public:
  GuardedSmooth(const SmoothProblem& smooth, const Quarantine& quarantine, CrashMarks* marks)
      : smooth_(smooth), quarantine_(quarantine), marks_(marks) {}
  std::unique_ptr<SmoothPieces> pieces(const Candidate& candidate, const SmoothAim& aim) const override {
    const Subject subject{false, candidate.topology, candidate.values};
    if (quarantine_.find(subject)) return nullptr;
    const CrashMarks::Scoring scoring(marks_, subject);
    std::unique_ptr<SmoothPieces> pieces = smooth_.pieces(candidate, aim);
    return pieces ? std::make_unique<GuardedPieces>(std::move(pieces), subject, marks_) : nullptr;
  }

 private:
  const SmoothProblem& smooth_;
  const Quarantine& quarantine_;
  CrashMarks* marks_;
};

}  // namespace

GuardedProblem::GuardedProblem(const Problem& problem, const Quarantine& quarantine, CrashMarks* marks)
    : problem_(problem), quarantine_(quarantine), marks_(marks) {
  if (problem.staged()) staged_ = std::make_unique<GuardedStages>(*problem.staged(), quarantine, marks);
  if (problem.smooth()) smooth_ = std::make_unique<GuardedSmooth>(*problem.smooth(), quarantine, marks);
}

GuardedProblem::~GuardedProblem() = default;

Score GuardedProblem::score(const Candidate& candidate, Memory* memory) const {
  const Subject subject{false, candidate.topology, candidate.values};
  if (const Incident* incident = quarantine_.find(subject))
    return failed_score(incident->failure, incident->text, objectives().size());
  const CrashMarks::Scoring scoring(marks_, subject);
  return problem_.score(candidate, memory);
}

const StagedProblem* GuardedProblem::staged() const { return staged_.get(); }

const SmoothProblem* GuardedProblem::smooth() const { return smooth_.get(); }

}  // namespace formotion
