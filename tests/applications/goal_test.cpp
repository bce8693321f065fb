#include <catch2/catch.hpp>
#include <numbers>

#include "analysis/geometry/boolean.hpp"
#include "witness/feeder_specs.hpp"

using namespace formotion;
using namespace formotion::witness;
using feeder::Outcome;

namespace {

feeder::FeederSpec el_with_goal(const std::string& aspect, double orientation_deg, feeder::DesignSpec design) {
  feeder::FeederSpec spec = feeder_spec(flat_part(el_outline(), true), std::move(design), 40);
  spec.goal.one_pose = false;
  spec.goal.aspect = aspect;
  spec.goal.orientation_rad = orientation_deg * std::numbers::pi / 180;
  return spec;
}

}  // namespace

TEST_CASE("a goal of one face counts the mirror pose as wrong, a goal of any face both as right") {
  const auto up = evaluated(el_with_goal("up", 0, {balcony(9, 60)}));
  const double prior = up.poses[0].prior;
  CHECK(up.metrics.efficiency == Approx(prior));
  CHECK(*up.metrics.purity == Approx(0.5));
  CHECK_FALSE(up.feasible);
  const auto any = evaluated(el_with_goal("any", 0, {balcony(9, 60)}));
  CHECK(any.metrics.efficiency == Approx(2 * prior));
  CHECK(*any.metrics.purity == Approx(1));
  CHECK(any.feasible);
}

TEST_CASE("where nothing is delivered there is no purity, no efficiency and no feasible design") {
  const auto none = evaluated(el_with_goal("up", 0, {gap(100)}));
  CHECK_FALSE(none.metrics.purity.has_value());
  CHECK(none.metrics.efficiency == 0);
  CHECK_FALSE(none.feasible);
}

TEST_CASE("one pose: the delivered pose of largest prior is the goal, others are wrong") {
  const auto evaluation = evaluated(feeder_spec(flat_part(bibazu_l(), false), {balcony(14.5, 100)}, 60));
  REQUIRE(evaluation.goal_pose >= 0);
  for (const auto& pose : evaluation.poses) {
    if (pose.outcome == Outcome::Delivered) CHECK(pose.prior <= evaluation.poses[evaluation.goal_pose].prior);
  }
  CHECK(evaluation.metrics.efficiency == Approx(0.411).margin(5e-4));
  CHECK(*evaluation.metrics.purity == Approx(0.411 / (0.411 + 0.343)).margin(1e-3));
  CHECK_FALSE(evaluation.feasible);
}

TEST_CASE("a goal may name any of the orientations that symmetry makes equal") {
  for (const double orientation : {0.0, 180.0}) {
    feeder::FeederSpec spec = feeder_spec(flat_part(rectangle(0, 0, 20, 10), false), {balcony(7, 60)}, 40);
    spec.goal.one_pose = false;
    spec.goal.aspect = "up";
    spec.goal.orientation_rad = orientation * std::numbers::pi / 180;
    CHECK_FALSE(feeder::goal_defect(spec).has_value());
    const auto evaluation = evaluated(spec);
    CHECK(evaluation.feasible);
    CHECK(evaluation.goal_pose == 0);
  }
}

TEST_CASE("a goal that no stable pose answers is named with the poses that there are") {
  feeder::FeederSpec spec = el_with_goal("up", 45, {balcony(9, 60)});
  REQUIRE(feeder::goal_defect(spec).has_value());
  spec.goal.orientation_rad = 2e-6 * std::numbers::pi / 180;
  CHECK(feeder::goal_defect(spec).has_value());
  spec.goal.orientation_rad = 0.5e-6 * std::numbers::pi / 180;
  CHECK_FALSE(feeder::goal_defect(spec).has_value());
}

TEST_CASE("the feed rate is 60 v efficiency over the prior-weighted length of arriving poses") {
  feeder::FeederSpec spec = feeder_spec(flat_part(rectangle(0, 0, 20, 10), false), {balcony(7, 60)}, 40);
  spec.environment.conveying_speed_mm_s = 80;
  const auto evaluation = evaluated(spec);
  const double lying = evaluation.poses[0].prior;
  REQUIRE(evaluation.metrics.efficiency == Approx(lying));
  CHECK(*evaluation.metrics.feed_rate_per_min == Approx(60 * 80 * lying / (20 * lying + 10 * (1 - lying))));
}
