// The strategy: which drivers run next, from what is known. docs/search.md says why.
#pragma once

#include <vector>

#include "optimize/run_state.hpp"

namespace formotion {

struct SearchBudget {
  std::int64_t evaluations = 0;
  std::uint64_t seed = 1;
};

// The tasks of the next batch, in the order in which their results are folded in: a pure function of the state, the
// budget and the seed. Their evaluations may sum to more than what is left.
std::vector<SearchTask> propose(const Problem& problem, const RunState& state, const SearchBudget& budget);

}  // namespace formotion
