// Tracks with fences, pins and wall profiles end to end: what evaluate() says of parts that may turn.
#include "applications/feeder/turning.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "analysis/geometry/boolean.hpp"
#include "witness/feeder_specs.hpp"

using namespace formotion;
using namespace formotion::witness;
using feeder::Outcome;

namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kDegree = kTurn / 360;

feeder::FeatureSpec fence(const Loop& polygon) { return {feeder::Fence{literal(polygon)}, {}}; }
feeder::FeatureSpec pin(double x, double y, double diameter) {
  return {feeder::Pin{literal(x), literal(y), literal(diameter)}, {}};
}
feeder::FeatureSpec wall_profile(const Loop& line) { return {feeder::WallProfile{literal(line)}, {}}; }

// The foot goes on below the wall's face: a tip of no angle on the wall would be one more thing to meet.
feeder::DesignSpec ramp_and_pin(double radius) {
  return {at(fence({{-5, -1.875}, {40, -1.875}, {40, 15}}), 0), at(pin(85, 34, 2 * radius), 0)};
}

const feeder::PoseResult& pose_at(const feeder::FeederEvaluation& evaluation, double deg) {
  for (const feeder::PoseResult& pose : evaluation.poses) {
    if (std::abs(std::remainder(pose.orientation_rad - deg * kDegree, kTurn)) < 0.1 * kDegree) return pose;
  }
  FAIL("no pose at " << deg);
  return evaluation.poses.front();
}

// Intervals cover each aspect's circle and share their ends; each one's sample ends as it says.
void check_map(const feeder::FeederEvaluation& evaluation) {
  REQUIRE_FALSE(evaluation.outcome_map.empty());
  for (std::size_t i = 0; i < evaluation.outcome_map.size();) {
    std::size_t end = i;
    double width = 0;
    while (end < evaluation.outcome_map.size() &&
           evaluation.outcome_map[end].aspect == evaluation.outcome_map[i].aspect)
      width += evaluation.outcome_map[end++].width_rad();
    CHECK(width == Approx(kTurn));
    for (std::size_t k = i; k < end; ++k) {
      const std::size_t next = k + 1 < end ? k + 1 : i;
      if (next != k) CHECK(evaluation.outcome_map[k].to_rad == evaluation.outcome_map[next].from_rad);
    }
    i = end;
  }
}

void check_sums(const feeder::FeederEvaluation& evaluation) {
  double sum = 0, delivered = 0, jammed = 0;
  for (const feeder::PoseResult& pose : evaluation.poses) {
    sum += pose.prior;
    if (pose.outcome == Outcome::Delivered) delivered += pose.prior;
    if (pose.outcome == Outcome::Jammed) jammed += pose.prior;
    CHECK(pose.exit_orientation_rad.has_value() == (pose.outcome == Outcome::Delivered));
  }
  CHECK(sum == Approx(1));
  CHECK(evaluation.metrics.jam_probability == Approx(jammed).margin(1e-12));
  CHECK(evaluation.metrics.efficiency <= delivered + 1e-12);
  if (delivered > 0) CHECK(*evaluation.metrics.purity == Approx(evaluation.metrics.efficiency / delivered));
}

}  // namespace

TEST_CASE("the L-part at a ramp and a pin: the pose at 34.8 degrees jams, as in two-dimensional dynamics") {
  const auto evaluation = evaluated(feeder_spec(flat_part(bibazu_l(), false), ramp_and_pin(2)));
  check_map(evaluation);
  check_sums(evaluation);
  REQUIRE(evaluation.poses.size() == 3);
  const feeder::PoseResult& jammed = pose_at(evaluation, 34.8);
  CHECK(jammed.outcome == Outcome::Jammed);
  REQUIRE(jammed.decided_by);
  CHECK_FALSE(jammed.reason.empty());
  CHECK_FALSE(evaluation.feasible);
}

