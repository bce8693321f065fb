// From one thread to two: scores of candidates, beside a bare loop that shares nothing and touches no memory.
#include <benchmark/benchmark.h>

#include <cmath>

#include "cases.hpp"
#include "optimize/executor.hpp"

namespace {

using namespace formotion;
using namespace formotion::bench;

constexpr int kPieces = 64;

void scores(benchmark::State& state) {
  const feeder::FeederProblem problem(el_bracket({"efficiency", "tolerance_mm", "length_mm"}));
  const std::vector<Candidate> candidates = feasible_candidates(problem, 4 * kPieces, 1);
  for (auto _ : state) {
    run_parallel(kPieces, static_cast<int>(state.range(0)), [&](int piece) {
      for (int i = 0; i < 4; ++i) benchmark::DoNotOptimize(problem.score(candidates[4 * piece + i]));
    });
  }
  state.SetItemsProcessed(state.iterations() * 4 * kPieces);
}
BENCHMARK(scores)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

void bare_loop(benchmark::State& state) {
  for (auto _ : state) {
    run_parallel(kPieces, static_cast<int>(state.range(0)), [](int piece) {
      double x = 0.5 + 1e-3 * piece;
      for (int i = 0; i < 200000; ++i) x = 3.7 * x * (1 - x);
      benchmark::DoNotOptimize(x);
    });
  }
  state.SetItemsProcessed(state.iterations() * kPieces);
}
BENCHMARK(bare_loop)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
