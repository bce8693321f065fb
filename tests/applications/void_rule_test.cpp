#include "applications/feeder/void_rule.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "analysis/geometry/boolean.hpp"
#include "witness/feeder_specs.hpp"
#include "witness/sampled_track.hpp"

using namespace formotion;
using namespace formotion::witness;
using feeder::Outcome;

namespace {

feeder::PartSpec plate(double length, double width, double thickness) {
  feeder::PartSpec part = flat_part(rectangle(0, 0, length, width), false);
  part.aspects[0].height_mm = thickness;
  return part;
}
// The pose on the long edge.
feeder::PoseResult first_pose(feeder::PartSpec part, feeder::DesignSpec design, double speed = 50) {
  feeder::FeederSpec spec = feeder_spec(std::move(part), std::move(design), 40);
  spec.environment.conveying_speed_mm_s = speed;
  return evaluated(spec).poses[0];
}
Outcome outcome(feeder::PartSpec part, feeder::DesignSpec design) {
  return first_pose(std::move(part), std::move(design)).outcome;
}

}  // namespace

TEST_CASE("a gap takes a lost cube iff it is as long as the cube is thick, or as long as the cube is thin edgewise") {
  // 10 x 10 on the wall, lost from a gap of 5 on.
  CHECK(outcome(plate(10, 10, 12), {gap(4.9)}) == Outcome::Delivered);
  CHECK(outcome(plate(10, 10, 12), {gap(11.9)}) == Outcome::Jammed);
  CHECK(outcome(plate(10, 10, 12), {gap(12.1)}) == Outcome::Rejected);
  CHECK(outcome(plate(10, 10, 5.5), {gap(5.6)}) == Outcome::Rejected);
  CHECK(outcome(plate(10, 10, 5.7), {gap(5.6)}) == Outcome::Jammed);
}

TEST_CASE("a closed slot lets a plate through iff plate and thickness fit along the tipping line") {
  // The plate of 20 x 10 tips over the slot's front lip, which runs across: it needs 10 across by its thickness along.
  CHECK(outcome(plate(20, 10, 3), {slot(-1, 30, 11)}) == Outcome::Rejected);
  CHECK(outcome(plate(20, 10, 10.9), {slot(-1, 30, 11)}) == Outcome::Rejected);
  CHECK(outcome(plate(20, 10, 11.1), {slot(-1, 30, 11)}) == Outcome::Jammed);
}

TEST_CASE("a canyon with lips lets a plate through edgewise, or jams it where it is narrower than the plate is thick") {
  // The lip at y = 2 does not reach the centre at y = 5, and the plate's top at 10 does not reach the far lip.
  CHECK(outcome(plate(20, 10, 3), {canyon(2, 30, 100)}) == Outcome::Rejected);
  CHECK(outcome(plate(20, 10, 8.9), {canyon(2, 10.5, 100)}) == Outcome::Jammed);
  CHECK(outcome(plate(20, 10, 8.4), {canyon(2, 10.5, 100)}) == Outcome::Rejected);
  CHECK(outcome(plate(20, 10, 3), {canyon(2, 9.5, 100)}) == Outcome::Delivered);  // the far lip carries it
}

TEST_CASE("a hole shorter than the plate along the tipping line does not let it through") {
  // Lost over the lip y = 2 where the canyon is as long as the plate: the plate of 20 does not fit along a length
  // of 19.
  const Polygon window{rectangle(0, 2, 19, 30), {}};
  CHECK_FALSE(feeder::holds_rectangle(window, {1, 0}, 20, 3));
  CHECK(feeder::holds_rectangle(window, {1, 0}, 19, 3));
  CHECK(feeder::holds_rectangle(window, {0, 1}, 20, 3));
}

TEST_CASE("over the free edge everything falls, however thick") {
  CHECK(outcome(plate(20, 10, 30), {balcony(4, 100)}) == Outcome::Rejected);
  feeder::FeederSpec narrow = feeder_spec(plate(20, 10, 30), {gap(1)}, 4.9);  // the track itself is too narrow
  CHECK(evaluated(narrow).poses[0].outcome == Outcome::Rejected);
}

TEST_CASE("rectangles in random polygons, with and without holes, are those found by trying places: 600 cases") {
  Random random(12);
  int yes = 0, no = 0;
  for (int i = 0; i < 600; ++i) {
    Polygon polygon = i % 3 ? random_polygon(random, 12) : Polygon{convex_hull(random_polygon(random, 12).outer), {}};
    if (i % 4 == 0) {
      Polygon holed = polygon;
      holed.holes.push_back({{-1, -1}, {-1, 1}, {1, 1}, {1, -1}});
      if (!defect(holed)) polygon = holed;
    }
    const double angle = uniform(random, 0, 6.28), length = uniform(random, 1, 14), width = uniform(random, 0.5, 8);
    const Point direction(std::cos(angle), std::sin(angle));
    const int tried = fits_by_trying(polygon, direction, length, width);
    if (tried < 0) continue;
    CAPTURE(i);
    REQUIRE(feeder::holds_rectangle(polygon, direction, length, width) == (tried == 1));
    (tried ? yes : no) += 1;
  }
  CHECK(yes > 60);
  CHECK(no > 60);
}

