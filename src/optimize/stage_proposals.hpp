// Tasks that search single stages, and the tracks that are composed of what they found.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "optimize/random_stream.hpp"
#include "optimize/run_state.hpp"
#include "optimize/stage_demands.hpp"

namespace formotion {

// How far the search for a demand has come.
struct DemandEffort {
  std::int64_t trials = 0, since_best = 0;
  double best_mm = 0;  // 0: no stage does what it asks
};

class StageProposals {
 public:
  // The problem is staged, with at most kMostStates states.
  StageProposals(const Problem& problem, const RunState& state, RandomStream& random);

  // Every kind: starting shapes and spread points, without a tolerance.
  void scan(std::int64_t evaluations, std::uint64_t seed);
  // Tasks for demands that are worth it; returns the evaluations that are left over.
  std::int64_t search(std::int64_t evaluations, std::int64_t evaluations_each);
  // Composed tracks that would be on the front, and for topologies without feasible designs the best guesses. Returns
  // how many.
  std::int64_t list(std::size_t most);

  // Topologies with composed tracks, the most tolerant first.
  std::vector<int> ranked() const;

  std::vector<SearchTask> take() { return std::move(tasks_); }

 private:
  void read_efforts();
  std::vector<StageChoice> capped_guesses() const;
  std::vector<Demand> wishes(const ComposedTracks& tracks, const std::vector<StageChoice>& choices) const;
  const StageKind& kind(int k) const { return staged_.kinds()[static_cast<std::size_t>(k)]; }
  std::string told(const Demand& demand, bool shorter) const;
  bool exhausted(const Demand& demand, bool shorter) const;
  bool length_matters(int kind) const;
  SearchTask& add(Driver driver, int kind, std::int64_t evaluations, const std::string& what);
  std::int64_t seek(const Demand& demand, std::int64_t at_most);     // returns the task's evaluations
  std::int64_t shorten(const Demand& demand, std::int64_t at_most);  // the same
  Demand random_demand();
  std::vector<std::size_t> nearest(const Demand& demand, std::size_t count) const;
  std::vector<std::size_t> measured(const Demand& demand) const;

  const Problem& problem_;
  const StagedProblem& staged_;
  const RunState& state_;
  RandomStream& random_;
  std::map<std::string, DemandEffort> efforts_;
  std::vector<StageChoice> measured_, guesses_;  // the latter: measured ones, and guesses
  ComposedTracks tracks_, guessed_tracks_;
  std::vector<SearchTask> tasks_;
};

}  // namespace formotion
