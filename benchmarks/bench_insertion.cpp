// Compliant insertions a second and core, and what the map of all starts of a joint costs: its success region by
// boundaries, and by the simulation in small steps on a grid as fine as the region's boundaries are located. The grid
// is not run: its time is that of a sample of its starts, evenly spread, times their number, in the same run. One core;
// wall time of this machine; one joint.
#include <benchmark/benchmark.h>

#include <chrono>

#include "analysis/insertion/success_region.hpp"
#include "witness/insertion_scenes.hpp"

namespace {

using namespace formotion;
using namespace formotion::witness;

constexpr ErrorBox kErrors{-3, 3, -0.04, 0.04};
constexpr double kBoundary_mm = 0.006;  // of the grid; the region's boundaries are located far finer

PegInHole joint() { return {}; }

void insertions(benchmark::State& state) {
  const SteppingScene scene = scene_of(joint());
  const JointTask made(scene);
  Random random(1);
  for (auto _ : state) {
    const double x = uniform(random, kErrors.u_min, kErrors.u_max), theta = uniform(random, -0.04, 0.04);
    benchmark::DoNotOptimize(insert(made.task, start_with_errors(made.task, x, 0, theta)).depth_mm);
  }
  state.SetItemsProcessed(state.iterations());
}

void steppings(benchmark::State& state) {
  const SteppingScene scene = scene_of(joint());
  const JointTask made(scene);
  Random random(1);
  for (auto _ : state) {
    const double x = uniform(random, kErrors.u_min, kErrors.u_max), theta = uniform(random, -0.04, 0.04);
    benchmark::DoNotOptimize(step_insertion(scene, start_with_errors(made.task, x, 0, theta)).depth_mm);
  }
  state.SetItemsProcessed(state.iterations());
}

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// One pass: the region, then the sample of the grid with the same rows.
void maps(benchmark::State& state) {
  const SteppingScene scene = scene_of(joint());
  const JointTask made(scene);
  for (auto _ : state) {
    const auto begin = std::chrono::steady_clock::now();
    const OutcomeRegion region = outcome_region(kErrors, [&](double u, double v) {
      const Insertion insertion = insert(made.task, start_with_errors(made.task, u, 0, v));
      return StartOutcome{static_cast<int>(insertion.outcome), insertion.history};
    });
    const double region_s = seconds_since(begin);
    const auto stepping = std::chrono::steady_clock::now();
    const double across = (kErrors.u_max - kErrors.u_min) / kBoundary_mm;
    const double grid = across * static_cast<double>(region.rows.size());
    constexpr int kSample = 15;  // a side
    int assembled = 0;
    for (int i = 0; i < kSample; ++i) {
      for (int j = 0; j < kSample; ++j) {
        const double u = kErrors.u_min + (i + 0.5) / kSample * (kErrors.u_max - kErrors.u_min);
        const double v = kErrors.v_min + (j + 0.5) / kSample * (kErrors.v_max - kErrors.v_min);
        assembled +=
            step_insertion(scene, start_with_errors(made.task, u, 0, v)).outcome == InsertionOutcome::Assembled;
      }
    }
    const double grid_s = seconds_since(stepping) / (kSample * kSample) * grid;
    state.SetIterationTime(region_s);
    state.counters["starts"] = region.starts;
    state.counters["rows"] = static_cast<double>(region.rows.size());
    state.counters["success"] = share_of(region, static_cast<int>(InsertionOutcome::Assembled));
    state.counters["success_by_steps"] = static_cast<double>(assembled) / (kSample * kSample);
    state.counters["grid_starts"] = grid;
    state.counters["grid_s"] = grid_s;
    state.counters["ratio"] = grid_s / region_s;
  }
}

BENCHMARK(insertions);
BENCHMARK(steppings);
BENCHMARK(maps)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(3);

}  // namespace

BENCHMARK_MAIN();
