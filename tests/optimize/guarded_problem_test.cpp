#include "optimize/guarded_problem.hpp"

#include <catch2/catch.hpp>

#include "toy_problem.hpp"

using namespace formotion;

namespace {

// A problem of one kind of stage and one residual, that says what is marked while it works.
class Watched final : public Problem, public StagedProblem, public SmoothProblem {
 public:
  explicit Watched(const CrashMarks& marks) : marks_(marks) {}
  std::span<const Variable> variables() const override { return toy_.variables(); }
  std::span<const Topology> topologies() const override { return toy_.topologies(); }
  std::span<const Objective> objectives() const override { return toy_.objectives(); }
  Score score(const Candidate& candidate, Memory*) const override {
    look();
    return toy_.score(candidate);
  }
  const StagedProblem* staged() const override { return this; }
  const SmoothProblem* smooth() const override { return this; }

  std::span<const StageState> states() const override { return states_; }
  std::span<const StageKind> kinds() const override { return kinds_; }
  std::span<const StageUse> stages(int) const override { return {}; }
  const std::vector<std::vector<int>>& goals() const override { return goals_; }
  std::vector<std::vector<double>> starts(int) const override { return {}; }
  StageResult pass(int, std::span<const double>) const override {
    look();
    return {true, 0, {{0, 1, 0}, {kLostState, 2, 0}}, 10, 1};
  }
  StageTolerance tolerance(int, std::span<const double>, const StageResult&, const StageDemand&,
                           double) const override {
    look();
    return {0.5, 1};
  }
  std::optional<std::size_t> tolerance_objective() const override { return std::nullopt; }
  std::vector<double> objectives(const Composition&) const override { return {}; }
  std::optional<double> displacement_mm(int, std::span<const double>) const override { return 1; }
  bool bears(int, std::span<const double>, int, bool, double, std::int64_t&) const override {
    look();
    return true;
  }

  std::unique_ptr<SmoothPieces> pieces(const Candidate&, const SmoothAim&) const override {
    look();
    return std::make_unique<Pieces>(*this);
  }

  mutable std::vector<Subject> seen;

 private:
  struct Pieces final : SmoothPieces {
    explicit Pieces(const Watched& from) : watched(from) {}
    int residuals() const override { return 1; }
    bool lasts(int) const override { return true; }
    bool evaluate(std::span<const double>, double* residuals, double*) const override {
      watched.look();
      residuals[0] = 3;
      return true;
    }
    const Watched& watched;
  };
  void look() const {
    const std::vector<Mark> marks = marks_.marks();
    REQUIRE(marks.size() == 1);
    seen.push_back(marks[0].subject);
  }
  const CrashMarks& marks_;
  ToyProblem toy_;
  std::vector<StageState> states_{{"a", 0.5}, {"b", 0.5}};
  std::vector<StageKind> kinds_{{"kind", {{"x", 0, 1, std::nullopt}}, false}};
  std::vector<std::vector<int>> goals_{{0}};
};

// Everything that the guarded problem can be asked about this candidate and this stage.
std::vector<double> asked(const Problem& problem, const Candidate& candidate, const std::vector<double>& stage) {
  std::vector<double> answers{problem.score(candidate).objectives[0]};
  const StagedProblem& staged = *problem.staged();
  const StageResult passed = staged.pass(0, stage);
  std::int64_t work = 0;
  answers.insert(answers.end(), {double(passed.valid), passed.violation, double(passed.ends.size()),
                                 staged.tolerance(0, stage, passed, {true, true}, 1).tolerance_mm,
                                 double(staged.bears(0, stage, 0, true, 0.1, work))});
  const auto pieces = problem.smooth()->pieces(candidate, {});
  double residual = 0;
  answers.push_back(pieces && pieces->evaluate(candidate.values, &residual, nullptr));
  answers.push_back(residual);
  return answers;
}

}  // namespace

TEST_CASE("all that is computed for a candidate or a stage is marked as its own, and nothing is changed") {
  CrashMarks marks;
  const Watched problem(marks);
  const Quarantine nothing;
  const GuardedProblem guarded(problem, nothing, &marks);
  CHECK(asked(guarded, {0, {4}}, {0.5}) == std::vector<double>{0, 1, 0, 2, 0.5, 1, 1, 3});
  const Subject candidate{false, 0, {4}}, stage{true, 0, {0.5}};
  CHECK(problem.seen == std::vector<Subject>{candidate, stage, stage, stage, candidate, candidate});
  CHECK(marks.marks().empty());
}

TEST_CASE("what is quarantined is not computed, and fails in a way that nobody takes for good") {
  CrashMarks marks;
  const Watched problem(marks);
  Quarantine quarantine;
  for (int i = 0; i < Quarantine::kTimes; ++i) {
    quarantine.note({false, 0, {4}}, Failure::Crash, "why");
    quarantine.note({true, 0, {0.5}}, Failure::Crash, "why");
  }
  const GuardedProblem guarded(problem, quarantine, &marks);
  CHECK(asked(guarded, {0, {4}}, {0.5}) == std::vector<double>{0, 0, kFailedViolation, 2, 0, 0, 0, 0});
  CHECK(problem.seen.empty());
  CHECK(guarded.score({0, {4}}, nullptr).failure == Failure::Crash);
  // Others are.
  CHECK(asked(guarded, {0, {5}}, {0.25})[0] == 1);
  CHECK(problem.seen.size() == 6);
}
