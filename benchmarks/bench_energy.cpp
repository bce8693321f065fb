// Escape heights a second and core: against the gap that is asked for, against the corners of part and nest, and all
// that one candidate of a search costs; rests and equilibria beside them. The same scenes in every line; one core; wall
// time of this machine.
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <vector>

#include "analysis/energy/equilibria.hpp"
#include "analysis/energy/nests.hpp"
#include "analysis/energy/rests.hpp"
#include "applications/nest/nest_problem.hpp"
#include "io/problem_file.hpp"

namespace {

using namespace formotion;
using namespace formotion::testing;

constexpr int kScenes = 24;

struct Scenes {
  std::vector<std::unique_ptr<Nest>> nests;
  std::vector<Configuration> starts;
  Scenes() {
    for (std::uint64_t seed = 1; seed <= kScenes; ++seed) {
      const RandomNest random(seed);
      nests.push_back(std::make_unique<Nest>(random.part, random.fixed, random.grow_mm));
      starts.push_back(random.start);
    }
  }
};
const Scenes& scenes() {
  static const Scenes made;
  return made;
}

// Argument: the gap in micrometres.
void brackets(benchmark::State& state) {
  EscapeOptions options;
  options.gap_mm = static_cast<double>(state.range(0)) / 1000;
  options.want_path = state.range(1) != 0;
  long cells = 0, wide = 0;
  for (auto _ : state) {
    for (int i = 0; i < kScenes; ++i) {
      const EscapeBracket found = scenes().nests[i]->escape(scenes().starts[i], options);
      cells += found.cells;
      wide += options.want_path && std::isfinite(found.lower_mm) &&
              (!found.upper_mm || *found.upper_mm - found.lower_mm > options.gap_mm);
    }
  }
  state.SetItemsProcessed(state.iterations() * kScenes);
  state.counters["cells"] =
      benchmark::Counter(static_cast<double>(cells) / kScenes, benchmark::Counter::kAvgIterations);
  state.counters["wider"] = benchmark::Counter(static_cast<double>(wide), benchmark::Counter::kAvgIterations);
}

// A regular part of n corners in a pocket whose rim has m teeth on either side.
void growth(benchmark::State& state) {
  const int n = static_cast<int>(state.range(0)), m = static_cast<int>(state.range(1));
  std::vector<ObstacleShape> fixed{{pocket(24, 15), 0, false}};
  for (int i = 0; i < m; ++i) {
    const double x = 14 + 24.0 * i / m;
    fixed.push_back({block(x, 14, x + 12.0 / m, 17), 0, false});
    fixed.push_back({block(-x - 12.0 / m, 14, -x, 17), 0, false});
  }
  const Nest nest(regular(n, 9), fixed);
  for (auto _ : state) benchmark::DoNotOptimize(nest.escape({0, 9, 0}).lower_mm);
  state.SetItemsProcessed(state.iterations());
}

void all_rests(benchmark::State& state) {
  RestOptions options;
  options.grid_rad = static_cast<double>(state.range(0)) * std::numbers::pi / 180;
  for (auto _ : state) {
    for (const auto& nest : scenes().nests) benchmark::DoNotOptimize(rests(nest->space, nest->gravity, options).size());
  }
  state.SetItemsProcessed(state.iterations() * kScenes);
}

void all_equilibria(benchmark::State& state) {
  const PushSet push{-std::numbers::pi / 2, -std::numbers::pi / 2, 0.2, 0.2};
  for (auto _ : state) {
    for (const auto& nest : scenes().nests) benchmark::DoNotOptimize(equilibria(nest->space, push).size());
  }
  state.SetItemsProcessed(state.iterations() * kScenes);
}

// One candidate of a search: rests, ways out of all, captured starts.
void candidates(benchmark::State& state) {
  const char* const files[] = {"pallet/tee_in_a_slot", "pallet/faces_told_apart", "fixture/bracket_nest"};
  const std::string path = std::string(FORMOTION_SOURCE_DIR "/problems/") + files[state.range(0)] + ".json";
  const nest::NestProblem problem(*read_problem_file(path).nest);
  Candidate candidate;
  for (const int variable : problem.topologies()[0].variables)
    candidate.values.push_back(problem.variables()[static_cast<std::size_t>(variable)].start());
  for (auto _ : state) benchmark::DoNotOptimize(problem.score(candidate).work);
  state.SetItemsProcessed(state.iterations());
  state.SetLabel(files[state.range(0)]);
}

BENCHMARK(brackets)->Args({1000, 1})->Args({300, 1})->Args({100, 1})->Args({30, 1})->Args({100, 0})->Unit(
    benchmark::kMillisecond);
BENCHMARK(growth)
    ->Args({6, 0})
    ->Args({12, 0})
    ->Args({24, 0})
    ->Args({48, 0})
    ->Args({12, 1})
    ->Args({12, 3})
    ->Args({12, 6})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(all_rests)->Arg(5)->Arg(1)->Unit(benchmark::kMillisecond);
BENCHMARK(all_equilibria)->Unit(benchmark::kMillisecond);
BENCHMARK(candidates)->Arg(0)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
