#include "witness/exact_support.hpp"

#include <CGAL/Boolean_set_operations_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_set_2.h>
#include <CGAL/convex_hull_2.h>

#include <cmath>

namespace formotion::witness {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactPoint = Kernel::Point_2;
using ExactPolygon = CGAL::Polygon_2<Kernel>;
using ExactArea = CGAL::Polygon_with_holes_2<Kernel>;
using AreaSet = CGAL::Polygon_set_2<Kernel>;

ExactPolygon exact(const Loop& loop) {
  ExactPolygon polygon;
  for (const Point& p : loop) polygon.push_back({p.x(), p.y()});
  return polygon;
}

ExactArea exact(const Polygon& polygon) {
  ExactArea area(exact(polygon.outer));
  for (const Loop& hole : polygon.holes) area.add_hole(exact(hole));
  return area;
}

// Signed distance of p to the boundary of the points' hull; exact signs, rounded distances.
std::optional<double> hull_distance(const std::vector<ExactPoint>& points, const Point& supported_point) {
  if (points.empty()) return std::nullopt;
  std::vector<ExactPoint> hull;
  CGAL::convex_hull_2(points.begin(), points.end(), std::back_inserter(hull));
  const ExactPoint p(supported_point.x(), supported_point.y());
  if (hull.size() == 1) return -std::sqrt(CGAL::to_double(CGAL::squared_distance(p, hull[0])));
  bool inside = hull.size() > 2;
  double squared = 1e300;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const ExactPoint& a = hull[i];
    const ExactPoint& b = hull[(i + 1) % hull.size()];
    inside = inside && CGAL::orientation(a, b, p) != CGAL::RIGHT_TURN;
    squared = std::min(squared, CGAL::to_double(CGAL::squared_distance(p, Kernel::Segment_2(a, b))));
  }
  return (inside ? 1 : -1) * std::sqrt(squared);
}

Loop around(const Polygon& part, double y_min, double y_max) {
  const Box box = bounding_box(part.outer);
  return {{box.min.x() - 1, y_min}, {box.max.x() + 1, y_min}, {box.max.x() + 1, y_max}, {box.min.x() - 1, y_max}};
}

std::vector<Kernel::Segment_2> edges(const ExactArea& area) {
  std::vector<Kernel::Segment_2> all(area.outer_boundary().edges_begin(), area.outer_boundary().edges_end());
  for (auto hole = area.holes_begin(); hole != area.holes_end(); ++hole)
    all.insert(all.end(), hole->edges_begin(), hole->edges_end());
  return all;
}

// +1 inside, 0 on the boundary, -1 outside.
int side(const ExactArea& area, const ExactPoint& p) {
  const CGAL::Bounded_side outer = area.outer_boundary().bounded_side(p);
  if (outer != CGAL::ON_BOUNDED_SIDE) return outer == CGAL::ON_BOUNDARY ? 0 : -1;
  for (auto hole = area.holes_begin(); hole != area.holes_end(); ++hole) {
    const CGAL::Bounded_side in = hole->bounded_side(p);
    if (in == CGAL::ON_BOUNDARY) return 0;
    if (in == CGAL::ON_BOUNDED_SIDE) return -1;
  }
  return 1;
}

}  // namespace

std::optional<double> margin_by_boolean_operations(const Polygon& part, const Track& track,
                                                   const Point& supported_point) {
  AreaSet metal;
  metal.insert(exact(around(part, 0, track.width_mm)));
  for (const Polygon& hole : track.voids) metal.difference(exact(hole));
  metal.intersection(exact(part));
  std::vector<ExactArea> pieces;
  metal.polygons_with_holes(std::back_inserter(pieces));
  std::vector<ExactPoint> corners;
  for (const ExactArea& piece : pieces) {
    corners.insert(corners.end(), piece.outer_boundary().vertices_begin(), piece.outer_boundary().vertices_end());
  }
  return hull_distance(corners, supported_point);
}

std::optional<double> margin_by_exact_generators(const Polygon& part, const Track& track,
                                                 const Point& supported_point) {
  const ExactArea body = exact(part);
  std::vector<ExactArea> voids;
  for (const Polygon& hole : track.voids) voids.push_back(exact(hole));
  std::vector<ExactPoint> points;
  const auto add = [&](const ExactPoint& p) {
    if (p.y() < 0 || p.y() > track.width_mm || side(body, p) < 0) return;
    for (const ExactArea& hole : voids) {
      if (side(hole, p) > 0) return;
    }
    points.push_back(p);
  };
  std::vector<Kernel::Segment_2> lines = edges(body),
                                 fixed = edges(exact(Polygon{around(part, 0, track.width_mm), {}}));
  for (const ExactArea& hole : voids) {
    const auto more = edges(hole);
    fixed.insert(fixed.end(), more.begin(), more.end());
  }
  lines.insert(lines.end(), fixed.begin(), fixed.end());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    add(lines[i].source());
    for (std::size_t j = 0; j < i; ++j) {
      const auto common = CGAL::intersection(lines[i], lines[j]);
      if (!common) continue;
      if (const ExactPoint* p = boost::get<ExactPoint>(&*common)) {
        add(*p);
      } else if (const auto* s = boost::get<Kernel::Segment_2>(&*common)) {
        add(s->source());
        add(s->target());
      }
    }
  }
  return hull_distance(points, supported_point);
}

std::vector<Polygon> united_exactly(const std::vector<Loop>& loops) {
  AreaSet all;
  for (const Loop& loop : loops) all.join(exact(loop));
  std::vector<ExactArea> areas;
  all.polygons_with_holes(std::back_inserter(areas));
  const auto rounded = [](const ExactPolygon& polygon) {
    Loop loop;
    for (auto p = polygon.vertices_begin(); p != polygon.vertices_end(); ++p) {
      loop.emplace_back(CGAL::to_double(p->x()), CGAL::to_double(p->y()));
    }
    return loop;
  };
  std::vector<Polygon> polygons;
  for (const ExactArea& area : areas) {
    Polygon polygon{rounded(area.outer_boundary()), {}};
    for (auto hole = area.holes_begin(); hole != area.holes_end(); ++hole) polygon.holes.push_back(rounded(*hole));
    polygons.push_back(std::move(polygon));
  }
  return polygons;
}

}  // namespace formotion::witness
