// Compliant insertions a second and core, and what the map of all starts of a joint costs: its success region by
// boundaries, and the same map start for start by the simulation in small steps, on the region's own rows and in cells
// as wide as the region's boundaries are located. Both are run in full, and compared: outcomes are counted at all of
// the grid's starts. One core; processor time of this machine; one joint.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "analysis/insertion/success_region.hpp"
#include "witness/insertion_scenes.hpp"

namespace {

using namespace formotion;
using namespace formotion::witness;

constexpr ErrorBox kErrors{-3, 3, -0.04, 0.04};
constexpr int kCells = 200;  // a row: of 0.03 mm

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

// Of processor time: other programs run on the machine.
double seconds_since(std::clock_t begin) { return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC; }

int outcome_at(const RegionRow& row, double u) {
  const auto in = std::find_if(row.intervals.begin(), row.intervals.end(),
                               [&](const RegionInterval& interval) { return u <= interval.to; });
  return (in == row.intervals.end() ? row.intervals.back() : *in).outcome;
}

// Whether a boundary is within a cell: in u on this row, or one row up or down.
bool is_near_boundary(const OutcomeRegion& region, std::size_t row, double u, double cell) {
  const int outcome = outcome_at(region.rows[row], u);
  for (const RegionInterval& interval : region.rows[row].intervals) {
    const bool is_end = interval.to >= region.box.u_max;
    if (!is_end && std::abs(interval.to - u) <= cell) return true;
  }
  return (row > 0 && outcome_at(region.rows[row - 1], u) != outcome) ||
         (row + 1 < region.rows.size() && outcome_at(region.rows[row + 1], u) != outcome);
}

// How outcomes of the grid's starts compare.
struct Comparison {
  int starts = 0, assembled = 0;
  int near = 0;                               // a boundary: not compared
  int same = 0, differ = 0;                   // away from boundaries, decided by both
  int differ_in_success = 0;                  // of those that differ: one assembles
  int ambiguous = 0, ambiguous_assemble = 0;  // by the region; of these the steps assemble
  int lost = 0;                               // undecided by either
};

Comparison compared(const OutcomeRegion& region, const SteppingScene& scene, const InsertionTask& task) {
  Comparison counts;
  const double cell = (kErrors.u_max - kErrors.u_min) / kCells;
  const auto assembled = static_cast<int>(InsertionOutcome::Assembled);
  const auto undecided = static_cast<int>(InsertionOutcome::Undecided);
  for (std::size_t row = 0; row < region.rows.size(); ++row) {
    for (int i = 0; i < kCells; ++i) {
      const double u = kErrors.u_min + (i + 0.5) * cell;
      const auto stepped =
          static_cast<int>(step_insertion(scene, start_with_errors(task, u, 0, region.rows[row].v)).outcome);
      const int mapped = outcome_at(region.rows[row], u);
      ++counts.starts;
      counts.assembled += stepped == assembled;
      if (is_near_boundary(region, row, u, cell)) {
        ++counts.near;
      } else if (mapped == undecided || stepped == undecided) {
        ++counts.lost;
      } else if (mapped == static_cast<int>(InsertionOutcome::Ambiguous)) {
        ++counts.ambiguous;
        counts.ambiguous_assemble += stepped == assembled;
      } else if (mapped == stepped) {
        ++counts.same;
      } else {
        ++counts.differ;
        counts.differ_in_success += mapped == assembled || stepped == assembled;
      }
    }
  }
  return counts;
}

// One pass: the region three times, for its time is short; then the whole grid on its rows.
void maps(benchmark::State& state) {
  const SteppingScene scene = scene_of(joint());
  const JointTask made(scene);
  RegionOptions options;
  options.boundary = options.row_error = 1.0 / kCells;
  for (auto _ : state) {
    constexpr int kTimes = 3;
    OutcomeRegion region;
    const auto begin = std::clock();
    for (int i = 0; i < kTimes; ++i) {
      const auto at = [&](double u, double v) {
        const Insertion insertion = insert(made.task, start_with_errors(made.task, u, 0, v));
        return StartOutcome{static_cast<int>(insertion.outcome), insertion.history};
      };
      region = outcome_region(kErrors, at, options);
    }
    const double region_s = seconds_since(begin) / kTimes;
    const auto stepping = std::clock();
    const Comparison counts = compared(region, scene, made.task);
    const double grid_s = seconds_since(stepping);
    state.SetIterationTime(region_s);
    state.counters["starts"] = region.starts;
    state.counters["rows"] = static_cast<double>(region.rows.size());
    state.counters["success"] = share_of(region, static_cast<int>(InsertionOutcome::Assembled));
    state.counters["grid_starts"] = counts.starts;
    state.counters["grid_success"] = static_cast<double>(counts.assembled) / counts.starts;
    state.counters["near"] = counts.near;
    state.counters["same"] = counts.same;
    state.counters["differ"] = counts.differ;
    state.counters["differ_in_success"] = counts.differ_in_success;
    state.counters["ambiguous"] = counts.ambiguous;
    state.counters["ambiguous_assemble"] = counts.ambiguous_assemble;
    state.counters["lost"] = counts.lost;
    state.counters["grid_s"] = grid_s;
    state.counters["ratio"] = grid_s / region_s;
  }
}

BENCHMARK(insertions);
BENCHMARK(steppings);
BENCHMARK(maps)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace

BENCHMARK_MAIN();
