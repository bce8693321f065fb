// Where turning parts lose their support, against dense samples along their paths.
#include "applications/feeder/path_support.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "analysis/geometry/boolean.hpp"
#include "applications/feeder/pose_travel.hpp"
#include "applications/feeder/turning_track.hpp"
#include "witness/feeder_specs.hpp"

using namespace formotion;
using namespace formotion::witness;
using feeder::Outcome;

namespace {

feeder::FeatureSpec fence(const Loop& polygon) { return {feeder::Fence{literal(polygon)}, {}}; }
feeder::FeatureSpec pin(double x, double y, double diameter) {
  return {feeder::Pin{literal(x), literal(y), literal(diameter)}, {}};
}

// Ramps and pins that turn parts, over voids.
feeder::FeederSpec random_guided(std::uint64_t seed) {
  Random random(seed);
  feeder::DesignSpec design;
  const double foot = uniform(random, 20, 60);
  design.push_back(at(fence({{-5, -2}, {foot, -2}, {foot, uniform(random, 4, 25)}}), 0));
  if (below(random, 2)) design.push_back(at(pin(foot + uniform(random, 5, 40), uniform(random, 5, 30), 5), 0));
  for (int i = 0, n = 1 + below(random, 3); i < n; ++i) {
    const Point where(uniform(random, -10, foot + 30), uniform(random, -5, 20));
    if (below(random, 2)) {
      design.push_back(at(cutout(placed(random_polygon(random, 24), 0, where).outer), 0));
    } else {
      design.push_back(at(cutout(rectangle(where.x(), where.y(), where.x() + uniform(random, 8, 45),
                                           where.y() + uniform(random, 5, 30))),
                          0));
    }
  }
  feeder::FeederSpec spec =
      feeder_spec(flat_part(below(random, 2) ? bibazu_l() : random_polygon(random, 17).outer, false), design,
                  uniform(random, 30, 60));
  spec.environment.wall_friction = uniform(random, 0, 0.3);
  if (below(random, 3) == 0) spec.environment.tilt_rad = uniform(random, -0.1, 0.15);
  return spec;
}

struct Tally {
  int losses = 0, kept = 0, turning_losses = 0, late = 0, early = 0, marginal = 0;
  double worst_mm = 0;
};

// The margin by generators on the whole track, nothing grown, nothing looked up.
double margin_at(const AspectShape& shape, const Track& track, double shift, const Configuration& q) {
  return support_margin(placed(shape.footprint, q.theta_rad, q.position()), track, {q.x_mm, q.y_mm - shift})
      .value_or(-1e9);
}

void compare(std::uint64_t seed, Tally& tally) {
  const feeder::FeederSpec spec = random_guided(seed);
  const auto part = feeder::part_model(spec.part, spec.environment, {});
  const auto layout = feeder::lay_out(spec.designs[0], spec.environment, {}, part.diameter_mm, {});
  auto track = feeder::TurningTrack::of(part, layout, spec.environment);
  REQUIRE(track);
  const auto groups = feeder::grouped(layout, part.longest_mm);
  std::vector<Loop> loops;
  Box box;
  for (const auto& group : groups) {
    loops.insert(loops.end(), group.loops.begin(), group.loops.end());
    for (const Loop& loop : group.loops) {
      for (const Point& p : loop) box.include(p);
    }
  }
  const Track whole{spec.environment.track_width_mm, united(loops)};
  const feeder::Floor floor = feeder::Floor::of(groups, spec.environment.track_width_mm, {});
  const AspectShape& shape = part.shapes[0];
  const double shift = feeder::wall_shift(shape.com_height_mm, spec.environment), reach = track->world(0).part.reach_mm;
  for (const feeder::PoseModel& pose : part.poses) {
    const Configuration start = track->pose_start(pose);
    feeder::PathSupport support(shape, floor, spec.environment);
    std::optional<double> sampled_loss;  // work of the drive, which grows along every path
    double found_loss = 0;
    bool turning = false, doubtful = false;
    double least = 1e9;
    const Drive& drive = track->world(0).drive;
    ProjectionOptions options;
    options.max_branching = 0;
    options.watch = [&](const PathStretch& stretch) -> std::optional<double> {
      const Configuration a = stretch.at(0), b = stretch.at(1);
      // Beyond the last void nothing is lost that was not lost before.
      const double length = (a.position() - b.position()).norm() + reach * std::abs(a.theta_rad - b.theta_rad);
      const double worth = std::min(length, 2 * (box.max.x() - box.min.x()) + 4 * reach + 400);
      const int samples = std::max(2, static_cast<int>(std::ceil(worth / 0.01)));
      for (int i = 0; i <= samples && !sampled_loss; ++i) {
        const double t = worth / length * i / samples;
        const Configuration q = stretch.at(std::min(1.0, t));
        if (q.x_mm + reach < box.min.x() || q.x_mm - reach > box.max.x()) continue;
        const double margin = margin_at(shape, whole, shift, q);
        least = std::min(least, margin);
        if (margin >= -1e-9) continue;
        sampled_loss = drive.force.dot(q.position());
        turning = a.theta_rad != b.theta_rad;
      }
      const auto ends = support(stretch);
      if (ends) {
        const Configuration lost = stretch.at(*ends);
        found_loss = drive.force.dot(lost.position());
        // A hair on, since losses begin with a margin of 0.
        const Configuration on = stretch.at(std::min(1.0, *ends + 2e-3 / std::max(1e-9, length)));
        doubtful = std::min(margin_at(shape, whole, shift, lost), margin_at(shape, whole, shift, on)) > 1e-4;
        return ends;
      }
      // Seen by samples alone: the rest of the path does not matter.
      return sampled_loss ? std::optional<double>(1) : std::nullopt;
    };
    const Projection path = project(track->world(0).part, track->world(0).obstacles, drive, start, options);
    if (path.end == ProjectionEnd::Ambiguous || path.end == ProjectionEnd::Undecided) continue;
    CAPTURE(seed, pose.stable.orientation_rad, least, sampled_loss.has_value(), support.losses().size());
    const bool lost = !support.losses().empty();
    if (support.marginal() && lost != sampled_loss.has_value()) {
      ++tally.marginal;
      continue;
    }
    if (!lost && !sampled_loss) {
      ++tally.kept;
      continue;
    }
    if (lost && !sampled_loss) {  // between samples, or the margin just touches 0
      ++tally.early;
      CHECK_FALSE(doubtful);
      continue;
    }
    if (!lost) {
      ++tally.late;
      FAIL_CHECK("a loss that samples see is not found");
      continue;
    }
    ++tally.losses;
    tally.turning_losses += turning;
    // Not later than the samples, nor earlier than the one before; 0.01 mm of motion is less of the drive's work.
    CHECK(std::abs(found_loss - *sampled_loss) < 0.012);
    tally.worst_mm = std::max(tally.worst_mm, std::abs(found_loss - *sampled_loss));
  }
}

}  // namespace

