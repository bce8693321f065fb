#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "analysis/geometry/boolean.hpp"
#include "analysis/resting/wall_poses.hpp"
#include "witness/feeder_specs.hpp"

using namespace formotion;
using namespace formotion::witness;

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

std::vector<feeder::StablePose> poses_of(feeder::PartSpec part) {
  return feeder::FeederProblem(feeder_spec(std::move(part), {gap(1)})).stable_poses({});
}

// Where a part that starts at this orientation comes to rest: it rolls over its lowest corner, by small steps.
double settled(const Loop& hull, double theta, double friction) {
  const double step = 1e-3;
  double last = 0;
  for (int i = 0; i < 20000; ++i) {
    const double c = std::cos(theta), s = std::sin(theta);
    double lowest = 1e300, ahead = 0;
    for (const Point& p : hull) {
      const double y = s * p.x() + c * p.y();
      if (y < lowest) {
        lowest = y;
        ahead = c * p.x() - s * p.y();
      }
    }
    const double direction = ahead > friction * -lowest ? 1 : -1;
    if (last * direction < 0) return theta;
    last = direction;
    theta += step * direction;
  }
  return theta;
}

// Whether a step may cross a pose and the corner beside it.
bool steps_over(const Loop& hull, double friction) {
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Point& a = hull[i];
    const Point& b = hull[(i + 1) % hull.size()];
    const Point along = (b - a).normalized();
    const double foot = -a.dot(along) + friction * cross(a, along);
    if (std::abs(foot) < 0.05 || std::abs(foot - (b - a).norm()) < 0.05) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("priors in closed form are those of settling by small steps: 30 parts and more, 1,500 starts each") {
  Random random(77);
  int parts = 0;
  for (int k = 0; k < 60; ++k) {
    const double friction = k % 2 ? uniform(random, 0, 0.4) : 0;
    Loop loop = random_polygon(random, 10).outer;
    const Point com = area_moments({loop, {}}).centroid + Point(uniform(random, -1, 1), uniform(random, -1, 1));
    for (Point& p : loop) p -= com;
    const auto poses = wall_poses(loop, friction, {1e-9, 0});
    const Loop hull = convex_hull(loop);
    if (locate(hull, Point::Zero(), 1e-6) != Side::Inside || steps_over(hull, friction)) continue;
    ++parts;
    std::vector<int> counts(poses.size(), 0);
    const int starts = 1500;
    for (int i = 0; i < starts; ++i) {
      const double at = settled(hull, kTurn * (i + 0.5) / starts, friction);
      for (std::size_t p = 0; p < poses.size(); ++p) {
        counts[p] += std::abs(std::remainder(at - poses[p].orientation_rad, kTurn)) < 5e-3;
      }
    }
    double sum = 0;
    for (std::size_t p = 0; p < poses.size(); ++p) {
      CAPTURE(k, p, friction);
      // Starts on a regular grid: each of a basin's two ends is off by one start at most, but for steps near the tops.
      CHECK(counts[p] == Approx(starts * poses[p].basin_rad / kTurn).margin(4));
      sum += poses[p].basin_rad;
    }
    CHECK(sum == Approx(kTurn).epsilon(1e-9));
  }
  CHECK(parts >= 30);
}

TEST_CASE("chords that stand for an arc make no poses of their own") {
  // A D: an arc of radius 10 closed by a flat, by chords of 2 degrees. Its centre of mass lies beyond the arc's centre
  // as seen from the flat, so that it rests on the flat or, like a ball with a weight in it, on the arc's middle.
  Loop d;
  for (int i = -63; i <= 63; ++i) {
    const double angle = (90 + 2.0 * i) * std::numbers::pi / 180;
    d.emplace_back(10 * std::cos(angle), 6 + 10 * std::sin(angle));
  }
  const Point com = area_moments({d, {}}).centroid;
  for (Point& p : d) p -= com;
  CHECK(wall_poses(d, 0, {1e-9, 0}).size() > 2);
  const auto poses = wall_poses(d, 0);
  REQUIRE(poses.size() == 2);
  CHECK(poses[0].orientation_rad == Approx(0).margin(1e-9));
  CHECK(poses[1].orientation_rad == Approx(std::numbers::pi).margin(0.04));
  CHECK(poses[0].basin_rad + poses[1].basin_rad == Approx(kTurn));
}

TEST_CASE("basins fill the circle for parts on a grid, whose centres of mass lie over corners") {
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    Loop loop = grid_polygon(random, 8).outer;
    const Box box = bounding_box(loop);
    const Point com(0.5 * below(random, static_cast<int>(2 * box.max.x()) + 1),
                    0.5 * below(random, static_cast<int>(2 * box.max.y()) + 1));
    for (Point& p : loop) p -= com;
    if (locate(convex_hull(loop), Point::Zero(), 1e-9) != Side::Inside) continue;
    double sum = 0;
    for (const WallPose& pose : wall_poses(loop, 0, {1e-9, 0})) sum += pose.basin_rad;
    CAPTURE(i, com.x(), com.y());
    REQUIRE(sum == Approx(kTurn).epsilon(1e-9));
  }
}

