#include "verify/exact_support.hpp"

#include <CGAL/Boolean_set_operations_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_set_2.h>
#include <CGAL/convex_hull_2.h>

#include <cmath>

namespace formotion {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Number = Kernel::FT;
using ExactPoint = Kernel::Point_2;
using Segment = Kernel::Segment_2;
using ExactLoop = CGAL::Polygon_2<Kernel>;
using ExactArea = CGAL::Polygon_with_holes_2<Kernel>;

struct Edge {
  Segment segment;
  CGAL::Bbox_2 box;
};

struct Void {
  ExactArea area;
  CGAL::Bbox_2 box;
};

ExactPoint exact(const Point& p, double x_mm = 0) {
  return {on_exact_grid(p.x()) + on_exact_grid(x_mm), on_exact_grid(p.y())};
}

// Corners that the grid makes one are one.
ExactLoop exact(const Loop& loop, double x_mm = 0) {
  ExactLoop polygon;
  for (const Point& p : loop) {
    const ExactPoint corner = exact(p, x_mm);
    if (polygon.is_empty() || polygon[polygon.size() - 1] != corner) polygon.push_back(corner);
  }
  if (polygon.size() > 1 && polygon[polygon.size() - 1] == polygon[0])
    polygon.erase(polygon.vertices_begin() + static_cast<std::ptrdiff_t>(polygon.size()) - 1);
  return polygon;
}

ExactArea exact(const Polygon& polygon, double x_mm) {
  ExactArea area(exact(polygon.outer, x_mm));
  for (const Loop& hole : polygon.holes) area.add_hole(exact(hole, x_mm));
  return area;
}

void add_edges(const ExactArea& area, std::vector<Edge>& edges) {
  const auto add = [&edges](const ExactLoop& loop) {
    for (auto edge = loop.edges_begin(); edge != loop.edges_end(); ++edge) edges.push_back({*edge, edge->bbox()});
  };
  add(area.outer_boundary());
  for (auto hole = area.holes_begin(); hole != area.holes_end(); ++hole) add(*hole);
}

CGAL::Bounded_side side(const ExactArea& area, const ExactPoint& p) {
  const CGAL::Bounded_side outer = area.outer_boundary().bounded_side(p);
  if (outer != CGAL::ON_BOUNDED_SIDE) return outer;
  for (auto hole = area.holes_begin(); hole != area.holes_end(); ++hole) {
    const CGAL::Bounded_side in = hole->bounded_side(p);
    if (in == CGAL::ON_BOUNDARY) return in;
    if (in == CGAL::ON_BOUNDED_SIDE) return CGAL::ON_UNBOUNDED_SIDE;
  }
  return CGAL::ON_BOUNDED_SIDE;
}

ExactSupport in_hull(const std::vector<ExactPoint>& points, const ExactPoint& p) {
  if (points.empty()) return ExactSupport::Lost;
  std::vector<ExactPoint> hull;
  CGAL::convex_hull_2(points.begin(), points.end(), std::back_inserter(hull));
  static constexpr double kMarginalSquared = kExactMarginal_mm * kExactMarginal_mm;
  bool inside = hull.size() > 2;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const ExactPoint& a = hull[i];
    const ExactPoint& b = hull[(i + 1) % hull.size()];
    const Number apart = hull.size() == 1 ? CGAL::squared_distance(p, a) : CGAL::squared_distance(p, Segment(a, b));
    if (apart <= kMarginalSquared) return ExactSupport::Marginal;
    inside = inside && CGAL::orientation(a, b, p) == CGAL::LEFT_TURN;
  }
  return inside ? ExactSupport::Held : ExactSupport::Lost;
}

}  // namespace

double on_exact_grid(double value_mm) { return std::round(value_mm / kExactGrid_mm) * kExactGrid_mm; }

struct ExactTrack::Impl {
  Number width;
  std::vector<Void> voids;  // disjoint
  std::vector<Edge> edges;  // of the voids
};

