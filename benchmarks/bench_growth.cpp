// Cost against the number of corners of part and cut-out, and the operations that it consists of.
#include <benchmark/benchmark.h>

#include "applications/feeder/part_model.hpp"
#include "applications/feeder/track_layout.hpp"
#include "cases.hpp"

namespace {

using namespace formotion;
using namespace formotion::bench;

// One pose of the part past the cut-out, and what it takes.
void sweep(benchmark::State& state, const Loop& part_outline, const Loop& hole) {
  const feeder::FeederSpec spec = part_over_cutout(part_outline, hole);
  const feeder::PartModel part = feeder::part_model(spec.part, spec.environment, {});
  const feeder::Layout layout =
      feeder::lay_out(spec.designs[0], spec.environment, spec.manufacture, part.diameter_mm, {});
  const std::vector<feeder::VoidGroup> groups = feeder::grouped(layout, part.longest_mm);
  const VoidOutline outline = VoidOutline::of(groups.front().loops);
  const TravellingPart& travelling = part.poses.front().travelling;
  for (auto _ : state) benchmark::DoNotOptimize(least_margin({travelling, outline}));
  const TravelCount count = count_travel({travelling, outline});
  state.counters["events"] = count.events;
  state.counters["generators"] = count.generators;
  state.counters["hull_updates"] = count.hull_updates;
  state.counters["pairs"] = count.pairs;
  state.counters["pairs_per_event"] = count.events ? static_cast<double>(count.pairs) / count.events : 0;
  state.counters["events_per_s"] = benchmark::Counter(
      static_cast<double>(count.events) * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

Loop placed_hole(Loop hole) {
  for (Point& p : hole) p += Point(20, 14);
  return hole;
}

void star_part(benchmark::State& state) {
  Random random(1);
  const Loop part = star(random, static_cast<int>(state.range(0)), 12, 20);
  sweep(state, part, placed_hole(star(random, 8, 5, 12)));
}
BENCHMARK(star_part)->RangeMultiplier(2)->Range(8, 512);

void gear_part(benchmark::State& state) {
  Random random(2);
  sweep(state, gear(static_cast<int>(state.range(0)), 16, 20), placed_hole(star(random, 8, 5, 12)));
}
BENCHMARK(gear_part)->RangeMultiplier(2)->Range(8, 512);

void star_cutout(benchmark::State& state) {
  Random random(3);
  const Loop part = star(random, 8, 12, 20);
  sweep(state, part, placed_hole(star(random, static_cast<int>(state.range(0)), 5, 12)));
}
BENCHMARK(star_cutout)->RangeMultiplier(2)->Range(8, 512);

// Smooth: what imported circles and dish-outs look like.
void round_cutout(benchmark::State& state) {
  Random random(4);
  const Loop part = star(random, 8, 12, 20);
  sweep(state, part, placed_hole(gear(static_cast<int>(state.range(0)), 10, 10)));
}
BENCHMARK(round_cutout)->RangeMultiplier(2)->Range(8, 512);

}  // namespace

BENCHMARK_MAIN();
