#include "analysis/resting/pose_ranges.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace formotion {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

struct Foot {
  double from = 0, to = 0;  // where the leaning line may meet the edge, from its beginning
  double length = 0, height = 0;
};

struct Bound {
  bool possible = false, sure = false;
  double spread_rad = 0;
};

class Ranges {
 public:
  Ranges(const Loop& hull, const PoseErrors& errors) : hull_(hull), errors_(errors) {
    const double f0 = errors.friction_from, f1 = errors.friction_to;
    const double off = errors.com_mm * std::hypot(1, f1) + errors.outline_mm * (1 + f1);
    const std::size_t n = hull.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Point& a = hull[i];
      const Point edge = hull[(i + 1) % n] - a;
      const Point along = edge.normalized();
      Foot foot;
      foot.length = edge.norm();
      foot.height = cross(a, along);
      const double f0_height = f0 * foot.height, f1_height = f1 * foot.height;
      foot.from = -a.dot(along) + std::min(f0_height, f1_height) - off;
      foot.to = -a.dot(along) + std::max(f0_height, f1_height) + off;
      feet_.push_back(foot);
    }
    const double moved = errors.com_mm + errors.outline_mm;
    may_leave_ = std::any_of(feet_.begin(), feet_.end(), [&](const Foot& foot) { return foot.height <= moved; });
    for (std::size_t i = 0; i < n; ++i) {
      const Foot &before = feet_[(i + n - 1) % n], &after = feet_[i];
      bounds_.push_back({before.from < before.length && after.to > 0, before.to < before.length && after.from > 0,
                         std::asin(std::min(1.0, moved / std::max(hull[i].norm(), 1e-12)))});
    }
  }

  bool possible(std::size_t edge) const {
    const Foot& foot = feet_[edge];
    return foot.to > 0 && foot.from < foot.length && foot.height + errors_.com_mm + errors_.outline_mm > 0;
  }
  bool always(std::size_t edge, double tolerance_mm) const {
    const Foot& foot = feet_[edge];
    return !may_leave_ && foot.from > tolerance_mm && foot.to < foot.length - tolerance_mm &&
           foot.height - errors_.com_mm - errors_.outline_mm > tolerance_mm;
  }
  // From the nearest corner behind the edge to the nearest ahead of it that may bound, or surely bounds, its basin.
  double basin(std::size_t edge, bool surely) const {
    const std::size_t n = hull_.size();
    if (may_leave_) return surely ? kTurn : 0;
    double width = 0;
    for (const bool ahead : {false, true}) {
      std::size_t corner = ahead ? (edge + 1) % n : edge;
      for (std::size_t steps = 0; !is_bound(corner, surely); ++steps) {
        if (steps == n) return kTurn;
        const std::size_t next = ahead ? (corner + 1) % n : (corner + n - 1) % n;
        width += ahead ? seen(corner, next) : seen(next, corner);
        corner = next;
      }
      width += surely ? bounds_[corner].spread_rad : -bounds_[corner].spread_rad;
    }
    return std::clamp(width + seen(edge, (edge + 1) % n), 0.0, kTurn);
  }

 private:
  bool is_bound(std::size_t corner, bool surely) const {
    return surely ? bounds_[corner].sure : bounds_[corner].possible;
  }
  // The angle from corner to corner, as the centre of mass sees it.
  double seen(std::size_t from, std::size_t to) const {
    return std::atan2(cross(hull_[from], hull_[to]), hull_[from].dot(hull_[to]));
  }

  const Loop& hull_;
  const PoseErrors& errors_;
  std::vector<Foot> feet_;
  std::vector<Bound> bounds_;
  bool may_leave_ = false;  // the centre of mass may lie outside of the hull: then nothing is known of basins
};

}  // namespace

std::vector<PoseRange> pose_ranges(const Loop& points, const PoseErrors& errors, const std::vector<WallPose>& drawn) {
  const WallPoseOptions options;
  const Loop hull = convex_hull(points);
  const Ranges ranges(hull, errors);
  std::vector<PoseRange> result;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Point &a = hull[i], &b = hull[(i + 1) % hull.size()];
    const auto pose =
        std::find_if(drawn.begin(), drawn.end(), [&](const WallPose& p) { return p.edge_from == a && p.edge_to == b; });
    const bool is_drawn = pose != drawn.end();
    if (!is_drawn && (!ranges.possible(i) || is_chord(hull, i, options.shallow_mm))) continue;
    const Point along = (b - a).normalized();
    const double orientation = std::fmod(-std::atan2(along.y(), along.x()) + kTurn, kTurn);
    PoseRange range{is_drawn ? pose->orientation_rad : orientation, cross(a, along)};
    range.always = ranges.always(i, options.tolerance_mm);
    range.least_basin_rad = range.always ? ranges.basin(i, false) : 0;
    range.most_basin_rad = ranges.basin(i, true);
    result.push_back(range);
  }
  std::sort(result.begin(), result.end(),
            [](const PoseRange& a, const PoseRange& b) { return a.orientation_rad < b.orientation_rad; });
  return result;
}

}  // namespace formotion
