// Contact queries a second and core, against the corners of part (first number) and obstacles (second): all facets, a
// slice of free space, clearance apart and overlapping. Stars: about every second corner is reflex. One core; wall
// time of this machine; says nothing about parts of other shapes.
#include <benchmark/benchmark.h>

#include "analysis/contact/clearance.hpp"
#include "analysis/contact/facets.hpp"
#include "analysis/contact/free_slice.hpp"
#include "cases.hpp"

namespace {

using namespace formotion;
using namespace formotion::bench;

struct Scene {
  MovingShape part;
  Obstacles obstacles;
};

Scene scene_of(const benchmark::State& state) {
  Random random(7);
  const Loop part = star(random, static_cast<int>(state.range(0)), 8, 15);
  Loop fixed = star(random, static_cast<int>(state.range(1)), 15, 30);
  return {MovingShape::of({{part, {}}}, 8), *make_obstacles({{{fixed, {}}, 0, false}})};
}

// Placements with the part's centre within `far` of the obstacle's, none of them alike.
Configuration next_placement(Random& random, double far) {
  return {uniform(random, -far, far), uniform(random, -far, far), uniform(random, 0, 6.28)};
}

void facets(benchmark::State& state) {
  const Scene scene = scene_of(state);
  std::size_t count = 0;
  for (auto _ : state) {
    const auto found = contact_facets(scene.part, scene.obstacles);
    count = found.size();
    benchmark::DoNotOptimize(found.data());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
  state.counters["facets"] = static_cast<double>(count);
}

void slices(benchmark::State& state) {
  const Scene scene = scene_of(state);
  Random random(1);
  std::size_t pieces = 0;
  for (auto _ : state) {
    const FreeSlice slice = free_slice(scene.part, scene.obstacles, uniform(random, 0, 6.28));
    pieces += slice.pieces.size();
    benchmark::DoNotOptimize(slice.pieces.data());
  }
  state.SetItemsProcessed(state.iterations());
  state.counters["pieces"] = static_cast<double>(pieces) / static_cast<double>(state.iterations());
}

// kept: placements that are free (1), that overlap (0).
void clearances(benchmark::State& state) {
  const Scene scene = scene_of(state);
  const bool free = state.range(2) != 0;
  Random random(1);
  std::vector<Configuration> placements;
  while (placements.size() < 500) {
    const Configuration q = next_placement(random, 50);
    if (is_free(scene.part, scene.obstacles, q) == free) placements.push_back(q);
  }
  std::size_t next = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(clearance_mm(scene.part, scene.obstacles, placements[next]));
    next = (next + 1) % placements.size();
  }
  state.SetItemsProcessed(state.iterations());
}

void free_tests(benchmark::State& state) {
  const Scene scene = scene_of(state);
  Random random(1);
  for (auto _ : state) benchmark::DoNotOptimize(is_free(scene.part, scene.obstacles, next_placement(random, 50)));
  state.SetItemsProcessed(state.iterations());
}

BENCHMARK(facets)->Args({6, 6})->Args({6, 24})->Args({24, 24})->Args({24, 96})->Args({96, 96});
BENCHMARK(slices)->Args({6, 6})->Args({6, 24})->Args({24, 24})->Args({24, 96})->Args({96, 96});
BENCHMARK(free_tests)->Args({6, 6})->Args({6, 24})->Args({24, 24})->Args({24, 96})->Args({96, 96});
BENCHMARK(clearances)->ArgsProduct({{6, 24, 96}, {6, 24, 96}, {0, 1}});

}  // namespace

BENCHMARK_MAIN();
