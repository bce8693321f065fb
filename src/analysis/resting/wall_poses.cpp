#include "analysis/resting/wall_poses.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace formotion {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

double wrapped(double angle) {  // [0, 2 pi), with 2 pi - rounding taken as 0
  angle = std::fmod(angle, kTurn);
  if (angle < 0) angle += kTurn;
  return kTurn - angle < 1e-12 ? 0 : angle + 0.0;  // no -0
}

// The work that leads out of a pose to the unstable equilibrium on either side, over the weight (mm). Without friction
// that is the rise of the centre of mass. While a corner p is on the wall the work is |p| (1 - cos) of the angle to the
// orientation in which p balances (derived: the moment about p of a force along the leaning line).
struct WaysOut {
  double behind_mm = 0, ahead_mm = 0;  // to the bound of smaller, of larger orientation
};

// Orientation in which the leaning line through the centre of mass meets corner p on the wall.
double balance(const Point& p, double friction) {
  return -0.5 * std::numbers::pi + std::atan(friction) - std::atan2(p.y(), p.x());
}

// The work from where corner k touches the wall beside its edge at this orientation, turning in this sense (+1: over
// corners k, k - 1, ...; -1: over k, k + 1, ...), up to the first corner that balances.
double work_out(const Loop& hull, std::size_t k, double orientation, int sense, double friction) {
  const std::size_t n = hull.size();
  double work = 0;
  for (std::size_t steps = 0; steps < n; ++steps) {
    const Point& p = hull[k];
    const std::size_t next = sense > 0 ? (k + n - 1) % n : (k + 1) % n;
    const Point in = p - hull[(k + n - 1) % n], out = hull[(k + 1) % n] - p;
    const double turn = std::atan2(cross(in, out), in.dot(out));
    // Signed by the sense of turning: how far ahead the corner balances.
    const double ahead = sense * std::remainder(balance(p, friction) - orientation, kTurn);
    if (ahead >= 0 && ahead <= turn) return work + p.norm() * (1 - std::cos(ahead));
    work += p.norm() * (std::cos(ahead - turn) - std::cos(ahead));
    orientation += sense * turn;
    k = next;
  }
  return work;
}

// Poses out of which less work than shallow_mm leads are none: their basin goes to the neighbour on that side.
// bounds[i] and bounds[i + 1] enclose poses[i].
void give_up_shallow(std::vector<WallPose>& poses, std::vector<double>& bounds, std::vector<WaysOut>& ways,
                     double shallow_mm) {
  while (poses.size() > 1) {
    std::size_t pose = 0;
    double least = shallow_mm;
    bool is_ahead = false;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      for (const bool ahead : {false, true}) {
        const double work = ahead ? ways[i].ahead_mm : ways[i].behind_mm;
        if (work >= least) continue;
        least = work;
        pose = i;
        is_ahead = ahead;
      }
    }
    if (least >= shallow_mm) return;
    const std::size_t count = poses.size();
    if (is_ahead) {
      ways[(pose + 1) % count].behind_mm += ways[pose].behind_mm - ways[pose].ahead_mm;
    } else {
      ways[(pose + count - 1) % count].ahead_mm += ways[pose].ahead_mm - ways[pose].behind_mm;
    }
    const auto at = static_cast<std::ptrdiff_t>(pose);
    poses.erase(poses.begin() + at);
    ways.erase(ways.begin() + at);
    bounds.erase(bounds.begin() + static_cast<std::ptrdiff_t>((pose + is_ahead) % count));
    if (bounds.front() > poses.front().orientation_rad) {
      bounds.insert(bounds.begin(), bounds.back() - kTurn);
      bounds.pop_back();
    }
  }
}

}  // namespace

bool is_chord(const Loop& hull, std::size_t from, double shallow_mm) {
  const std::size_t n = hull.size();
  const auto edge = [&](std::size_t k) -> Point { return hull[(k + 1) % n] - hull[k % n]; };
  const auto turn = [](const Point& a, const Point& b) { return std::atan2(cross(a, b), a.dot(b)); };
  const Point before = edge(from + n - 1), here = edge(from), after = edge(from + 1);
  return here.norm() * std::max(turn(before, here), turn(here, after)) / 8 < shallow_mm;
}

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
  std::vector<double> bounds;
  for (std::size_t i = 0; i < n; ++i) {
    const Point& p = hull[i];
    const Point& before = hull[(i + n - 1) % n];
    const Point& after = hull[(i + 1) % n];
    const bool falls_back = foot_on(before, p) < (p - before).norm() - tolerance_mm;
    const bool falls_forward = foot_on(p, after) > tolerance_mm;
    if (falls_back && falls_forward) bounds.push_back(wrapped(balance(p, friction)));
  }
  if (poses.empty()) return poses;
  if (bounds.size() != poses.size()) {  // a single pose without a way out of it
    poses.front().basin_rad = kTurn;
    return {poses.front()};
  }
  std::sort(bounds.begin(), bounds.end());
  // Turned so that pose i lies between bounds i and i + 1.
  while (bounds.front() > poses.front().orientation_rad) {
    bounds.insert(bounds.begin(), bounds.back() - kTurn);
    bounds.pop_back();
  }
  std::vector<WaysOut> ways;
  for (const WallPose& pose : poses) {
    const auto from = static_cast<std::size_t>(std::find(hull.begin(), hull.end(), pose.edge_from) - hull.begin());
    if (!is_chord(hull, from, options.shallow_mm)) {
      ways.push_back({std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()});
      continue;
    }
    ways.push_back({work_out(hull, (from + 1) % n, pose.orientation_rad, -1, friction),
                    work_out(hull, from, pose.orientation_rad, +1, friction)});
  }
  give_up_shallow(poses, bounds, ways, options.shallow_mm);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double upper = i + 1 < bounds.size() ? bounds[i + 1] : bounds.front() + kTurn;
    poses[i].basin_rad = upper - bounds[i];
    poses[i].basin_from_rad = wrapped(bounds[i]);
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
