// How far obstacles may be off: just below the tolerance everything ends as it did, just above it something does not.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "analysis/geometry/boolean.hpp"
#include "applications/feeder/turning.hpp"
#include "witness/feeder_specs.hpp"

using namespace formotion;
using namespace formotion::witness;
using feeder::Outcome;

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

feeder::FeatureSpec fence(const Loop& polygon) { return {feeder::Fence{literal(polygon)}, {}}; }
feeder::FeatureSpec pin(double x, double y, double diameter) {
  return {feeder::Pin{literal(x), literal(y), literal(diameter)}, {}};
}

struct Design {
  feeder::FeederSpec spec;
  feeder::PartModel part;
  feeder::Layout layout;
  feeder::TurningEvaluation nominal;
  double tolerance_mm = 0;
};

Design designed(const feeder::FeederSpec& spec) {
  Design design;
  design.spec = spec;
  design.part = feeder::part_model(spec.part, spec.environment, {});
  design.layout = feeder::lay_out(spec.designs[0], spec.environment, {}, design.part.diameter_mm, {});
  design.nominal = feeder::travel_all_turning(design.part, design.layout, spec.environment, false);
  design.tolerance_mm =
      feeder::turning_tolerance(design.part, design.layout, spec.environment, design.nominal).tolerance_mm;
  return design;
}

// Whether all poses end as they do without errors, with obstacles off by e and voids by `voids`.
bool all_alike(const Design& design, double e, double voids) {
  auto track = feeder::TurningTrack::of(design.part, design.layout, design.spec.environment, {e, voids});
  if (!track) return false;
  for (std::size_t i = 0; i < design.part.poses.size(); ++i) {
    const feeder::PoseResult& before = design.nominal.poses[i].result;
    const bool delivered = before.outcome == Outcome::Delivered;
    if (voids != 0 && delivered != (voids > 0)) continue;
    const feeder::StartTravel travel = track->travel(0, track->pose_start(design.part.poses[i]));
    if (travel.outcome != before.outcome) return false;
    if (!delivered) continue;
    if (std::abs(std::remainder(*travel.exit_rad - *before.exit_orientation_rad, kTurn)) > 2e-4) return false;
    if (voids != 0 && travel.margin_mm < std::abs(voids)) return false;
  }
  return true;
}

feeder::FeederSpec random_guided(std::uint64_t seed) {
  Random random(seed);
  const double foot = uniform(random, 20, 60);
  feeder::DesignSpec design{at(fence({{-5, -3}, {foot, -3}, {foot, uniform(random, 6, 25)}}), 0),
                            at(pin(foot + uniform(random, 10, 50), uniform(random, 4, 30), uniform(random, 4, 9)), 0)};
  return feeder_spec(flat_part(below(random, 2) ? bibazu_l() : el_outline(), false), design, 80);
}

}  // namespace

TEST_CASE(
    "below the tolerance of obstacles all poses end alike for both signs, and above it one does not: 30 designs") {
  int limited = 0;
  double largest = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const Design design = designed(random_guided(seed));
    CAPTURE(seed, design.tolerance_mm);
    largest = std::max(largest, design.tolerance_mm);
    for (const double share : {0.999, 0.9, 0.6, 0.3, 0.05}) {
      const double e = share * design.tolerance_mm;
      if (e == 0) continue;
      // Outcomes are not monotone in e: what holds at a rung of the ladder and at the tolerance need not in between.
      const bool below_it = all_alike(design, e, 0) && all_alike(design, -e, 0);
      if (share > 0.99) CHECK(below_it);
    }
    if (design.tolerance_mm > 4.99) continue;
    ++limited;
    const double above = design.tolerance_mm + 1.2e-3;  // it is found to 1e-3
    CHECK_FALSE((all_alike(design, above, 0) && all_alike(design, -above, 0)));
  }
  CHECK(limited > 15);
  CHECK(largest > 0.1);
}

TEST_CASE("every rung of the ladder up to the tolerance holds: 0.01 mm times powers of sqrt 2") {
  int rungs = 0;
  for (std::uint64_t seed = 101; seed <= 112; ++seed) {
    const Design design = designed(random_guided(seed));
    CAPTURE(seed, design.tolerance_mm);
    for (double e = 0.01; e < std::min(design.tolerance_mm - 1e-3, 5.0); e *= std::numbers::sqrt2) {
      CAPTURE(e);
      CHECK(all_alike(design, e, 0));
      CHECK(all_alike(design, -e, 0));
      ++rungs;
    }
  }
  CHECK(rungs > 20);
}

TEST_CASE("with voids the tolerance is at most the delivered margin, and holds with voids off as well") {
  int compared = 0;
  for (std::uint64_t seed = 201; seed <= 215; ++seed) {
    feeder::FeederSpec spec = random_guided(seed);
    Random random(seed);
    spec.designs[0].push_back(
        at(cutout(rectangle(150, uniform(random, 2, 8), 150 + uniform(random, 4, 30), uniform(random, 9, 16))), 0));
    const Design design = designed(spec);
    CAPTURE(seed, design.tolerance_mm);
    for (const feeder::PoseTravel& pose : design.nominal.poses) {
      if (pose.result.outcome == Outcome::Delivered) CHECK(design.tolerance_mm <= pose.nominal_mm + 1e-9);
    }
    const double e = 0.999 * design.tolerance_mm;
    if (e < 1e-3) continue;
    ++compared;
    for (const double obstacles : {e, -e}) {
      for (const double voids : {e, -e}) CHECK(all_alike(design, obstacles, voids));
    }
  }
  CHECK(compared > 5);
}

TEST_CASE("a gate's tolerance is known: a pin over the path, by what the part passes it with") {
  // A low bar that passes beneath a pin by 1.5 mm: a pin grown by more stops it. Smaller ones never do.
  feeder::FeederSpec spec = feeder_spec(flat_part(rectangle(0, 0, 40, 10), false), {at(pin(0, 14.5, 6), 0)}, 80);
  const Design design = designed(spec);
  bool flat_delivered = false;
  for (const feeder::PoseTravel& pose : design.nominal.poses) {
    const double sine = std::abs(std::sin(pose.result.orientation_rad));
    if (sine < 1e-6) flat_delivered = pose.result.outcome == Outcome::Delivered;
  }
  CHECK(flat_delivered);
  CHECK(design.tolerance_mm <= 1.5 + 1e-3);
  CHECK_FALSE((all_alike(design, 1.6, 0)));
}

TEST_CASE("fences thinner than twice the error vanish, and are no track then") {
  feeder::FeederSpec spec =
      feeder_spec(flat_part(el_outline(), false), {at(fence({{0, 30}, {40, 31}, {40, 31.8}, {0, 30.8}}), 0)}, 80);
  const auto part = feeder::part_model(spec.part, spec.environment, {});
  const auto layout = feeder::lay_out(spec.designs[0], spec.environment, {}, part.diameter_mm, {});
  CHECK(feeder::TurningTrack::of(part, layout, spec.environment, {-0.3, 0}));
  CHECK_FALSE(feeder::TurningTrack::of(part, layout, spec.environment, {-0.5, 0}));
  CHECK(feeder::TurningTrack::of(part, layout, spec.environment, {0.5, 0}));
}
