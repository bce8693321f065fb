// Tasks that search whole candidates: scans, improvement of the fronts, repair of what is nearly feasible.
#pragma once

#include <vector>

#include "optimize/random_stream.hpp"
#include "optimize/run_state.hpp"

namespace formotion {

class JointProposals {
 public:
  JointProposals(const Problem& problem, const RunState& state, RandomStream& random);

  // The user's guess, or the middle, of each topology; with residuals a fit from there.
  void guesses(const std::vector<int>& topologies);
  // Each topology alike: spread points, and a global scan for each of the first objectives.
  void scan(const std::vector<int>& topologies, std::int64_t evaluations_each, std::uint64_t seed);
  // `count` tasks on these topologies: repair, improvement, and some that look elsewhere.
  void search(const std::vector<int>& topologies, std::int64_t count, std::int64_t evaluations_each);
  // Spread points in all of them, where nothing else brings anything new.
  void anything_new(const std::vector<int>& topologies, std::int64_t evaluations_each);

  std::vector<SearchTask> take() { return std::move(tasks_); }

 private:
  std::size_t objective_count() const { return problem_.objectives().size(); }
  const std::string& objective_name(std::size_t k) const { return problem_.objectives()[k].name; }
  Merit free_merit(std::size_t focus) const;
  SearchTask& add(Driver driver, int topology, std::int64_t evaluations, const std::string& what);
  SearchTask& add_local(int topology, std::int64_t evaluations, const std::string& what);
  void look_elsewhere(int topology, std::int64_t evaluations);
  void repair(int topology, std::int64_t evaluations);
  void improve(int topology, std::int64_t evaluations);
  double step();

  const Problem& problem_;
  const RunState& state_;
  RandomStream& random_;
  std::vector<std::size_t> smooth_;  // objectives that a local search can follow
  std::vector<double> scale_;        // one unit of every objective: its range on the front
  std::vector<SearchTask> tasks_;
};

inline constexpr std::int64_t kTaskEvaluations = 150;

}  // namespace formotion