TEST_CASE("whatever leaves along the wall leaves in a stable pose") {
  Random random(20261301);
  int delivered = 0, turned = 0, jammed = 0;
  for (int i = 0; i < 25; ++i) {
    const double foot = uniform(random, 20, 70), height = uniform(random, 3, 30);
    feeder::DesignSpec design{
        at(fence({{-5, -2}, {foot, -2}, {foot, height}}), 0),
        at(pin(foot + uniform(random, 10, 60), uniform(random, 4, 30), uniform(random, 2, 8)), 0)};
    const bool flips = below(random, 2) == 0;
    feeder::FeederSpec spec =
        feeder_spec(flat_part(below(random, 2) ? bibazu_l() : random_polygon(random, 18).outer, flips), design, 80);
    // Poses that rest against a wall that drags at them as it does on the way.
    spec.environment.wall_friction = spec.environment.settling_friction = uniform(random, 0, 0.4);
    const auto evaluation = evaluated(spec);
    CAPTURE(i);
    check_map(evaluation);
    check_sums(evaluation);
    for (const feeder::PoseResult& pose : evaluation.poses) {
      jammed += pose.outcome == Outcome::Jammed;
      if (pose.outcome != Outcome::Delivered) continue;
      ++delivered;
      const bool stable =
          std::any_of(evaluation.poses.begin(), evaluation.poses.end(), [&](const feeder::PoseResult& other) {
            return other.aspect == pose.aspect &&
                   std::abs(std::remainder(other.orientation_rad - *pose.exit_orientation_rad, kTurn)) < 0.01 * kDegree;
          });
      CHECK(stable);
      turned += std::abs(std::remainder(pose.orientation_rad - *pose.exit_orientation_rad, kTurn)) > kDegree;
    }
  }
  CHECK(delivered > 25);
  CHECK(turned > 8);
  CHECK(jammed > 8);
}

TEST_CASE("an obstacle that no part can reach leaves 120 tracks of voids as they are") {
  int compared = 0, lost = 0;
  for (std::uint64_t seed = 1; seed <= 120; ++seed) {
    Random random(seed);
    feeder::FeederSpec passive = random_feeder(random);
    const auto is_blade = [](const feeder::FeatureSpec& feature) {
      return std::holds_alternative<feeder::Wiper>(feature.shape) ||
             std::holds_alternative<feeder::HoldDown>(feature.shape);
    };
    std::erase_if(passive.designs.front(), is_blade);
    // Voids alone know poses, that no friction at the wall turns.
    passive.environment.settling_friction = passive.environment.wall_friction = 0;
    feeder::FeederSpec guarded = passive;
    guarded.designs.front().push_back(at(pin(0, 500, 4), 0));
    const auto a = evaluated(passive), b = evaluated(guarded);
    CAPTURE(seed);
    REQUIRE(a.poses.size() == b.poses.size());
    for (std::size_t i = 0; i < a.poses.size(); ++i) {
      const feeder::PoseResult &pose = a.poses[i], &other = b.poses[i];
      CAPTURE(i, name(pose.outcome), name(other.outcome));
      if (pose.marginal) continue;
      ++compared;
      lost += pose.outcome != Outcome::Delivered;
      CHECK(pose.outcome == other.outcome);
      CHECK(pose.prior == other.prior);
      if (pose.outcome == Outcome::Delivered && other.outcome == Outcome::Delivered) {
        REQUIRE(other.margin_mm);
        CHECK(*other.margin_mm == Approx(*pose.margin_mm).margin(1e-6));
        CHECK(std::abs(std::remainder(*other.exit_orientation_rad - pose.orientation_rad, kTurn)) < 1e-9);
      }
      if (pose.decided_by && other.decided_by && pose.outcome != Outcome::Delivered) {
        CHECK(pose.decided_by->x_mm == Approx(other.decided_by->x_mm).margin(1e-6));
      }
    }
  }
  CHECK(compared > 300);
  CHECK(lost > 100);
}

TEST_CASE("fences inside the wall and straight wall profiles change nothing") {
  const auto plain = evaluated(feeder_spec(flat_part(bibazu_l(), true), {at(pin(0, 500, 4), 0)}));
  const std::vector<feeder::DesignSpec> designs{
      {at(fence({{0, -10}, {30, -10}, {30, 0}, {0, 0}}), 0)},
      {at(fence({{0, -10}, {30, -10}, {30, -1}, {0, -3}}), 0)},
      {at(wall_profile({{0, 0}, {20, 0}, {50, 0}}), 0)},
  };
  for (const feeder::DesignSpec& design : designs) {
    const auto evaluation = evaluated(feeder_spec(flat_part(bibazu_l(), true), design));
    if (!evaluation.violations.empty() && evaluation.poses.empty()) continue;
    REQUIRE(evaluation.poses.size() == plain.poses.size());
    for (std::size_t i = 0; i < plain.poses.size(); ++i) {
      CHECK(evaluation.poses[i].outcome == Outcome::Delivered);
      CHECK(std::abs(std::remainder(*evaluation.poses[i].exit_orientation_rad - plain.poses[i].orientation_rad,
                                    kTurn)) < 1e-9);
    }
  }
}

