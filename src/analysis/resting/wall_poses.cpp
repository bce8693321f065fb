#include "analysis/resting/wall_poses.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace formotion {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

double wrapped(double angle) {  // [0, 2 pi), with 2 pi - rounding taken as 0
  angle = std::fmod(angle, kTurn);
  if (angle < 0) angle += kTurn;
  return kTurn - angle < 1e-12 ? 0 : angle + 0.0;  // no -0
}

// An unstable equilibrium between two poses.
struct Bound {
  double orientation_rad = 0;
  double height_mm = 0;  // of the centre of mass, along the leaning line
};

// Poses out of which a rise of less than shallow_mm leads are none: their basin goes to the neighbour on that side.
// lean: by how much the leaning line is longer than its height. bounds[i] and bounds[i + 1] enclose poses[i].
void give_up_shallow(std::vector<WallPose>& poses, std::vector<Bound>& bounds, double lean, double shallow_mm) {
  while (poses.size() > 1) {
    std::size_t pose = 0, way_out = 0;
    double least = shallow_mm;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      for (const std::size_t bound : {i, (i + 1) % bounds.size()}) {
        const double rise = bounds[bound].height_mm - lean * poses[i].com_wall_mm;
        if (rise >= least) continue;
        least = rise;
        pose = i;
        way_out = bound;
      }
    }
    if (least >= shallow_mm) return;
    poses.erase(poses.begin() + static_cast<std::ptrdiff_t>(pose));
    bounds.erase(bounds.begin() + static_cast<std::ptrdiff_t>(way_out));
    if (bounds.front().orientation_rad > poses.front().orientation_rad) {
      bounds.insert(bounds.begin(), bounds.back());
      bounds.front().orientation_rad -= kTurn;
      bounds.pop_back();
    }
  }
}

}  // namespace

std::vector<WallPose> wall_poses(const Loop& points, double friction, const WallPoseOptions& options) {
  const double tolerance_mm = options.tolerance_mm;
  const Loop hull = convex_hull(points);
  const std::size_t n = hull.size();
  std::vector<WallPose> poses;
  // Where the leaning line meets an edge that lies on the wall, from the edge's beginning: on the wall the edge runs
  // along +x, and friction moves the place ahead of the foot of the perpendicular.
  const auto foot_on = [friction](const Point& from, const Point& to) {
    const Point along = (to - from).normalized();
    return -from.dot(along) + friction * cross(from, along);
  };
  for (std::size_t i = 0; i < n; ++i) {
    const Point& a = hull[i];
    const Point& b = hull[(i + 1) % n];
    const Point along = (b - a).normalized();
    const double height = cross(a, along);  // of the centre of mass (the origin) over the edge's line
    if (height <= tolerance_mm) continue;
    const double foot = foot_on(a, b);
    if (foot <= tolerance_mm || foot >= (b - a).norm() - tolerance_mm) continue;
    poses.push_back({wrapped(-std::atan2(along.y(), along.x())), height, 0, a, b});
  }
  std::sort(poses.begin(), poses.end(),
            [](const WallPose& a, const WallPose& b) { return a.orientation_rad < b.orientation_rad; });

  // Unstable equilibria: corners from which the part falls back onto the edge behind and forward onto the edge ahead.
  std::vector<Bound> bounds;
  for (std::size_t i = 0; i < n; ++i) {
    const Point& p = hull[i];
    const Point& before = hull[(i + n - 1) % n];
    const Point& after = hull[(i + 1) % n];
    const bool falls_back = foot_on(before, p) < (p - before).norm() - tolerance_mm;
    const bool falls_forward = foot_on(p, after) > tolerance_mm;
    if (falls_back && falls_forward) {
      bounds.push_back({wrapped(-0.5 * std::numbers::pi + std::atan(friction) - std::atan2(p.y(), p.x())), p.norm()});
    }
  }
  if (poses.empty()) return poses;
  if (bounds.size() != poses.size()) {  // a single pose without a way out of it
    poses.front().basin_rad = kTurn;
    return {poses.front()};
  }
  std::sort(bounds.begin(), bounds.end(),
            [](const Bound& a, const Bound& b) { return a.orientation_rad < b.orientation_rad; });
  // Turned so that pose i lies between bounds i and i + 1.
  while (bounds.front().orientation_rad > poses.front().orientation_rad) {
    bounds.insert(bounds.begin(), bounds.back());
    bounds.front().orientation_rad -= kTurn;
    bounds.pop_back();
  }
  give_up_shallow(poses, bounds, std::hypot(1, friction), options.shallow_mm);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double upper = i + 1 < bounds.size() ? bounds[i + 1].orientation_rad : bounds.front().orientation_rad + kTurn;
    poses[i].basin_rad = upper - bounds[i].orientation_rad;
  }
  return poses;
}

std::vector<WallPose> merged_by_symmetry(const std::vector<WallPose>& poses, int order) {
  std::vector<WallPose> merged;
  const double period = kTurn / order;
  for (const WallPose& pose : poses) {
    const auto same = std::find_if(merged.begin(), merged.end(), [&](const WallPose& other) {
      return std::abs(std::remainder(pose.orientation_rad - other.orientation_rad, period)) < 1e-6;
    });
    if (same == merged.end()) {
      merged.push_back(pose);
    } else {
      same->basin_rad += pose.basin_rad;
    }
  }
  return merged;
}

}  // namespace formotion
