#include "optimize/search.hpp"

#include <algorithm>

#include "optimize/closing.hpp"

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

// Adds what is said at the end, if a search that ended before has not.
void close(const Problem& problem, RunState& state, const std::atomic<bool>& stop) {
  const bool said = std::any_of(state.findings().begin(), state.findings().end(),
                                [](const Finding& finding) { return finding.topic == "proved"; });
  if (said) return;
  for (Finding& finding : closing_findings(problem, state, stop)) state.add(std::move(finding));
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
      try {
        close(problem, state, stop);
      } catch (const SearchStopped&) { return SearchEnd::Stopped; }
      if (store && !store->complete()) store->commit(state, true);
      return spent ? SearchEnd::BudgetSpent : SearchEnd::NothingNew;
    }
    if (stop) return SearchEnd::Stopped;
    const std::vector<SearchTask> tasks = propose(problem, state, options.budget);
    std::vector<TaskResult> results;
    reached(options.at_point, "batch: proposed");
    try {
      results = engine.run(tasks, stop);
    } catch (const SearchStopped&) { return SearchEnd::Stopped; }
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      state.fold(results[i], tasks[i].provenance, options.budget.evaluations - state.spent());
    }
    state.close_batch();
    reached(options.at_point, "batch: folded in");
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
  run.findings = state.findings();
  for (const Evaluated& e : state.evaluations()) {
    if (e.score.failure != Failure::None) ++run.failures[name(e.score.failure)];
    if (!e.score.feasible) continue;
    const std::vector<double> losses = state.losses_of(e.score);
    if (run.least.empty()) run.least = run.most = losses;
    for (std::size_t k = 0; k < losses.size(); ++k) {
      run.least[k] = std::min(run.least[k], losses[k]);
      run.most[k] = std::max(run.most[k], losses[k]);
    }
  }
  return run;
}

}  // namespace formotion