ExactTrack::ExactTrack(double width_mm, const std::vector<Loop>& voids) : impl_(std::make_unique<Impl>()) {
  impl_->width = on_exact_grid(width_mm);
  CGAL::Polygon_set_2<Kernel> cut;
  for (const Loop& loop : voids) {
    ExactLoop polygon = exact(loop);
    if (polygon.size() < 3 || polygon.area() <= 0) continue;
    cut.join(polygon);
  }
  for (const Loop& loop : voids) {  // islands of metal
    ExactLoop polygon = exact(loop);
    if (polygon.size() < 3 || polygon.area() >= 0) continue;
    polygon.reverse_orientation();
    cut.difference(polygon);
  }
  std::vector<ExactArea> areas;
  cut.polygons_with_holes(std::back_inserter(areas));
  for (const ExactArea& area : areas) {
    impl_->voids.push_back({area, area.bbox()});
    add_edges(area, impl_->edges);
  }
}
ExactTrack::ExactTrack(ExactTrack&&) noexcept = default;
ExactTrack::~ExactTrack() = default;

ExactSupport ExactTrack::support(const Polygon& part, const Point& supported, double x_mm) const {
  const ExactArea body = exact(part, x_mm);
  const CGAL::Bbox_2 box = body.bbox();
  std::vector<Edge> part_edges, void_edges;
  add_edges(body, part_edges);
  for (const Edge& edge : impl_->edges) {
    if (CGAL::do_overlap(edge.box, box)) void_edges.push_back(edge);
  }
  std::vector<ExactPoint> points;
  const auto in_strip = [&](const ExactPoint& p) { return p.y() >= 0 && p.y() <= impl_->width; };
  const auto over_void = [&](const ExactPoint& p) {
    return std::any_of(impl_->voids.begin(), impl_->voids.end(), [&](const Void& one) {
      return CGAL::do_overlap(one.box, p.bbox()) && side(one.area, p) == CGAL::ON_BOUNDED_SIDE;
    });
  };
  const auto under_part = [&](const ExactPoint& p) {
    return CGAL::do_overlap(box, p.bbox()) && side(body, p) != CGAL::ON_UNBOUNDED_SIDE;
  };
  // Where a segment passes a rim of the strip.
  const auto at_rims = [&](const Segment& s, const auto& visit) {
    for (const Number& y : {Number(0), impl_->width}) {
      const auto from = CGAL::compare(s.source().y(), y), to = CGAL::compare(s.target().y(), y);
      if (from == to || from == CGAL::EQUAL || to == CGAL::EQUAL) continue;
      const Number along = (y - s.source().y()) / (s.target().y() - s.source().y());
      visit(ExactPoint(s.source().x() + along * (s.target().x() - s.source().x()), y));
    }
  };
  for (const Edge& edge : part_edges) {
    const ExactPoint corner = edge.segment.source();
    if (in_strip(corner) && !over_void(corner)) points.push_back(corner);
    at_rims(edge.segment, [&](const ExactPoint& p) {
      if (!over_void(p)) points.push_back(p);
    });
  }
  // Voids are disjoint: what lies on the boundary of one is metal.
  for (const Edge& edge : void_edges) {
    const ExactPoint corner = edge.segment.source();
    if (in_strip(corner) && under_part(corner)) points.push_back(corner);
    at_rims(edge.segment, [&](const ExactPoint& p) {
      if (under_part(p)) points.push_back(p);
    });
    for (const Edge& other : part_edges) {
      if (!CGAL::do_overlap(edge.box, other.box) || !CGAL::do_intersect(edge.segment, other.segment)) continue;
      const auto common = CGAL::intersection(edge.segment, other.segment);
      // A common stretch ends at corners, which are here already.
      const ExactPoint* p = common ? boost::get<ExactPoint>(&*common) : nullptr;
      if (p && in_strip(*p)) points.push_back(*p);
    }
  }
  return in_hull(points, exact(supported, x_mm));
}

}  // namespace formotion