TEST_CASE("poses equal under rotational symmetry are one: hexagon, gear, rectangle") {
  Loop hexagon;
  for (int i = 0; i < 6; ++i) hexagon.emplace_back(10 * std::cos(i * kTurn / 6), 10 * std::sin(i * kTurn / 6));
  const auto of_hexagon = poses_of(flat_part(hexagon, false));
  REQUIRE(of_hexagon.size() == 1);
  CHECK(of_hexagon[0].prior == Approx(1).epsilon(1e-9));

  const auto of_gear = poses_of(flat_part(gear(12, 10, 12), false));
  double sum = 0;
  for (const auto& pose : of_gear) sum += pose.prior;
  CHECK(of_gear.size() == 2);  // on the tip of one tooth, and across two
  CHECK(sum == Approx(1).epsilon(1e-9));

  const auto of_rectangle = poses_of(flat_part(rectangle(0, 0, 20, 10), false));
  REQUIRE(of_rectangle.size() == 2);
  CHECK(of_rectangle[0].orientation_rad == Approx(0).margin(1e-12));
  CHECK(of_rectangle[0].prior == Approx(2 * std::atan2(20, 10) / std::numbers::pi).epsilon(1e-9));

  const auto flipped = poses_of(flat_part(rectangle(0, 0, 20, 10), true));
  CHECK(flipped.size() == 4);  // up and down are never one
}

TEST_CASE("a hole off the middle breaks the symmetry and moves the centre of mass") {
  const Loop hole{{14, 4}, {14, 6}, {17, 6}, {17, 4}};
  const auto poses = poses_of(flat_part(rectangle(0, 0, 20, 10), false, {hole}));
  REQUIRE(poses.size() == 4);
  double sum = 0;
  for (const auto& pose : poses) sum += pose.prior;
  CHECK(sum == Approx(1).epsilon(1e-9));
  CHECK(poses[1].com_wall_mm != Approx(poses[3].com_wall_mm).margin(0.1));
}

TEST_CASE("a part's hole takes its support away only where metal lies under nothing but the hole") {
  // A balcony holds the frame up by the hull of what lies on it, hole or no hole.
  const Loop hole{{6, 4}, {6, 11}, {18, 11}, {18, 4}};
  for (const double width : {7.6, 8.4}) {
    const auto framed = evaluated(
        feeder_spec(flat_part(rectangle(0, 0, 24, 16), false, {hole}, Point(12, 8)), {balcony(width, 90)}, 40));
    const auto filled =
        evaluated(feeder_spec(flat_part(rectangle(0, 0, 24, 16), false, {}, Point(12, 8)), {balcony(width, 90)}, 40));
    CHECK(framed.poses[0].outcome == filled.poses[0].outcome);
    CHECK(*framed.poses[0].margin_mm == Approx(*filled.poses[0].margin_mm));
    CHECK((framed.poses[0].outcome == feeder::Outcome::Delivered) == (width > 8));
  }
}

TEST_CASE("of a part in layers the footprint alone is supported, all layers meet the wall") {
  feeder::AspectSpec aspect;
  aspect.name = "foot";
  aspect.outline_mm = literal(rectangle(0, 0, 30, 16));
  aspect.height_mm = 8;
  aspect.com_mm = Point(12, 8);
  aspect.layers = {{0, 3, literal(rectangle(6, 3, 16, 12)), {}}, {3, 8, literal(rectangle(0, 0, 30, 16)), {}}};
  const feeder::PartSpec part{{aspect}};
  const auto outcome = [&](feeder::DesignSpec design) {
    return evaluated(feeder_spec(part, design, 40)).poses[0].outcome;
  };
  REQUIRE(poses_of(part)[0].com_wall_mm == Approx(8));
  // The foot's nose is 4 mm ahead of the centre, its heel 6 mm behind.
  CHECK(outcome({gap(3.999)}) == feeder::Outcome::Delivered);
  CHECK(outcome({gap(4.001)}) != feeder::Outcome::Delivered);
  // It begins 3 mm off the wall: a narrower balcony touches nothing.
  CHECK(outcome({balcony(2.9, 90)}) != feeder::Outcome::Delivered);
  CHECK(outcome({balcony(8.1, 90)}) == feeder::Outcome::Delivered);
}

TEST_CASE("a pose on a real edge is kept however shallow, an arc's chords make one pose at most") {
  // 20 x 10, the centre of mass 0.2 mm inside the end of the long edge: a rise of 0.0025 mm leads out of that pose.
  const auto poses =
      evaluated(feeder_spec(flat_part(rectangle(0, 0, 20, 10), false, {}, Point(19.8, 8)), {gap(1)})).poses;
  REQUIRE(poses.size() == 4);
  CHECK(poses[0].prior == Approx(0.2).margin(0.02));
  // A quarter disc of 90 chords: it rests on its straight edges and, since its centre of mass lies between the arc and
  // the arc's centre, on the middle of the arc.
  Loop quarter{{0, 0}};
  for (int i = 0; i <= 90; ++i) {
    const double angle = i * std::numbers::pi / 180;
    quarter.emplace_back(8 * std::cos(angle), 8 * std::sin(angle));
  }
  const auto of_disc = evaluated(feeder_spec(flat_part(quarter, false), {gap(1)})).poses;
  REQUIRE(of_disc.size() == 3);
  CHECK(of_disc[0].prior + of_disc[1].prior + of_disc[2].prior == Approx(1));
}