TEST_CASE("a low ramp lifts parts and sets them down again as they were, a block in the way stops them all") {
  const auto lifted = evaluated(
      feeder_spec(flat_part(rectangle(0, 0, 40, 10), false), {at(fence({{-5, -0.1}, {400, -0.1}, {400, 8}}), 0)}, 80));
  check_map(lifted);
  const auto& poses = lifted.poses;
  REQUIRE_FALSE(poses.empty());
  const auto stopped =
      evaluated(feeder_spec(flat_part(bibazu_l(), true), {at(fence({{0, -5}, {10, -5}, {10, 200}, {0, 200}}), 0)}, 80));
  check_sums(stopped);
  for (const feeder::PoseResult& pose : stopped.poses) {
    CHECK(pose.outcome == Outcome::Jammed);
    REQUIRE(pose.decided_by);
    CHECK(pose.decided_by->feature == 0);
  }
  CHECK(stopped.metrics.jam_probability == Approx(1));
  CHECK(stopped.metrics.efficiency == 0);
}

TEST_CASE("a wiper on a track with a fence still rejects by height, wherever the part is") {
  // Flat blocks pass below; those on edge are 18 mm high.
  for (const bool wiper_first : {true, false}) {
    feeder::DesignSpec design;
    if (wiper_first) {
      design = {at(wiper(10), 0), at(fence({{60, -2}, {100, -2}, {100, 6}}), 0)};
    } else {
      design = {at(fence({{-5, -2}, {40, -2}, {40, 6}}), 0), at(wiper(10), 120)};
    }
    const auto evaluation = evaluated(feeder_spec(block(), design, 80));
    check_sums(evaluation);
    int edges = 0, flats = 0;
    for (const feeder::PoseResult& pose : evaluation.poses) {
      CAPTURE(wiper_first, pose.aspect, pose.orientation_rad, pose.reason);
      if (pose.aspect == "edge") {
        ++edges;
        CHECK(pose.outcome != Outcome::Delivered);
        if (pose.outcome == Outcome::Rejected) {
          REQUIRE(pose.decided_by);
          CHECK(pose.decided_by->feature == (wiper_first ? 0 : 1));
        }
      } else {
        ++flats;
        CHECK(pose.outcome != Outcome::Rejected);
      }
    }
    CHECK(edges > 0);
    CHECK(flats > 0);
  }
}

TEST_CASE("scores and evaluations of turning parts agree, and the work counts projections") {
  const feeder::FeederSpec spec = feeder_spec(flat_part(bibazu_l(), false), ramp_and_pin(1.8));
  const feeder::FeederProblem problem(spec);
  const auto evaluation = problem.evaluate(0, {});
  const Score score = problem.score({0, {}});
  CHECK(score.feasible == evaluation.feasible);
  CHECK(score.work >= static_cast<std::int64_t>(evaluation.poses.size()));
  const auto again = problem.evaluate(0, {});
  REQUIRE(again.poses.size() == evaluation.poses.size());
  for (std::size_t i = 0; i < again.poses.size(); ++i) {
    CHECK(again.poses[i].outcome == evaluation.poses[i].outcome);
    CHECK(again.poses[i].exit_orientation_rad == evaluation.poses[i].exit_orientation_rad);
  }
}

TEST_CASE("rows of transition matrices hold one exit each, and chain to what the whole track does") {
  const feeder::FeederSpec spec =
      feeder_spec(flat_part(bibazu_l(), false),
                  {at(fence({{-5, -2}, {40, -2}, {40, 15}}), 0), at(fence({{295, -2}, {340, -2}, {340, 25}}), 0)}, 90);
  const auto part = feeder::part_model(spec.part, spec.environment, {});
  const auto layout = feeder::lay_out(spec.designs[0], spec.environment, {}, part.diameter_mm, {});
  const auto matrices = feeder::transition_matrices(part, layout, spec.environment);
  REQUIRE(matrices.size() == 2);
  const auto evaluation = evaluated(spec);
  for (std::size_t i = 0; i < part.poses.size(); ++i) {
    std::vector<double> state(part.poses.size(), 0);
    state[i] = 1;
    for (const auto& matrix : matrices) {
      std::vector<double> next(state.size(), 0);
      for (std::size_t a = 0; a < state.size(); ++a) {
        double row = 0;
        for (std::size_t b = 0; b < state.size(); ++b) {
          next[b] += state[a] * matrix[a][b];
          row += matrix[a][b];
        }
        CHECK((row == 0 || row == 1));
      }
      state = next;
    }
    const feeder::PoseResult& pose = evaluation.poses[i];
    for (std::size_t b = 0; b < state.size(); ++b) {
      const bool leaves = pose.outcome == Outcome::Delivered &&
                          std::abs(std::remainder(*pose.exit_orientation_rad - part.poses[b].stable.orientation_rad,
                                                  kTurn)) < 0.01 * kDegree;
      CHECK(state[b] == (leaves ? 1 : 0));
    }
  }
}
