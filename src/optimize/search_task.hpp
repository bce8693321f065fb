// One driver's run: a pure function from a task to the candidates that it tried.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

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
  Spread,   // low-discrepancy points, evaluated one by one
  DirectL,  // NLopt GN_DIRECT_L: global scan, deterministic
  Crs2,     // NLopt GN_CRS2_LM: global, from a random population
  Sbplx,    // NLopt LN_SBPLX: local, bears jumps
};
const char* name(Driver driver);

struct SearchTask {
  Driver driver = Driver::Spread;
  int topology = 0;
  std::int64_t evaluations = 0;  // at most
  std::uint64_t seed = 0;
  std::uint64_t first_point = 0;   // Spread: the sequence's index to begin with
  std::optional<Candidate> start;  // Sbplx
  double step = 0.1;               // Sbplx: first step, as a fraction of every range
  Merit merit;
  std::string provenance;
};

struct Trial {
  Candidate candidate;
  Score score;
};

struct SearchStopped {};  // thrown out of a task when it was told to stop: its trials are lost

// Scores that are known already; reading it must be safe on all threads.
class KnownScores {
 public:
  virtual ~KnownScores() = default;
  virtual const Score* find(const Candidate& candidate) const = 0;
};

// Runs the task on this thread: its trials in their order. NLopt's random numbers are per thread and seeded here.
std::vector<Trial> run_task(const Problem& problem, const SearchTask& task, const KnownScores& known,
                            const std::atomic<bool>& stop);

}  // namespace formotion