TEST_CASE("first losses of support lie where samples every 0.01 mm see them: 25 random tracks with fences and voids") {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 25; ++seed) compare(seed, tally);
  CAPTURE(tally.losses, tally.kept, tally.turning_losses, tally.late, tally.early, tally.marginal, tally.worst_mm);
  CHECK(tally.losses > 20);
  CHECK(tally.kept > 10);
  CHECK(tally.turning_losses > 3);
  CHECK(tally.early <= 2);
  CHECK(tally.marginal <= 2);
}

TEST_CASE("a part that a ramp turns over a hole falls where the same part on plain floor passes") {
  // Beside the ramp's end, where the L comes round: a hole under it. Without the ramp the L does not reach it.
  const feeder::DesignSpec ramp{at(fence({{-5, -2}, {40, -2}, {40, 15}}), 0)};
  const auto plain = evaluated(feeder_spec(flat_part(bibazu_l(), false), ramp, 60));
  feeder::DesignSpec holed = ramp;
  holed.push_back(at(cutout(rectangle(36, -1, 110, 61)), 0));
  const auto lost = evaluated(feeder_spec(flat_part(bibazu_l(), false), holed, 60));
  REQUIRE(plain.poses.size() == lost.poses.size());
  int delivered = 0;
  for (std::size_t i = 0; i < plain.poses.size(); ++i) {
    if (plain.poses[i].outcome != Outcome::Delivered) continue;
    ++delivered;
    CHECK(lost.poses[i].outcome == Outcome::Rejected);
    REQUIRE(lost.poses[i].decided_by);
    CHECK(lost.poses[i].decided_by->feature == 1);
  }
  CHECK(delivered > 0);
}
