#include "witness/minkowski.hpp"

#include <CGAL/Boolean_set_operations_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_set_2.h>
#include <CGAL/minkowski_sum_2.h>

#include <cmath>

namespace formotion::witness {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactPolygon = CGAL::Polygon_2<Kernel>;
using ExactArea = CGAL::Polygon_with_holes_2<Kernel>;
using AreaSet = CGAL::Polygon_set_2<Kernel>;
using Filtered = CGAL::Exact_predicates_inexact_constructions_kernel;

ExactPolygon exact(const Loop& loop, double sense) {
  ExactPolygon polygon;
  for (const Point& p : loop) polygon.push_back({sense * p.x(), sense * p.y()});
  return polygon;
}

ExactArea exact(const Polygon& polygon, double sense = 1) {
  ExactArea area(exact(polygon.outer, sense));
  for (const Loop& hole : polygon.holes) area.add_hole(exact(hole, sense));
  return area;
}

Loop rounded(const ExactPolygon& polygon) {
  Loop loop;
  for (auto p = polygon.vertices_begin(); p != polygon.vertices_end(); ++p) {
    loop.emplace_back(CGAL::to_double(p->x()), CGAL::to_double(p->y()));
  }
  return loop;
}

struct Edge {
  Filtered::Point_2 from, to;
};

template <typename Visit>
void for_each_loop(const std::vector<Polygon>& areas, const Visit& visit) {
  for (const Polygon& area : areas) {
    visit(area.outer);
    for (const Loop& hole : area.holes) visit(hole);
  }
}

std::vector<Edge> edges_of(const std::vector<Polygon>& areas) {
  std::vector<Edge> edges;
  for_each_loop(areas, [&](const Loop& loop) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Point &a = loop[i], &b = loop[(i + 1) % loop.size()];
      edges.push_back({{a.x(), a.y()}, {b.x(), b.y()}});
    }
  });
  return edges;
}

// Strictly inside; p is on no boundary.
bool inside(const std::vector<Edge>& edges, const Filtered::Point_2& p) {
  bool in = false;
  for (const Edge& e : edges) {
    if ((e.from.y() > p.y()) == (e.to.y() > p.y())) continue;
    const bool left = CGAL::orientation(e.from, e.to, p) == CGAL::LEFT_TURN;
    if (left == (e.to.y() > e.from.y())) in = !in;
  }
  return in;
}

enum class Meeting { Apart, Touch, Cross };

Meeting meeting(const Edge& a, const Edge& b) {
  const int a0 = CGAL::orientation(b.from, b.to, a.from), a1 = CGAL::orientation(b.from, b.to, a.to);
  if (a0 * a1 > 0) return Meeting::Apart;
  const int b0 = CGAL::orientation(a.from, a.to, b.from), b1 = CGAL::orientation(a.from, a.to, b.to);
  if (b0 * b1 > 0) return Meeting::Apart;
  return a0 * a1 < 0 && b0 * b1 < 0 ? Meeting::Cross : Meeting::Touch;
}

AreaSet common_area(const std::vector<Polygon>& a, const std::vector<Polygon>& b) {
  AreaSet common, others;
  for (const Polygon& area : a) common.join(exact(area));
  for (const Polygon& area : b) others.join(exact(area));
  common.intersection(others);
  return common;
}

}  // namespace

bool interiors_meet(const std::vector<Polygon>& a, const std::vector<Polygon>& b) {
  const std::vector<Edge> a_edges = edges_of(a), b_edges = edges_of(b);
  bool touch = false;
  for (const Edge& one : a_edges) {
    for (const Edge& other : b_edges) {
      const Meeting m = meeting(one, other);
      if (m == Meeting::Cross) return true;
      touch = touch || m == Meeting::Touch;
    }
  }
  if (touch) return !common_area(a, b).is_empty();
  bool in = false;
  for_each_loop(a, [&](const Loop& loop) { in = in || inside(b_edges, {loop[0].x(), loop[0].y()}); });
  for_each_loop(b, [&](const Loop& loop) { in = in || inside(a_edges, {loop[0].x(), loop[0].y()}); });
  return in;
}

double overlap_width(const std::vector<Polygon>& a, const std::vector<Polygon>& b) {
  std::vector<ExactArea> pieces;
  common_area(a, b).polygons_with_holes(std::back_inserter(pieces));
  Kernel::FT area = 0;
  double perimeter = 0;
  const auto add = [&](const ExactPolygon& loop) {
    area += loop.area();
    for (auto e = loop.edges_begin(); e != loop.edges_end(); ++e)
      perimeter += std::sqrt(CGAL::to_double(e->squared_length()));
  };
  for (const ExactArea& piece : pieces) {
    add(piece.outer_boundary());
    for (auto hole = piece.holes_begin(); hole != piece.holes_end(); ++hole) add(*hole);
  }
  return perimeter > 0 ? 2 * CGAL::to_double(area) / perimeter : 0;
}

double exact_distance(const std::vector<Polygon>& a, const std::vector<Polygon>& b) {
  const auto segments = [](const std::vector<Polygon>& areas) {
    std::vector<Kernel::Segment_2> all;
    for (const Edge& e : edges_of(areas)) all.push_back({{e.from.x(), e.from.y()}, {e.to.x(), e.to.y()}});
    return all;
  };
  const auto others = segments(b);
  Kernel::FT least = 1e300;
  for (const auto& one : segments(a)) {
    for (const auto& other : others) least = std::min(least, Kernel::FT(CGAL::squared_distance(one, other)));
  }
  return std::sqrt(CGAL::to_double(least));
}

std::vector<Polygon> configuration_obstacle(const std::vector<Polygon>& part, const std::vector<Polygon>& obstacles) {
  AreaSet all;
  for (const Polygon& fixed : obstacles) {
    for (const Polygon& body : part) all.join(CGAL::minkowski_sum_2(exact(fixed), exact(body, -1)));
  }
  std::vector<ExactArea> areas;
  all.polygons_with_holes(std::back_inserter(areas));
  std::vector<Polygon> polygons;
  for (const ExactArea& area : areas) {
    Polygon polygon{rounded(area.outer_boundary()), {}};
    for (auto hole = area.holes_begin(); hole != area.holes_end(); ++hole) polygon.holes.push_back(rounded(*hole));
    polygons.push_back(std::move(polygon));
  }
  return polygons;
}

}  // namespace formotion::witness
