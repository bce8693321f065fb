#include "optimize/search.hpp"

namespace formotion {
namespace {

constexpr int kFruitlessBatches = 3;
constexpr std::size_t kSample = 3000;

// How many batches at the end brought nothing new.
int fruitless(const RunState& state) {
  const auto& history = state.history();
  int count = 0;
  for (std::size_t b = history.size(); b-- > 0 && count < kFruitlessBatches;) {
    const std::int64_t before = b > 0 ? history[b - 1].spent() : 0;
    if (history[b].spent() > before) break;
    ++count;
  }
  return count;
}

}  // namespace

SearchEnd search(const Problem& problem, RunState& state, RunStore* store, Engine& engine,
                 const SearchOptions& options) {
  static const std::atomic<bool> kNever{false};
  const std::atomic<bool>& stop = options.stop ? *options.stop : kNever;
  for (;;) {
    const std::int64_t left = options.budget.evaluations - state.spent();
    const bool spent = left <= 0, nothing_new = fruitless(state) >= kFruitlessBatches;
    if (spent || nothing_new) {
      if (store && !store->complete()) store->commit(state, true);
      return spent ? SearchEnd::BudgetSpent : SearchEnd::NothingNew;
    }
    if (stop) return SearchEnd::Stopped;
    const std::vector<SearchTask> tasks = propose(problem, state, options.budget);
    std::vector<TaskResult> results;
    try {
      results = engine.run(tasks, stop);
    } catch (const SearchStopped&) { return SearchEnd::Stopped; }
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      state.fold(results[i], tasks[i].provenance, options.budget.evaluations - state.spent());
    }
    state.close_batch();
    if (store) store->commit(state, false);
    if (options.after_batch) options.after_batch(state);
  }
}

RunSummary summary(const RunState& state, const RunIdentity& identity, bool complete) {
  RunSummary run;
  run.evaluations = state.spent();
  run.stages = static_cast<std::int64_t>(state.stages().size());
  run.budget = identity.budget;
  run.feasible = state.feasible_count();
  run.seed = identity.seed;
  run.program_version = identity.program_version;
  run.complete = complete;
  run.front = state.best_designs();
  const std::size_t count = state.evaluations().size(), step = (count + kSample - 1) / kSample;
  for (std::size_t i = 0; i < count; i += step) run.sample.push_back(state.evaluations()[i]);
  run.history = state.history();
  return run;
}

}  // namespace formotion
