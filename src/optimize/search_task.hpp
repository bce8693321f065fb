// One driver's run: a pure function from a task to the candidates, or the stages, that it tried.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "optimize/stage_pool.hpp"
#include "problem/problem.hpp"

namespace formotion {

// What a driver minimises: candidates that are infeasible or break a bound on an objective rank behind all others, by
// the sum of what they lack; the others rank by one objective (epsilon constraints, Haimes 1971: weighted sums miss the
// front's hollows).
struct Merit {
  std::size_t focus = 0;                       // the objective that is improved
  std::vector<std::optional<double>> at_most;  // per objective: the largest allowed loss
  std::vector<double> scale;                   // per objective: what counts as one unit
  double operator()(const Score& score, const std::vector<Objective>& objectives) const;
};

enum class Driver {
  Spread,        // low-discrepancy points, evaluated one by one
  DirectL,       // NLopt GN_DIRECT_L: global scan, deterministic
  Crs2,          // NLopt GN_CRS2_LM: global, from a random population
  Sbplx,         // NLopt LN_SBPLX: local, bears jumps
  Listed,        // given candidates, one by one
  LeastSquares,  // Ceres: local, on residuals with derivatives
};
const char* name(Driver driver);

// What a search for a stage minimises: of the stages that keep `keep` and lose `lose`, minus the tolerance of both, or
// (if length_weight is positive) that and length_weight a millimetre of length.
struct StageAim {
  int kind = 0;
  std::vector<int> keep, lose;  // states; both empty: any stage is of interest
  double length_weight = 0;
};

struct SearchTask {
  Driver driver = Driver::Spread;
  std::optional<StageAim> stage;  // then it searches a kind of stage, and topology means nothing
  int topology = 0;
  std::int64_t evaluations = 0;  // at most
  std::uint64_t seed = 0;
  std::uint64_t first_point = 0;   // Spread: the sequence's index to begin with
  std::optional<Candidate> start;  // Sbplx, LeastSquares; of a stage: its values
  std::vector<Candidate> listed;   // Listed
  double step = 0.1;               // Sbplx: first step, as a fraction of every range
  Merit merit;
  std::string provenance;
};

struct Trial {
  Candidate candidate;
  Score score;
};

struct SearchStopped {};  // thrown out of a task when it was told to stop: its trials are lost

struct TaskResult {
  std::vector<Trial> trials;
  std::vector<StageTrial> stages;  // of a task that searches stages
};

// Runs the task on this thread: what it tried, in that order, everything once. A pure function of problem and task.
// NLopt's random numbers are per thread and seeded here.
TaskResult run_task(const Problem& problem, const SearchTask& task, const std::atomic<bool>& stop);

}  // namespace formotion
