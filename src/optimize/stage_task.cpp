#include "optimize/stage_task.hpp"

#include <algorithm>
#include <exception>
#include <limits>
#include <map>

#include "optimize/drive.hpp"

namespace formotion {
namespace {

constexpr double kBroken = 1e3;   // merits of stages that miss the aim lie above all others'
constexpr double kInvalid = 1e6;  // and those of invalid stages above them
constexpr double kLeastWrong_mm = 1e-3;
constexpr double kOtherState_mm = 1;  // leaving as a wrong state: no distance is known

class StageRecorder {
 public:
  StageRecorder(const StagedProblem& problem, const SearchTask& task, const std::atomic<bool>& stop)
      : problem_(problem),
        aim_(*task.stage),
        passive_(problem.kinds()[static_cast<std::size_t>(aim_.kind)].passive),
        thorough_(task.driver == Driver::Sbplx),
        stop_(stop),
        demanded_(problem.states().size(), false) {
    for (const int state : aim_.keep) demanded_[static_cast<std::size_t>(state)] = true;
    for (const int state : aim_.lose) demanded_[static_cast<std::size_t>(state)] = true;
    if (!passive_ && task.start) reference_ = passed(task.start->values);
  }

  double operator()(const std::vector<double>& values) {
    if (stop_.load(std::memory_order_relaxed)) throw SearchStopped();
    const auto [known, is_new] = merits_.try_emplace(values, 0);
    if (is_new) known->second = tried(values);
    return known->second;
  }

  std::vector<StageTrial> take() { return std::move(trials_); }

 private:
  StageResult passed(const std::vector<double>& values) const {
    try {
      return problem_.pass(aim_.kind, values);
    } catch (const std::exception&) {  // a bug that these values meet
      StageResult failed;
      failed.violation = kFailedViolation;
      failed.ends.assign(problem_.states().size(), {});
      return failed;
    }
  }

  double tried(const std::vector<double>& values) {
    StageTrial trial;
    trial.kind = aim_.kind;
    trial.values = values;
    trial.result = passed(values);
    trial.work = trial.result.work;
    const double merit = merit_of(trial);
    trials_.push_back(std::move(trial));
    return merit;
  }

  double merit_of(StageTrial& trial) {
    const StageResult& result = trial.result;
    if (const auto by = wrong(result, aim_, passive_, reference_ ? &*reference_ : nullptr)) return kBroken + *by;
    if (aim_.keep.empty() && aim_.lose.empty()) return 0;
    double bound = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < demanded_.size(); ++i) {
      if (demanded_[i]) bound = std::min(bound, result.ends[i].nominal_mm);
    }
    const double length = aim_.length_weight * result.length_mm;
    if (bound <= 0 || (!thorough_ && length - bound >= best_)) return length - bound;
    const StageTolerance found = problem_.tolerance(aim_.kind, trial.values, result, demanded_, bound);
    trial.demanded = demanded_;
    trial.tolerance_mm = found.tolerance_mm;
    trial.work += found.work;
    best_ = std::min(best_, length - found.tolerance_mm);
    return length - found.tolerance_mm;
  }

  const StagedProblem& problem_;
  const StageAim& aim_;
  const bool passive_, thorough_;
  const std::atomic<bool>& stop_;
  StageDemand demanded_;
  std::optional<StageResult> reference_;
  double best_ = std::numeric_limits<double>::infinity();
  std::map<std::vector<double>, double> merits_;
  std::vector<StageTrial> trials_;
};

}  // namespace

std::optional<double> wrong(const StageResult& result, const StageAim& aim, bool passive,
                            const StageResult* reference) {
  if (!result.valid) return kInvalid + result.violation;
  double sum = 0;
  bool any = false;
  const auto add = [&](double by) {
    any = true;
    sum += std::max(by, kLeastWrong_mm);
  };
  for (const int state : aim.keep) {
    const auto i = static_cast<std::size_t>(state);
    const StageEnd& end = result.ends[i];
    int wanted = passive ? state : end.to;
    if (!passive && reference && reference->ends[i].to >= 0) wanted = reference->ends[i].to;
    if (end.to == kStuckState)
      add(end.lacking_mm);
    else if (end.to == kLostState)
      add(end.nominal_mm);
    else if (end.to != wanted)
      add(kOtherState_mm);
  }
  for (const int state : aim.lose) {
    const StageEnd& end = result.ends[static_cast<std::size_t>(state)];
    if (end.to == kStuckState)
      add(end.lacking_mm);
    else if (end.to != kLostState)
      add(end.nominal_mm);
  }
  return any ? std::optional<double>(sum) : std::nullopt;
}

std::vector<StageTrial> run_stage_task(const StagedProblem& problem, const SearchTask& task,
                                       const std::atomic<bool>& stop) {
  StageRecorder record(problem, task, stop);
  const StageKind& kind = problem.kinds()[static_cast<std::size_t>(task.stage->kind)];
  drive(DesignSpace(kind.variables), task, [&](const Candidate& candidate) { return record(candidate.values); });
  return record.take();
}

}  // namespace formotion
