// Certificates for whole neighbourhoods of configurations, against sampled members of them.
#include "analysis/insertion/lasting_overlap.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "analysis/contact/clearance.hpp"
#include "witness/minkowski_scenes.hpp"

using namespace formotion;

namespace {

Polygon rectangle(double width, double height) {
  return {{{-width / 2, -height / 2}, {width / 2, -height / 2}, {width / 2, height / 2}, {-width / 2, height / 2}}, {}};
}

Configuration near(const Configuration& q, double move_mm, double turn_rad, witness::Random& random) {
  const double angle = witness::uniform(random, 0, 2 * std::numbers::pi);
  const double share = witness::below(random, 2) ? 1 : witness::uniform(random, 0, 1);
  return {q.x_mm + share * move_mm * std::cos(angle), q.y_mm + share * move_mm * std::sin(angle),
          q.theta_rad + (witness::below(random, 2) ? 1 : -1) * share * turn_rad};
}

}  // namespace

TEST_CASE("no member of a neighbourhood with lasting overlap is free, and none of a free one overlaps") {
  witness::Random random(21);
  int closed = 0, open = 0;
  for (int i = 0; i < 400; ++i) {
    const witness::ContactScene scene =
        i % 2 ? witness::random_scene(random) : witness::round_scene(random, i % 4 == 0);
    const LastingOverlap overlap(scene.part, scene.obstacles, 0.5);
    for (int k = 0; k < 5; ++k) {
      const Configuration q = witness::random_placement(random, scene);
      const double move = std::pow(10, witness::uniform(random, -3, 0.7));
      const double turn = std::pow(10, witness::uniform(random, -3, 0.7)) / scene.part.reach_mm;
      const bool is_closed = overlap.at(q, move, turn), is_open = overlap.free_at(q, move, turn);
      closed += is_closed;
      open += is_open;
      for (int member = 0; member < 20 && (is_closed || is_open); ++member) {
        const Configuration other = near(q, move, turn, random);
        CAPTURE(i, k, move, turn);
        REQUIRE(is_free(scene.part, scene.obstacles, other) == is_open);
      }
    }
  }
  CHECK(closed > 200);
  CHECK(open > 200);
}

TEST_CASE("a part beside the only turn at which it fits its hole is not taken to overlap lastingly") {
  const Polygon frame{rectangle(30, 30).outer, {{{-5, -5}, {-5, 5}, {5, 5}, {5, -5}}}};
  const MovingShape part = MovingShape::of({rectangle(10, 10)}, 5);
  const Obstacles obstacles = *make_obstacles({{frame, 0, false}});
  const LastingOverlap overlap(part, obstacles, 0.25);
  const Configuration turned{0, 0, 0.01};
  REQUIRE(is_free(part, obstacles, {0, 0, 0}));
  CHECK(clearance_mm(part, obstacles, turned) < -1);  // far to move, little to turn
  CHECK_FALSE(overlap.at(turned, 0, 0.01));
  CHECK(overlap.at(turned, 0, 0.004));
}

TEST_CASE("overlap of a square over a wall lasts for moves smaller than its depth") {
  const Polygon wall{{{-50, -20}, {50, -20}, {50, 0}, {-50, 0}}, {}};
  const MovingShape part = MovingShape::of({rectangle(10, 10)}, 5);
  const Obstacles obstacles = *make_obstacles({{wall, 0, false}});
  const LastingOverlap overlap(part, obstacles, 0.25);
  for (const double depth : {0.1, 1.0, 3.0}) {
    CHECK(overlap.at({0.3, 5 - depth, 0}, 0.98 * depth, 0));
    CHECK_FALSE(overlap.at({0.3, 5 - depth, 0}, 1.001 * depth, 0));
    CHECK(overlap.free_at({0.3, 5 + depth, 0}, 0.99 * depth, 0));
    CHECK_FALSE(overlap.free_at({0.3, 5 + depth, 0}, 1.001 * depth, 0));
  }
}
