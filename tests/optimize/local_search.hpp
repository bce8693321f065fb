// A search on the threads of the test's own process.
#pragma once

#include "optimize/search.hpp"

namespace formotion {

inline SearchEnd search_here(const Problem& problem, RunState& state, RunStore* store, const SearchOptions& options,
                             int threads = 1) {
  LocalEngine engine(problem, threads);
  return search(problem, state, store, engine, options);
}

}  // namespace formotion
