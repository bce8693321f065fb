#include "applications/feeder/swept_obstacle.hpp"

#include <catch2/catch.hpp>
#include <numbers>

#include "analysis/contact/clearance.hpp"
#include "analysis/geometry/boolean.hpp"
#include "witness/random_shapes.hpp"

using namespace formotion;
using namespace formotion::witness;
using feeder::swept_obstacle;

namespace {

constexpr double kPrecision_mm = 0.1;

double area_of(const std::vector<Polygon>& pieces) {
  double area = 0;
  for (const Polygon& piece : pieces) {
    for (const Loop& loop : loops_of(piece)) area += signed_area(loop);
  }
  return area;
}

Configuration between(const Configuration& a, const Configuration& b, double t) {
  return {std::lerp(a.x_mm, b.x_mm, t), std::lerp(a.y_mm, b.y_mm, t), std::lerp(a.theta_rad, b.theta_rad, t)};
}

}  // namespace

TEST_CASE("what a translation leaves of a region is the region without the corridor") {
  const Polygon box{rectangle(-3, -2, 3, 2), {}};
  const auto swept = swept_obstacle({box}, {{-20, 0, 0}, {20, 0, 0}}, rectangle(-10, -5, 10, 5), kPrecision_mm);
  REQUIRE(swept.pieces.size() == 2);
  CHECK(area_of(swept.pieces) <= 2 * 20 * 3.0);
  CHECK(area_of(swept.pieces) >= 2 * 20 * (3 - kPrecision_mm));
}

TEST_CASE("what a full turn leaves of a region is the region without the disc about the farthest corner") {
  const Polygon box{rectangle(-3, -4, 3, 4), {}};
  const auto swept =
      swept_obstacle({box}, {{0, 0, 0}, {0, 0, 2 * std::numbers::pi}}, rectangle(-10, -10, 10, 10), kPrecision_mm);
  REQUIRE(swept.pieces.size() == 1);
  CHECK(swept.pieces.front().holes.size() == 1);
  CHECK(area_of(swept.pieces) <= 400 - std::numbers::pi * 25);
  CHECK(area_of(swept.pieces) >= 400 - std::numbers::pi * 25 - 2 * std::numbers::pi * 5 * kPrecision_mm);
}

TEST_CASE("the part passes a swept shape everywhere on its path and no point far from the sweep is given away") {
  Random random(5);
  for (int round = 0; round < 12; ++round) {
    const Polygon part = normalised(random_polygon(random, 12));
    std::vector<Configuration> path;
    for (int k = 0; k < 3; ++k)
      path.push_back({uniform(random, -25, 25), uniform(random, -10, 20), uniform(random, -2, 2)});
    const Loop region = rectangle(-40, -5, 40, 30);
    const auto swept = swept_obstacle({part}, path, region, kPrecision_mm);
    std::vector<ObstacleShape> shapes;
    for (const Polygon& piece : swept.pieces) shapes.push_back({piece});
    const MovingShape moving = MovingShape::of({part}, 1);
    const auto obstacles = make_obstacles(shapes);
    REQUIRE(obstacles.has_value());
    std::vector<Polygon> places;
    for (std::size_t k = 0; k + 1 < path.size(); ++k) {
      for (int i = 0; i <= 60; ++i) {
        const Configuration q = between(path[k], path[k + 1], i / 60.0 * 0.99 + 0.005);
        CHECK(is_free(moving, *obstacles, q));
      }
      for (int i = 0; i <= 2000; ++i) {
        const Configuration q = between(path[k], path[k + 1], i / 2000.0);
        places.push_back(placed(part, q.theta_rad, q.position()));
      }
    }
    for (int sample = 0; sample < 60; ++sample) {
      const Point p(uniform(random, -39, 39), uniform(random, -4, 29));
      double away = 1e300;
      for (const Polygon& place : places) {
        if (locate(place, p, 0) != Side::Outside) away = 0;
        for (const Loop& loop : loops_of(place)) {
          for (std::size_t k = 0; k < loop.size(); ++k)
            away = std::min(away, distance_to_segment(p, loop[k], loop[(k + 1) % loop.size()]));
        }
      }
      const bool kept = std::any_of(swept.pieces.begin(), swept.pieces.end(),
                                    [&](const Polygon& piece) { return locate(piece, p, 0) != Side::Outside; });
      if (away > kPrecision_mm) CHECK(kept);
      if (away == 0) CHECK_FALSE(kept);
    }
  }
}
