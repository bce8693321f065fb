// The search loop: propose a batch, run it in parallel, fold it in, commit.
#pragma once

#include <atomic>
#include <functional>

#include "optimize/engine.hpp"
#include "optimize/named_point.hpp"
#include "optimize/proposals.hpp"
#include "optimize/run_store.hpp"

namespace formotion {

struct SearchOptions {
  SearchBudget budget;
  const std::atomic<bool>* stop = nullptr;
  std::function<void(const RunState&)> after_batch;
  NamedPoint at_point;
};

enum class SearchEnd {
  BudgetSpent,
  NothingNew,  // batches in a row brought no candidate that was not known
  Stopped,     // told to; the batch under way was dropped
};

// Goes on from state until the budget is spent. Deterministic for every engine, and for every number of stops and
// goings-on: the next batch depends on what was folded in before alone. store may be null. Exceptions of the
// problem's score pass through; the state then holds the batches before.
SearchEnd search(const Problem& problem, RunState& state, RunStore* store, Engine& engine,
                 const SearchOptions& options);

RunSummary summary(const RunState& state, const RunIdentity& identity, bool complete);

}  // namespace formotion
