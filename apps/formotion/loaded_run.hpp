// A stored run opened for looking at: status, report, export and verify begin with it.
#pragma once

#include "io/problem_file.hpp"
#include "optimize/search.hpp"
#include "report/kind.hpp"

namespace formotion {

struct LoadedRun {
  explicit LoadedRun(const std::string& folder)
      : store(RunStore::open_for_reading(folder)),
        file(parse_problem(store.identity().problem_text, store.identity().problem_path)),
        kind(kind_of(file)),
        state(problem()) {
    store.load(state);
  }
  const Problem& problem() const { return kind->problem(); }
  RunSummary run() const {
    RunSummary run = summary(state, store.identity(), store.complete());
    run.stamps = store.stamps();
    return run;
  }

  RunStore store;
  ProblemFile file;
  std::unique_ptr<Kind> kind;
  RunState state;
};

}  // namespace formotion