TEST_CASE("a nose that lands on the far edge before it has dropped by the thickness may catch") {
  CHECK(first_pose(plate(20, 10, 3), {gap(10.3)}).may_catch);       // 0.3 mm of travel
  CHECK_FALSE(first_pose(plate(20, 10, 3), {gap(200)}).may_catch);  // far away
  CHECK_FALSE(first_pose(plate(20, 10, 3), {balcony(4, 100)}).may_catch ==
              first_pose(plate(20, 10, 3), {gap(10.3)}).may_catch);
}

TEST_CASE(
    "unsupported travel over a gap is its excess over the nose's reach, twice; tipping follows the equation of "
    "motion") {
  const feeder::PoseResult lost = first_pose(plate(20, 10, 3), {gap(12)});
  // The centre leaves the lip 2 mm before the nose lands; the tail leaves it 2 mm before the centre is over metal.
  CHECK(*lost.unsupported_mm == Approx(4).margin(1e-6));
  CHECK(*lost.margin_mm == Approx(2).margin(1e-6));
  const double d = 2, r = 10, rho2 = 20.0 * 20 / 12 + 3.0 * 3 / 12, g = 9810, v = 50;
  CHECK(*lost.tip_mm == Approx(v * std::sqrt(2 * (rho2 + d * d) / (g * d * r))).epsilon(1e-6));
  // Integrated without the small-angle step: the centre stays d beyond the edge, the weight's lever is d cos(angle).
  double angle = 0, rate = 0, time = 0;
  const double step = 1e-6;
  while (r * std::sin(angle) < 1) {
    rate += step * g * d * std::cos(angle) / (rho2 + d * d);
    angle += step * rate;
    time += step;
  }
  CHECK(*lost.tip_mm == Approx(v * time).epsilon(5e-3));
}

TEST_CASE("a faster track gives less time to tip, and may make that a violation") {
  feeder::FeederSpec spec = feeder_spec(plate(20, 10, 3), {gap(10.05)}, 40);
  spec.goal.require_tip = true;
  const auto has_no_time = [](const feeder::FeederEvaluation& e) {
    return std::any_of(e.violations.begin(), e.violations.end(), [](const feeder::Violation& v) {
      return v.what == "a lost pose has no time to tip" && v.by > 0;
    });
  };
  CHECK(has_no_time(evaluated(spec)));
  spec.designs[0] = {gap(60)};
  CHECK_FALSE(has_no_time(evaluated(spec)));
  spec.designs[0] = {gap(10.05)};
  spec.goal.require_tip = false;
  const auto unasked = evaluated(spec);
  CHECK_FALSE(has_no_time(unasked));
  CHECK_FALSE(unasked.warnings.empty());
}

TEST_CASE("what a jammed pose lacks is what its void lacks: the slope that a search follows") {
  const auto lacking = [](double to_mm) {
    // On the long edge, its centre of mass 10 mm from the wall: the slot takes it from 10 mm on, and is too narrow for
    // 12 mm of thickness until it is as wide.
    const auto evaluation = evaluated(feeder_spec(plate(30, 20, 12), {slot(-1, to_mm, 60)}, 40));
    for (const auto& violation : evaluation.violations) {
      if (violation.what == "a pose jams" && violation.where.find(" 0.00 deg") != std::string::npos)
        return violation.by;
    }
    return 0.0;
  };
  // (Drawn from below the wall: a slot from 0 would leave the wall's line as a lip.)
  CHECK(lacking(10.5) == Approx(1.5));
  CHECK(lacking(11.5) == Approx(0.5));
  CHECK(lacking(12.1) == 0);
}

TEST_CASE("a block on the track stops the poses that reach it, and leaves those that pass beside it alone") {
  const auto evaluate_with = [](const Loop& obstacle, feeder::DesignSpec before) {
    before.push_back({feeder::Drawing{"", {}, {obstacle}}, std::nullopt});
    return evaluated(feeder_spec(plate(30, 10, 3), std::move(before), 60));
  };
  const auto reached = evaluate_with(rectangle(0, 5, 10, 20), {});
  CHECK_FALSE(reached.feasible);
  for (const auto& pose : reached.poses) CHECK(pose.outcome == Outcome::Jammed);
  // 10 mm high on the long edge, 30 mm on the short one.
  const auto beside = evaluate_with(rectangle(0, 12, 10, 20), {});
  CHECK(beside.poses[0].outcome == Outcome::Delivered);
  CHECK(beside.poses[1].outcome == Outcome::Jammed);
  // A gap before it takes all of them first.
  const auto gone = evaluate_with(rectangle(0, 5, 10, 20), {gap(50)});
  for (const auto& pose : gone.poses) CHECK(pose.outcome == Outcome::Rejected);
}
