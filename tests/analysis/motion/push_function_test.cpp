// Forward projection against a plain wall, where theory says everything in one dimension.
#include "witness/push_function.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "analysis/motion/projection.hpp"
#include "analysis/resting/wall_poses.hpp"
#include "witness/random_shapes.hpp"

using namespace formotion;
using namespace formotion::witness;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kTurn = 2 * kPi;

// About its centre of mass.
Polygon centred(Polygon polygon) {
  polygon = normalised(std::move(polygon));
  return placed(polygon, 0, -area_moments(polygon).centroid);
}

double gyration(const Polygon& polygon) {
  const AreaMoments moments = area_moments(polygon);
  return std::sqrt(moments.second_mm4.trace() / moments.area_mm2);
}

struct Named {
  std::string name;
  Polygon part;
};

std::vector<Named> parts() {
  Random random(20261111);
  std::vector<Named> list{
      {"L", centred({{{0, 0},
                      {0, -30.491329},
                      {-10.4514, -30.491329},
                      {-10.4514, -9.52185},
                      {-40.62175, -9.52185},
                      {-40.62175, 0}},
                     {}})},
      {"el", centred({{{0, 0}, {30, 0}, {30, 10}, {10, 10}, {10, 20}, {0, 20}}, {}})},
      {"channel", centred({{{0, 0}, {24, 0}, {24, 15}, {19, 15}, {19, 5}, {7, 5}, {7, 11}, {0, 11}}, {}})},
      {"right triangle", centred({{{0, 0}, {31, 0}, {0, 17}}, {}})},
      {"rectangle", centred({{{0, 0}, {20, 0}, {20, 12}, {0, 12}}, {}})},
      {"thin", centred({{{0, 0}, {60, 0}, {61, 3}, {0, 2}}, {}})},
  };
  for (int i = 0; i < 6; ++i) list.push_back({"star " + std::to_string(i), centred(random_polygon(random, 20))});
  return list;
}

Obstacles wall() { return *make_obstacles({{{{{-1e5, -100}, {1e5, -100}, {1e5, 0}, {-1e5, 0}}, {}}, 0, true}}); }

double lowest(const Polygon& part, double theta) {
  double low = 0;
  for (const Point& p : part.outer) low = std::min(low, std::sin(theta) * p.x() + std::cos(theta) * p.y());
  return low;
}

struct Agreement {
  int same = 0, different = 0, marginal = 0, unfinished = 0;
  double worst_rad = 0;
};

// friction of the motion against that of the theory; drive in degrees.
Agreement compare(const Polygon& part, double drive_deg, double friction, double theory_friction, int starts) {
  const MovingShape moving = MovingShape::of({part}, gyration(part));
  const Obstacles obstacles = wall();
  const double angle = drive_deg * kPi / 180;
  const Drive drive{{std::cos(angle), std::sin(angle)}, friction};
  const PushFunction push = push_function(part.outer, theory_friction);
  Agreement agreement;
  for (int i = 0; i < starts; ++i) {
    const double theta = kTurn * i / starts;
    if (push.off_bounds(theta) < 1e-6 * kPi / 180) {
      ++agreement.marginal;
      continue;
    }
    ProjectionOptions options;
    options.keep_path = false;
    const Projection went = project(moving, obstacles, drive, {0, 1 - lowest(part, theta), theta}, options);
    if (went.end != ProjectionEnd::Steady) {
      ++agreement.unfinished;
      continue;
    }
    const double off = std::abs(std::remainder(went.last.theta_rad - push.rest(theta), kTurn));
    if (off < 1e-7) {
      ++agreement.same;
      agreement.worst_rad = std::max(agreement.worst_rad, off);
    } else {
      ++agreement.different;
    }
  }
  return agreement;
}

void check(const Agreement& agreement, int starts) {
  CHECK(agreement.same + agreement.marginal == starts);
  CHECK(agreement.different == 0);
  CHECK(agreement.unfinished == 0);
  CHECK(agreement.marginal <= 8);
}

}  // namespace

TEST_CASE("a plain wall turns 12 parts as the push function says: 720 starts each, three drives and frictions") {
  // Not 0.2: with it the el rests on one of its edges exactly at the edge's end.
  for (const Named& named : parts()) {
    for (const auto& [drive_deg, friction] : {std::pair(-30.0, 0.22), std::pair(-45.0, 0.0), std::pair(-10.0, 0.5)}) {
      CAPTURE(named.name, drive_deg, friction);
      check(compare(named.part, drive_deg, friction, friction, 720), 720);
    }
  }
}

TEST_CASE("a drive to the left leans the force to the other side") {
  for (const Named& named : parts()) {
    CAPTURE(named.name);
    check(compare(named.part, -150, 0.3, -0.3, 120), 120);
  }
}

TEST_CASE("the theory without friction is not the motion with it: the comparison can fail") {
  const Agreement agreement = compare(parts().front().part, -30, 0.2, 0.0, 720);
  CHECK(agreement.different > 10);
}

TEST_CASE("starts a hundredth of a degree beside every bound go to the rests on its two sides") {
  const double aside = 0.01 * kPi / 180;
  const Obstacles obstacles = wall();
  const Drive drive{{std::cos(-kPi / 6), std::sin(-kPi / 6)}, 0.22};
  for (const Named& named : parts()) {
    CAPTURE(named.name);
    const MovingShape moving = MovingShape::of({named.part}, gyration(named.part));
    const PushFunction push = push_function(named.part.outer, 0.22);
    REQUIRE(push.bounds_rad.size() == push.rests_rad.size());
    for (const double bound : push.bounds_rad) {
      for (const double theta : {bound - aside, bound + aside}) {
        const Projection went = project(moving, obstacles, drive, {0, 1 - lowest(named.part, theta), theta});
        CHECK(went.end == ProjectionEnd::Steady);
        CHECK(std::remainder(went.last.theta_rad - push.rest(theta), kTurn) == Approx(0).margin(1e-7));
      }
      // Either side has its own rest, unless there is only one.
      if (push.rests_rad.size() > 1) CHECK(push.rest(bound - aside) != push.rest(bound + aside));
    }
  }
}

TEST_CASE("the closed form of resting poses has the bounds and rests of the push function") {
  Random random(20261112);
  for (int i = 0; i < 500; ++i) {
    const Polygon part = centred(random_polygon(random, 20));
    const double friction = i % 2 ? uniform(random, 0, 0.5) : 0;
    const PushFunction push = push_function(part.outer, friction);
    const std::vector<WallPose> poses = wall_poses(part.outer, friction, {1e-9, 0});
    CAPTURE(i, friction);
    REQUIRE(poses.size() == push.rests_rad.size());
    for (std::size_t k = 0; k < poses.size(); ++k) {
      CHECK(poses[k].orientation_rad == Approx(push.rests_rad[k]).margin(1e-9));
      // Its basin: what the push function leads there.
      double below = kTurn, above = kTurn;
      for (const double bound : push.bounds_rad) {
        const auto way = [](double from, double to) { return std::fmod(to - from + 2 * kTurn, kTurn); };
        below = std::min(below, way(bound, push.rests_rad[k]));
        above = std::min(above, way(push.rests_rad[k], bound));
      }
      if (poses.size() > 1) CHECK(poses[k].basin_rad == Approx(below + above).margin(1e-9));
    }
  }
}
