// What one candidate with wall features costs: all starting orientations of the L past a fence at the wall, without and
// with a pin behind it, by the outcome map of forward projection; and by Box2D on the same scene in the same run. Box2D
// runs 20 starts, and its time is that of one; 360 of them, a degree apart and blind between, would cost 360 times
// that.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>

#include "analysis/motion/contact_space.hpp"
#include "analysis/motion/outcome_map.hpp"
#include "turning_scenes.hpp"

namespace {

using namespace formotion;
using namespace formotion::bench;

TurningScene scene_of(std::int64_t features) {
  for (TurningScene& scene : turning_scenes()) {
    if (scene.name != "L, ramp and pin, turning") continue;
    if (features == 1) scene.obstacles.pop_back();
    return scene;
  }
  std::abort();
}

// The outcome as a map wants it: how it ends; of delivered parts, in which orientation to a thousandth of a degree.
int outcome_of(const Projection& went, std::map<std::pair<int, long>, int>& known) {
  const double turns = went.last.theta_rad / (2 * std::numbers::pi);
  const bool delivered = went.end == ProjectionEnd::Steady;
  const long orientation = delivered ? std::lround((turns - std::floor(turns)) * 360e3) : 0;
  return known.emplace(std::pair(static_cast<int>(went.end), orientation), static_cast<int>(known.size()))
      .first->second;
}

void all_orientations(benchmark::State& state) {
  const TurningScene scene = scene_of(state.range(0));
  const MovingShape part = MovingShape::of({scene.part}, scene.gyration_mm);
  int starts = 0, intervals = 0;
  for (auto _ : state) {
    const Obstacles obstacles = *make_obstacles(scene.obstacles);
    const ContactSpace space(part, obstacles);
    Funnels funnels;
    ProjectionOptions options;
    options.keep_path = false;
    options.funnels = &funnels;
    std::map<std::pair<int, long>, int> known;
    const OutcomeMap map = outcome_map(
        [&](double theta) {
          const Projection went = project(space, scene.drive, start_at(scene, theta), options);
          return StartOutcome{outcome_of(went, known), went.history};
        },
        {});
    starts = map.starts;
    intervals = static_cast<int>(map.intervals.size());
  }
  state.counters["starts"] = starts;
  state.counters["intervals"] = intervals;
}
BENCHMARK(all_orientations)->ArgNames({"features"})->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond);

// Single starts without what a map remembers between them.
void one_start(benchmark::State& state) {
  const TurningScene scene = scene_of(state.range(0));
  const MovingShape part = MovingShape::of({scene.part}, scene.gyration_mm);
  const Obstacles obstacles = *make_obstacles(scene.obstacles);
  const ContactSpace space(part, obstacles);
  ProjectionOptions options;
  options.keep_path = false;
  int i = 0;
  for (auto _ : state) {
    const double theta = (i++ % 360 + 0.5) * std::numbers::pi / 180;
    benchmark::DoNotOptimize(project(space, scene.drive, start_at(scene, theta), options));
  }
  double legs = 0;
  options.keep_path = true;
  for (int k = 0; k < 360; ++k) {
    const double theta = (k + 0.5) * std::numbers::pi / 180;
    legs += static_cast<double>(project(space, scene.drive, start_at(scene, theta), options).legs.size());
  }
  state.counters["legs_a_start"] = legs / 360;
}
BENCHMARK(one_start)->ArgNames({"features"})->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond);

void one_start_in_box2d(benchmark::State& state) {
  const TurningScene scene = scene_of(state.range(0));
  const Box2dTrack track = box2d_track(scene);
  int i = 0;
  double steps = 0;
  for (auto _ : state) {
    const double theta = (i++ * 18 % 360 + 0.5) * std::numbers::pi / 180;
    steps += run_box2d(track, start_at(scene, theta)).steps;
  }
  state.counters["steps_a_start"] = steps / i;
}
BENCHMARK(one_start_in_box2d)->ArgNames({"features"})->Arg(1)->Arg(2)->Iterations(20)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
