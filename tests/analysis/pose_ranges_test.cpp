// Poses of uncertain parts: every pose of every member is foreseen, with a basin between the bounds.
#include "analysis/resting/pose_ranges.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "witness/random_shapes.hpp"

using namespace formotion;
using namespace formotion::witness;

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

Loop about(const Loop& loop, const Point& com) {
  Loop moved;
  for (const Point& p : loop) moved.push_back(p - com);
  return moved;
}

}  // namespace

TEST_CASE("without errors every pose always is, and its basin is known") {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Random random(seed);
    const Polygon part = random_polygon(random, 20);
    const Loop points = about(part.outer, area_moments(part).centroid);
    const double friction = uniform(random, 0, 0.3);
    const std::vector<WallPose> drawn = wall_poses(points, friction);
    const std::vector<PoseRange> ranges = pose_ranges(points, {friction, friction, 0, 0}, drawn);
    REQUIRE(ranges.size() == drawn.size());
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      CHECK(ranges[i].always);
      CHECK(ranges[i].orientation_rad == drawn[i].orientation_rad);
      CHECK(ranges[i].least_basin_rad == Approx(drawn[i].basin_rad));
      CHECK(ranges[i].most_basin_rad == Approx(drawn[i].basin_rad));
    }
  }
}

TEST_CASE("every pose of 40 members of 100 random parts is foreseen, with a basin between its bounds") {
  int poses = 0, sometimes = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Random random(seed);
    const Polygon part = random_polygon(random, 20);
    const Loop points = about(part.outer, area_moments(part).centroid);
    const PoseErrors errors{0.05, uniform(random, 0.05, 0.4), uniform(random, 0, 1.5), 0};
    const std::vector<PoseRange> ranges =
        pose_ranges(points, errors, wall_poses(points, uniform(random, 0.05, errors.friction_to)));
    for (const PoseRange& range : ranges) sometimes += !range.always;
    for (int k = 0; k < 40; ++k) {
      const double angle = uniform(random, 0, kTurn), far = k % 2 ? errors.com_mm : uniform(random, 0, errors.com_mm);
      const Loop member = about(points, far * Point(std::cos(angle), std::sin(angle)));
      const std::vector<WallPose> found =
          wall_poses(member, uniform(random, errors.friction_from, errors.friction_to), {1e-9, 0});
      std::vector<bool> seen(ranges.size(), false);
      for (const WallPose& pose : found) {
        const auto range = std::find_if(ranges.begin(), ranges.end(), [&](const PoseRange& r) {
          return std::abs(std::remainder(r.orientation_rad - pose.orientation_rad, kTurn)) < 1e-9;
        });
        REQUIRE(range != ranges.end());
        seen[static_cast<std::size_t>(range - ranges.begin())] = true;
        CHECK(pose.basin_rad >= range->least_basin_rad - 1e-9);
        CHECK(pose.basin_rad <= range->most_basin_rad + 1e-9);
        ++poses;
      }
      for (std::size_t i = 0; i < ranges.size(); ++i) CHECK((seen[i] || !ranges[i].always));
    }
  }
  CHECK(poses > 8000);
  CHECK(sometimes > 20);
}
