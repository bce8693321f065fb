// Belts: no pull to the wall, parts come in every orientation, and fences turn them.
#include <algorithm>
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

// A slanted bar, 8 mm thick, that starts at `from` and hangs over to where it guides parts to.
feeder::FeatureSpec bar(const Point& from, double angle_rad, double length) {
  const Point along(std::cos(angle_rad), std::sin(angle_rad));
  const Point back = (angle_rad > 0 ? -8 : 8) * Point(-along.y(), along.x());
  return at({feeder::Fence{literal(Loop{from, from + length * along, from + length * along + back, from + back})}, {}},
            0);
}

feeder::FeederSpec belt(const Loop& outline, feeder::DesignSpec design, double friction = 0.2) {
  feeder::FeederSpec spec = feeder_spec(flat_part(outline, false), std::move(design), 200);
  spec.environment.drive_rad = 0;
  spec.environment.wall_friction = friction;
  return spec;
}

feeder::DesignSpec two_bars() { return {bar({0, 55}, 35 * kTurn / 360, 130), bar({130, 180}, -50 * kTurn / 360, 90)}; }

double widths(const feeder::FeederEvaluation& evaluation) {
  double sum = 0;
  for (const feeder::MapInterval& interval : evaluation.outcome_map) sum += interval.width_rad();
  return sum;
}

}  // namespace

TEST_CASE("a belt's map covers all orientations, and efficiency is what its intervals deliver into the goal pose") {
  const feeder::FeederSpec spec = belt(bibazu_l(), two_bars());
  REQUIRE(feeder::is_belt(spec.environment));
  const auto evaluation = evaluated(spec);
  CHECK(widths(evaluation) == Approx(kTurn));
  CHECK(evaluation.outcome_map.size() > 1);
  const auto part = feeder::part_model(spec.part, spec.environment, {});
  const auto layout = feeder::lay_out(spec.designs[0], spec.environment, {}, part.diameter_mm, {});
  auto track = feeder::TurningTrack::of(part, layout, spec.environment);
  REQUIRE(track);
  // Of those that an edge has guided out, the orientation in which most leave.
  std::vector<std::pair<double, double>> leaving;  // orientation, share
  double delivered = 0, jammed = 0;
  for (const feeder::MapInterval& interval : evaluation.outcome_map) {
    const double share = interval.width_rad() / kTurn;
    jammed += interval.outcome == Outcome::Jammed ? share : 0;
    if (interval.outcome != Outcome::Delivered) continue;
    delivered += share;
    if (!track->travel(0, track->belt_start(interval.sample_rad)).settled) continue;
    const auto known = std::find_if(leaving.begin(), leaving.end(), [&](const auto& way) {
      return std::abs(std::remainder(way.first - *interval.exit_orientation_rad, kTurn)) < 2e-4;
    });
    if (known == leaving.end()) {
      leaving.emplace_back(*interval.exit_orientation_rad, share);
    } else {
      known->second += share;
    }
  }
  CHECK(evaluation.metrics.jam_probability == Approx(jammed).margin(1e-9));
  double best = 0;
  for (const auto& way : leaving) best = std::max(best, way.second);
  CHECK(best > 0);
  CHECK(evaluation.metrics.efficiency == Approx(best).margin(1e-9));
  if (delivered > 0) CHECK(*evaluation.metrics.purity == Approx(best / delivered));
}

TEST_CASE("every start on a belt ends as the map says: 700 starts on three belts") {
  Random random(20261311);
  int compared = 0;
  for (const double friction : {0.0, 0.2, 0.35}) {
    const feeder::FeederSpec spec =
        belt(friction == 0.2 ? random_polygon(random, 16).outer : bibazu_l(), two_bars(), friction);
    const auto evaluation = evaluated(spec);
    const auto part = feeder::part_model(spec.part, spec.environment, {});
    const auto layout = feeder::lay_out(spec.designs[0], spec.environment, {}, part.diameter_mm, {});
    auto track = feeder::TurningTrack::of(part, layout, spec.environment);
    REQUIRE(track);
    for (int k = 0; k < 240; ++k) {
      const double theta = uniform(random, 0, kTurn);
      const feeder::MapInterval* inside = nullptr;
      double off = kTurn;
      for (const feeder::MapInterval& interval : evaluation.outcome_map) {
        const double into = std::fmod(theta - interval.from_rad + kTurn, kTurn);
        if (into <= interval.width_rad()) inside = &interval;
        off = std::min(off, std::abs(std::remainder(theta - interval.from_rad, kTurn)));
      }
      REQUIRE(inside);
      if (off < 1e-6) continue;
      const feeder::StartTravel travel = track->travel(0, track->belt_start(theta));
      CAPTURE(friction, theta, travel.reason);
      CHECK(travel.outcome == inside->outcome);
      if (travel.outcome == Outcome::Delivered && travel.settled && inside->exit_orientation_rad)
        CHECK(std::abs(std::remainder(*travel.exit_rad - *inside->exit_orientation_rad, kTurn)) < 2e-4);
      ++compared;
    }
  }
  CHECK(compared > 700);
}

TEST_CASE("a belt whose fences nothing meets leaves parts as they come: in no goal pose") {
  const auto evaluation = evaluated(belt(bibazu_l(), {bar({0, 400}, 0.5, 30)}));
  REQUIRE(evaluation.outcome_map.size() == 1);
  CHECK(evaluation.outcome_map[0].outcome == Outcome::Delivered);
  CHECK(evaluation.metrics.efficiency == 0);
  CHECK(evaluation.goal_pose == -1);
  CHECK_FALSE(evaluation.feasible);
}

TEST_CASE("a belt blocked across its whole width jams every part") {
  feeder::FeatureSpec block = at({feeder::Fence{literal(rectangle(0, -20, 20, 300))}, {}}, 0);
  const auto evaluation = evaluated(belt(bibazu_l(), {block}));
  for (const feeder::MapInterval& interval : evaluation.outcome_map)
    CHECK((interval.outcome == Outcome::Jammed || interval.thin));
  CHECK(evaluation.metrics.jam_probability == Approx(1).margin(1e-6));
}

TEST_CASE("a rectangle's map on a belt repeats after half a turn") {
  const auto evaluation = evaluated(belt(rectangle(0, 0, 34, 14), two_bars(), 0.1));
  const auto outcome = [&](double theta) {
    for (const feeder::MapInterval& interval : evaluation.outcome_map) {
      if (std::fmod(theta - interval.from_rad + 2 * kTurn, kTurn) <= interval.width_rad()) return interval.outcome;
    }
    return Outcome::Undecided;
  };
  double off = 1;
  for (int k = 0; k < 500; ++k) {
    const double theta = kTurn * (k + 0.5) / 1000;
    bool near = false;
    for (const feeder::MapInterval& interval : evaluation.outcome_map) {
      for (const double turn : {0.0, kTurn / 2}) {
        off = std::abs(std::remainder(theta + turn - interval.from_rad, kTurn));
        near = near || off < 1e-6;
      }
    }
    if (near) continue;
    CAPTURE(theta);
    CHECK(outcome(theta) == outcome(theta + kTurn / 2));
  }
}
