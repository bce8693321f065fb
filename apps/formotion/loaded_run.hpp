// A stored run opened for looking at: status, report and export begin with it.
#pragma once

#include "applications/feeder/feeder_problem.hpp"
#include "io/problem_file.hpp"
#include "optimize/search.hpp"

namespace formotion {

struct LoadedRun {
  explicit LoadedRun(const std::string& folder)
      : store(RunStore::open_for_reading(folder)),
        file(parse_problem(store.identity().problem_text, store.identity().problem_path)),
        problem(file.feeder),
        state(problem) {
    store.load(state);
  }
  RunSummary run() const {
    RunSummary run = summary(state, store.identity(), store.complete());
    run.stamps = store.stamps();
    return run;
  }

  RunStore store;
  ProblemFile file;
  feeder::FeederProblem problem;
  RunState state;
};

}  // namespace formotion
