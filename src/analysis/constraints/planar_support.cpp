#include "analysis/constraints/planar_support.hpp"

#include <algorithm>

#include "analysis/constraints/hull_margin.hpp"
#include "analysis/geometry/boolean.hpp"

namespace formotion {
namespace {

bool on_metal(const Point& p, const Track& track, double tolerance) {
  if (p.y() < -tolerance || p.y() > track.width_mm + tolerance) return false;
  return std::none_of(track.voids.begin(), track.voids.end(),
                      [&](const Polygon& hole) { return locate(hole, p, tolerance) == Side::Inside; });
}

// Calls visit(a, b) for every edge.
template <class Visit>
void for_edges(const Polygon& polygon, const Visit& visit) {
  const auto along = [&](const Loop& loop) {
    for (std::size_t i = 0; i < loop.size(); ++i) visit(loop[i], loop[(i + 1) % loop.size()]);
  };
  along(polygon.outer);
  for (const Loop& hole : polygon.holes) along(hole);
}

// Where a-b crosses c-d, ends included.
std::optional<Point> crossing(const Point& a, const Point& b, const Point& c, const Point& d) {
  const double det = cross(b - a, d - c);
  if (det == 0) return std::nullopt;  // parallel: the corners cover it
  const double t = cross(c - a, d - c) / det, s = cross(c - a, b - a) / det;
  if (t < 0 || t > 1 || s < 0 || s > 1) return std::nullopt;
  return Point(a + t * (b - a));
}

}  // namespace

Loop support_generators(const Polygon& part, const Track& track, double tolerance_mm) {
  Loop points;
  const auto add_if_common = [&](const Point& p) {
    if (on_metal(p, track, tolerance_mm) && locate(part, p, tolerance_mm) != Side::Outside) points.push_back(p);
  };
  const Box box = bounding_box(part.outer);
  const Point margin = Point::Constant(1);
  const Point lo = box.min - margin, hi = box.max + margin;
  const auto far_from_part = [&](const Point& a, const Point& b) {
    return (a.cwiseMax(b).array() < lo.array()).any() || (a.cwiseMin(b).array() > hi.array()).any();
  };

  for_edges(part, [&](const Point& a, const Point&) { add_if_common(a); });
  // Lines of the strip's edges, as long as the part needs them.
  const std::array<std::array<Point, 2>, 2> rims{
      {{Point(lo.x(), 0), Point(hi.x(), 0)}, {Point(lo.x(), track.width_mm), Point(hi.x(), track.width_mm)}}};
  for (const auto& rim : rims) {
    for_edges(part, [&](const Point& a, const Point& b) {
      if (const auto p = crossing(a, b, rim[0], rim[1])) add_if_common(*p);
    });
  }
  for (const Polygon& hole : track.voids) {
    for_edges(hole, [&](const Point& c, const Point& d) {
      if (far_from_part(c, d)) return;
      add_if_common(c);
      add_if_common(d);
      for (const auto& [e, f] : rims) {
        if (const auto p = crossing(c, d, e, f)) add_if_common(*p);
      }
      for_edges(part, [&](const Point& a, const Point& b) {
        if (const auto p = crossing(a, b, c, d)) add_if_common(*p);
      });
    });
  }
  return points;
}

std::optional<double> support_margin(const Polygon& part, const Track& track, const Point& supported_point,
                                     double tolerance_mm) {
  Loop points = support_generators(part, track, tolerance_mm);
  if (points.empty()) return std::nullopt;
  for (Point& p : points) p -= supported_point;
  return hull_margin(points).margin_mm;
}

}  // namespace formotion
