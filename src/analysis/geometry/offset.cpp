#include "analysis/geometry/offset.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/geometry/boolean.hpp"

namespace formotion {
namespace {

constexpr double kStraight = 1e-12;  // sine of the turn below which a corner counts as straight

Point right_normal(const Point& a, const Point& b) {
  const Point t = (b - a).normalized();
  return {t.y(), -t.x()};
}

bool is_convex(const Loop& loop) {
  const std::size_t n = loop.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (cross(loop[(i + 1) % n] - loop[i], loop[(i + 2) % n] - loop[(i + 1) % n]) < 0) return false;
  }
  return true;
}

// The corners of the tangents around the arc from normal n_in to n_out about corner.
void append_arc(Loop& out, const Point& corner, const Point& n_in, const Point& n_out, double delta,
                const OffsetOptions& options) {
  const double start = std::atan2(n_in.y(), n_in.x());
  const double turn = std::atan2(cross(n_in, n_out), n_in.dot(n_out));
  const double side = turn < 0 ? -1 : 1;
  const double sweep = std::abs(turn);
  std::vector<double> angles;  // measured from n_in, along the turn
  const int steps = std::max(1, static_cast<int>(std::ceil(sweep / options.arc_step_rad - 1e-9)));
  for (int i = 0; i <= steps; ++i) angles.push_back(sweep * i / steps);
  bool extra = false;
  for (const ArcTangent& tangent : options.tangents) {
    if ((tangent.corner - corner).squaredNorm() > 1e-18) continue;
    // A shrunk area's arcs lie opposite to its normals.
    const double direction = delta < 0 ? tangent.angle_rad + std::numbers::pi : tangent.angle_rad;
    const double angle = side * std::remainder(direction - start, 2 * std::numbers::pi);
    if (angle > 0 && angle < sweep) {
      angles.push_back(angle);
      extra = true;
    }
  }
  if (extra) std::sort(angles.begin(), angles.end());
  for (std::size_t i = 0; i + 1 < angles.size(); ++i) {
    const double half = 0.5 * (angles[i + 1] - angles[i]);
    const double middle = start + side * (angles[i] + half);
    out.push_back(corner + delta / std::cos(half) * Point(std::cos(middle), std::sin(middle)));
  }
}

// The loop with every edge moved along its outward normal. Where edges part, the arc's tangents stand between them;
// where they meet, the crossing is left for a union to trim.
Loop moved_edges(const Loop& loop, double delta, const OffsetOptions& options) {
  const std::size_t n = loop.size();
  Loop out;
  out.reserve(4 * n);
  Point n_in = right_normal(loop[n - 1], loop[0]);
  for (std::size_t i = 0; i < n; ++i) {
    const Point n_out = right_normal(loop[i], loop[(i + 1) % n]);
    const double turn = cross(n_in, n_out);
    if (std::abs(turn) <= kStraight && n_in.dot(n_out) > 0) {
      out.push_back(loop[i] + delta * n_out);
    } else if (turn * delta > 0) {
      append_arc(out, loop[i], n_in, n_out, delta, options);
    } else {
      out.push_back(loop[i] + delta * n_in);
      out.push_back(loop[i]);
      out.push_back(loop[i] + delta * n_out);
    }
    n_in = n_out;
  }
  return out;
}

// A convex loop shrunk: the common part of its half-planes, each moved inwards.
Loop shrunk_convex(const Loop& loop, double delta) {
  Loop kept = loop, next;
  const std::size_t n = loop.size();
  for (std::size_t i = 0; i < n && !kept.empty(); ++i) {
    const Point normal = right_normal(loop[i], loop[(i + 1) % n]);
    const double limit = normal.dot(loop[i]) + delta;
    next.clear();
    for (std::size_t k = 0; k < kept.size(); ++k) {
      const Point& p = kept[k];
      const Point& q = kept[(k + 1) % kept.size()];
      const double dp = normal.dot(p) - limit, dq = normal.dot(q) - limit;
      if (dp <= 0) next.push_back(p);
      if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0)) next.push_back(p + dp / (dp - dq) * (q - p));
    }
    kept.swap(next);
  }
  return kept.size() >= 3 && signed_area(kept) > 0 ? kept : Loop{};
}

bool boxes_apart(const std::vector<Loop>& loops, double delta) {
  if (loops.size() == 1) return true;
  const double reach = 1.1 * std::max(delta, 0.0);  // tangent corners stick out of the arcs a little
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const Box a = bounding_box(loops[i]);
    for (std::size_t j = 0; j < i; ++j) {
      const Box b = bounding_box(loops[j]);
      const bool apart =
          (a.max.array() + 2 * reach < b.min.array()).any() || (b.max.array() + 2 * reach < a.min.array()).any();
      if (!apart) return false;
    }
  }
  return true;
}

}  // namespace

std::vector<Loop> offset(const std::vector<Loop>& loops, double delta_mm, const OffsetOptions& options) {
  if (delta_mm == 0 || loops.empty()) return loops;
  std::vector<Loop> result;
  result.reserve(loops.size());
  if (std::all_of(loops.begin(), loops.end(), is_convex) && boxes_apart(loops, delta_mm)) {
    for (const Loop& loop : loops) {
      Loop moved = delta_mm > 0 ? moved_edges(loop, delta_mm, options) : shrunk_convex(loop, delta_mm);
      if (!moved.empty()) result.push_back(std::move(moved));
    }
    return result;
  }
  for (const Loop& loop : loops) result.push_back(moved_edges(loop, delta_mm, options));
  return loops_of(united(result));
}

}  // namespace formotion
