// Candidates a second and core for the el on a balcony and a triangular cut-out: exact scores, with and without
// tolerance, against samples along the travel.
#include <benchmark/benchmark.h>

#include <cmath>

#include "applications/feeder/tolerance.hpp"
#include "applications/feeder/void_rule.hpp"
#include "cases.hpp"
#include "sampling_scorer.hpp"

namespace {

using namespace formotion;
using namespace formotion::bench;

const std::vector<std::string> kMargins{"efficiency", "margin_mm", "length_mm"};
const std::vector<std::string> kTolerance{"efficiency", "tolerance_mm", "length_mm"};

void score_all(benchmark::State& state, const feeder::FeederProblem& problem,
               const std::vector<Candidate>& candidates) {
  std::size_t next = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(problem.score(candidates[next]));
    next = (next + 1) % candidates.size();
  }
  state.SetItemsProcessed(state.iterations());
}

void exact_random(benchmark::State& state) {
  const feeder::FeederProblem problem(el_bracket(kMargins));
  score_all(state, problem, random_candidates(problem, 2000, 1));
}
BENCHMARK(exact_random);

void exact_feasible(benchmark::State& state) {
  const feeder::FeederProblem problem(el_bracket(kMargins));
  score_all(state, problem, feasible_candidates(problem, 200, 1));
}
BENCHMARK(exact_feasible);

void exact_feasible_with_tolerance(benchmark::State& state) {
  const feeder::FeederProblem problem(el_bracket(kTolerance));
  score_all(state, problem, feasible_candidates(problem, 200, 1));
}
BENCHMARK(exact_feasible_with_tolerance);

// A search's mix: what its random and its feasible candidates cost.
void exact_random_with_tolerance(benchmark::State& state) {
  const feeder::FeederProblem problem(el_bracket(kTolerance));
  score_all(state, problem, random_candidates(problem, 2000, 1));
}
BENCHMARK(exact_random_with_tolerance);

// The step in thousandths of a mm; outcome alone or margin too. Counter wrong: outcomes that differ from the exact
// ones.
void sampled_random(benchmark::State& state) {
  const feeder::FeederSpec spec = el_bracket(kMargins);
  const feeder::FeederProblem problem(spec);
  const feeder::PartModel part = feeder::part_model(spec.part, spec.environment, {});
  const std::vector<Candidate> candidates = random_candidates(problem, 2000, 1);
  SamplingScorer scorer(part, spec.environment.track_width_mm);
  std::vector<SampledScore> scores;
  const double step = 1e-3 * static_cast<double>(state.range(0));
  const bool outcome_only = state.range(1) != 0;
  std::size_t next = 0;
  for (auto _ : state) {
    const feeder::Layout layout =
        feeder::lay_out(spec.designs[0], spec.environment, spec.manufacture, part.diameter_mm, candidates[next].values);
    scorer.score(layout, step, outcome_only, scores);
    benchmark::DoNotOptimize(scores.data());
    next = (next + 1) % candidates.size();
  }
  state.SetItemsProcessed(state.iterations());
  // How far off the samples are, over 200 candidates, outside of the timing.
  int wrong = 0;
  double worst = 0;
  for (std::size_t c = 0; c < 200; ++c) {
    const feeder::Layout layout =
        feeder::lay_out(spec.designs[0], spec.environment, spec.manufacture, part.diameter_mm, candidates[c].values);
    if (!layout.invalid.empty()) continue;
    scorer.score(layout, step, outcome_only, scores);
    const feeder::FeederEvaluation exact = problem.evaluate(0, candidates[c].values);
    for (std::size_t i = 0; i < scores.size(); ++i) {
      const bool lost = exact.poses[i].outcome != feeder::Outcome::Delivered;
      wrong += lost != scores[i].lost;
      if (!outcome_only && lost == scores[i].lost) {
        worst = std::max(worst, std::abs(std::abs(scores[i].margin_mm) - *exact.poses[i].margin_mm));
      }
    }
  }
  state.counters["wrong_outcomes"] = wrong;
  state.counters["worst_margin_mm"] = worst;
}
BENCHMARK(sampled_random)->Args({1000, 0})->Args({100, 0})->Args({10, 0})->Args({1, 0})->Args({1, 1})->Iterations(200);

}  // namespace

BENCHMARK_MAIN();
