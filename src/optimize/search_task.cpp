#include "optimize/search_task.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <map>

#include "optimize/drive.hpp"
#include "optimize/least_squares.hpp"
#include "optimize/stage_task.hpp"

namespace formotion {
namespace {

constexpr double kBroken = 1e3;  // all merits of unwanted candidates lie above all others'

// Scores candidates and keeps them, everything once.
class Recorder {
 public:
  Recorder(const Problem& problem, const SearchTask& task, const std::atomic<bool>& stop)
      : problem_(problem),
        task_(task),
        stop_(stop),
        objectives_(problem.objectives().begin(), problem.objectives().end()),
        memory_(problem.memory()) {}

  const Score& score(const Candidate& candidate) {
    if (stop_.load(std::memory_order_relaxed)) throw SearchStopped();
    const auto [known, is_new] = known_.try_emplace(candidate.values, trials_.size());
    if (is_new) trials_.push_back({candidate, scored(candidate)});
    return trials_[known->second].score;
  }
  double operator()(const Candidate& candidate) { return task_.merit(score(candidate), objectives_); }

  std::vector<Trial> take() { return std::move(trials_); }

 private:
  Score scored(const Candidate& candidate) {
    try {
      return problem_.score(candidate, memory_.get());
    } catch (const std::exception& error) { return failed_score(Failure::Error, error.what(), objectives_.size()); }
  }

  const Problem& problem_;
  const SearchTask& task_;
  const std::atomic<bool>& stop_;
  std::vector<Objective> objectives_;
  std::unique_ptr<Memory> memory_;
  std::map<std::vector<double>, std::size_t> known_;  // values -> place in trials_; a task stays in one topology
  std::vector<Trial> trials_;
};

}  // namespace

const char* name(Driver driver) {
  switch (driver) {
    case Driver::Spread:
      return "spread points";
    case Driver::DirectL:
      return "DIRECT-L";
    case Driver::Crs2:
      return "CRS2";
    case Driver::Sbplx:
      return "SBPLX";
    case Driver::Listed:
      return "listed";
    case Driver::LeastSquares:
      return "least squares";
  }
  return "";
}

double Merit::operator()(const Score& score, const std::vector<Objective>& objectives) const {
  double broken = 0;
  for (std::size_t k = 0; k < objectives.size(); ++k) {
    if (!at_most[k]) continue;
    broken += std::max(0.0, objectives[k].loss(score.objectives[k]) - *at_most[k]) / scale[k];
  }
  if (!score.feasible || broken > 0) return kBroken + score.violation + broken;
  return objectives[focus].loss(score.objectives[focus]) / scale[focus];
}

TaskResult run_task(const Problem& problem, const SearchTask& task, const std::atomic<bool>& stop) {
  if (task.stage) return {{}, run_stage_task(*problem.staged(), task, stop)};
  Recorder record(problem, task, stop);
  if (task.driver == Driver::LeastSquares) {
    fit(problem, task, [&](const Candidate& candidate) { return record.score(candidate); });
    return {record.take(), {}};
  }
  drive(DesignSpace(problem, task.topology), task, [&](const Candidate& candidate) { return record(candidate); });
  return {record.take(), {}};
}

}  // namespace formotion
