// Locally lowest positions of one orientation, and drop heights, against places tried one by one.
#include "analysis/energy/lowest_positions.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "witness/rest_scenes.hpp"

using namespace formotion;
using namespace formotion::witness;

namespace {

constexpr double kPi = std::numbers::pi;

Configuration place(const Gravity& gravity, double across, double height, double theta) {
  const Point p = across * turned_left(gravity.down) - height * gravity.down;
  return {p.x(), p.y(), theta};
}

}  // namespace

TEST_CASE("a part lowered from above touches first at its drop height", "[rests]") {
  Random random(3);
  int met = 0;
  for (std::uint64_t seed = 700; seed < 730; ++seed) {
    const RestScene scene = random_rest_scene(seed);
    const MovingShape part = MovingShape::of({scene.outline}, 5);
    const Obstacles obstacles = *make_obstacles(scene.shapes, scene.grow_mm);
    const double theta = uniform(random, 0, 2 * kPi);
    const FreeSlice slice = free_slice(part, obstacles, theta);
    for (int i = 0; i < 20; ++i) {
      const double across = uniform(random, -90, 90);
      const auto height = drop_height_mm(slice, scene.gravity, across);
      const auto is_free_at = [&](double h) {
        return is_free(part, obstacles, place(scene.gravity, across, h, theta));
      };
      const double low = height ? *height + 1e-6 : -150;
      for (int k = 0; k < 40; ++k) CHECK(is_free_at(low + (120 - low) * k / 40));
      if (!height) continue;
      ++met;
      CHECK_FALSE(is_free_at(*height - 1e-4));
    }
  }
  CHECK(met > 200);
}

TEST_CASE("lowest positions are free and places just below them are not", "[rests]") {
  Random random(4);
  int count = 0, level = 0;
  for (std::uint64_t seed = 730; seed < 770; ++seed) {
    const RestScene scene = random_rest_scene(seed);
    const MovingShape part = MovingShape::of({scene.outline}, 5);
    const Obstacles obstacles = *make_obstacles(scene.shapes, scene.grow_mm);
    const double theta = seed % 3 == 0 ? kPi / 2 : uniform(random, 0, 2 * kPi);
    for (const LowestPosition& lowest : lowest_positions(free_slice(part, obstacles, theta), scene.gravity)) {
      ++count;
      level += lowest.is_level();
      const Point p = lowest.middle();
      INFO("seed " << seed << " at " << p.x() << " " << p.y());
      CHECK(is_free(part, obstacles, {p.x(), p.y(), theta}));
      if (lowest.leads_down) continue;
      for (int k = 0; k < 60; ++k) {
        const double angle = uniform(random, 0, kPi), by = k % 2 == 0 ? 1e-3 : 1e-5;
        const Point q =
            p + by * (std::cos(angle) * turned_left(scene.gravity.down) + std::sin(angle) * scene.gravity.down);
        if (scene.gravity.height_mm(q) > lowest.height_mm - 1e-8 - 1e-2 * by) continue;
        CHECK_FALSE(is_free(part, obstacles, {q.x(), q.y(), theta}));
      }
    }
  }
  CHECK(count > 100);
  CHECK(level > 5);
}
