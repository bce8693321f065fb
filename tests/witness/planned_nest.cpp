#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/geometry/boolean.hpp"
#include "witness/escape_planner.hpp"

namespace formotion::witness {
namespace {

constexpr double kFar_mm = 1e9;

double to_segment(const Point& p, const Point& a, const Point& b) {
  const Point along = b - a;
  const double length2 = along.squaredNorm();
  const double at = length2 > 0 ? std::clamp(along.dot(p - a) / length2, 0.0, 1.0) : 0.0;
  return (p - a - at * along).norm();
}

bool do_cross(const Point& a, const Point& b, const Point& c, const Point& d) {
  const double c_side = cross(b - a, c - a), d_side = cross(b - a, d - a);
  const double a_side = cross(d - c, a - c), b_side = cross(d - c, b - c);
  return (c_side < 0) != (d_side < 0) && (a_side < 0) != (b_side < 0);
}

double box_gap(const Box& a, const Box& b) {
  const Point apart = (a.min - b.max).cwiseMax(b.min - a.max).cwiseMax(0);
  return apart.norm();
}

bool holds(const Loop& loop, const Point& p) {
  bool inside = false;
  for (std::size_t i = 0, k = loop.size() - 1; i < loop.size(); k = i++) {
    const Point &a = loop[i], &b = loop[k];
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      inside = !inside;
  }
  return inside;
}

// Not on its boundary.
bool holds(const Polygon& area, const Point& p) {
  return holds(area.outer, p) &&
         std::none_of(area.holes.begin(), area.holes.end(), [&](const Loop& hole) { return holds(hole, p); });
}

double turn_between(double from, double to) { return std::remainder(to - from, 2 * std::numbers::pi); }

}  // namespace

PlannedNest::PlannedNest(const Polygon& part, const std::vector<ObstacleShape>& fixed, double grow_mm) : part_(part) {
  for (const Loop& loop : loops_of(part)) {
    const std::size_t first = corners_.size();
    for (std::size_t i = 0; i < loop.size(); ++i) {
      corners_.push_back(loop[i]);
      edges_.emplace_back(first + i, first + (i + 1) % loop.size());
      reach_mm_ = std::max(reach_mm_, loop[i].norm());
    }
  }
  for (const ObstacleShape& shape : fixed) {
    Body body;
    body.radius_mm = shape.radius_mm + grow_mm;
    if (shape.radius_mm > 0) {
      body.from = body.to = {shape.area.outer[0]};
    } else {
      body.area = shape.area;
      for (const Loop& loop : loops_of(shape.area)) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
          body.from.push_back(loop[i]);
          body.to.push_back(loop[(i + 1) % loop.size()]);
        }
      }
    }
    for (const Point& p : body.from) body.box.include(p);
    bodies_.push_back(std::move(body));
  }
}

double PlannedNest::clearance_mm(const Configuration& q) const {
  ++looks_;
  const double c = std::cos(q.theta_rad), s = std::sin(q.theta_rad);
  std::vector<Point> at;
  at.reserve(corners_.size());
  Box box;
  for (const Point& p : corners_) {
    at.push_back(rotated(p, c, s) + q.position());
    box.include(at.back());
  }
  double least = kFar_mm;
  for (const Body& body : bodies_) {
    if (box_gap(box, body.box) - body.radius_mm >= least) continue;
    double distance = kFar_mm;
    for (std::size_t k = 0; k < body.from.size(); ++k) {
      for (const auto& [from, to] : edges_) {
        const Point &a = at[from], &b = at[to];
        if (do_cross(a, b, body.from[k], body.to[k])) return 0;
        distance = std::min({distance, to_segment(a, body.from[k], body.to[k]), to_segment(body.from[k], a, b)});
      }
    }
    // Boundaries that do not meet: one is within the other's material, or they are apart.
    const Point back = rotated(body.from[0] - q.position(), c, -s);
    if (holds(part_, back) || (!body.area.outer.empty() && holds(body.area, at[0]))) return 0;
    least = std::min(least, distance - body.radius_mm);
    if (least <= 0) return 0;
  }
  return least;
}

double PlannedNest::way_mm(const Configuration& a, const Configuration& b) const {
  return (b.position() - a.position()).norm() + reach_mm_ * std::abs(turn_between(a.theta_rad, b.theta_rad));
}

bool PlannedNest::is_motion_free(const Configuration& a, const Configuration& b, double margin_mm, double piece_mm,
                                 long most_looks) const {
  struct Piece {
    double from, to, clear_from, clear_to;
  };
  const double turn = turn_between(a.theta_rad, b.theta_rad), whole = way_mm(a, b);
  const auto at = [&](double h) {
    return Configuration{std::lerp(a.x_mm, b.x_mm, h), std::lerp(a.y_mm, b.y_mm, h), a.theta_rad + h * turn};
  };
  std::vector<Piece> open{{0, 1, clearance_mm(a), clearance_mm(b)}};
  if (open[0].clear_from < margin_mm || open[0].clear_to < margin_mm) return false;
  for (long looks = 0; !open.empty();) {
    const Piece piece = open.back();
    open.pop_back();
    // A point that has moved by less than the clearance there is still apart (derived: from both ends).
    const double way = whole * (piece.to - piece.from);
    if (piece.clear_from + piece.clear_to > way || way <= piece_mm) continue;
    const double middle = (piece.from + piece.to) / 2, clear = clearance_mm(at(middle));
    if (clear < margin_mm || ++looks > most_looks) return false;
    open.push_back({middle, piece.to, clear, piece.clear_to});
    open.push_back({piece.from, middle, piece.clear_from, clear});
  }
  return true;
}

}  // namespace formotion::witness
