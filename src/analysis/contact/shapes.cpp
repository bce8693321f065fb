#include "analysis/contact/shapes.hpp"

#include <algorithm>
#include <numbers>

#include "analysis/geometry/boolean.hpp"
#include "analysis/geometry/offset.hpp"

namespace formotion {
namespace {

constexpr double kStraight_rad = 1e-12;   // corners that turn by less are none
constexpr double kArcStep_rad = 0.1;      // tangents leave an arc by 0.13 % of its radius
constexpr double kSamePlace_mm = 1e-6;    // the union's grid moves points by far less
constexpr double kNearlyParallel = 1e-9;  // sine; lines that meet nowhere near

double angle(const Point& direction) { return std::atan2(direction.y(), direction.x()); }
double turn(const Point& normal_before, const Point& normal_after) {
  return std::atan2(cross(normal_before, normal_after), normal_before.dot(normal_after));
}
Point outward(const Point& along) { return {along.y(), -along.x()}; }

void add_loop(MovingShape& shape, const Loop& loop, int first_index) {
  const int count = static_cast<int>(loop.size()), first_edge = static_cast<int>(shape.edges.size());
  for (int i = 0; i < count; ++i) {
    const Point span = loop[(i + 1) % count] - loop[i];
    const Point along = span.normalized();
    shape.edges.push_back({loop[i], loop[(i + 1) % count], along, outward(along), span.norm(), first_index + i});
  }
  for (int i = 0; i < count; ++i) {
    const int before = first_edge + (i + count - 1) % count, after = first_edge + i;
    const Point& m = shape.edges[before].normal;
    const double turned = turn(m, shape.edges[after].normal);
    if (turned > kStraight_rad) shape.corners.push_back({loop[i], {angle(m), turned}, first_index + i, before, after});
  }
}

// An edge of the union with where it comes from.
struct SourcedEdge {
  Point from, to, along, normal;
  FixedName name;
  double grow = 0;
};

struct Source {
  const std::vector<ObstacleShape>& shapes;

  // The shapes' edge on which this one lies.
  std::pair<FixedName, bool> edge(const Point& from, const Point& to) const {
    const Point middle = (from + to) / 2, along = (to - from).normalized();
    FixedName name{-1, 0};
    bool datum = false;
    double nearest = kSamePlace_mm;
    for (int k = 0; k < static_cast<int>(shapes.size()); ++k) {
      if (shapes[k].radius_mm > 0) continue;
      int index = 0;
      for (const Loop& loop : loops_of(shapes[k].area)) {
        for (std::size_t i = 0; i < loop.size(); ++i, ++index) {
          const Point& a = loop[i];
          const Point& b = loop[(i + 1) % loop.size()];
          const double off = distance_to_segment(middle, a, b);
          if (off >= nearest || along.dot(b - a) <= 0) continue;
          nearest = off + kSamePlace_mm * 1e-3;  // ties: the first shape's
          name = {k, index};
          datum = shapes[k].is_datum && std::abs(a.y()) < kSamePlace_mm && std::abs(b.y()) < kSamePlace_mm;
        }
      }
    }
    return {name, datum};
  }

  // The corner's own name, where it is one of a shape; else that of the edge that follows it.
  FixedName corner(const Point& p, const FixedName& edge_after) const {
    for (int k = 0; k < static_cast<int>(shapes.size()); ++k) {
      if (shapes[k].radius_mm > 0) continue;
      int index = 0;
      for (const Loop& loop : loops_of(shapes[k].area)) {
        for (const Point& q : loop) {
          if ((p - q).norm() < kSamePlace_mm) return {k, index};
          ++index;
        }
      }
    }
    return edge_after;
  }
};

Point meeting(const Point& p, const Point& t, const Point& q, const Point& u) {
  return p + cross(q - p, u) / cross(t, u) * t;
}

// Adds the edges and convex corners of one boundary loop (material on the left). False if an edge vanishes.
bool add_boundary(Obstacles& obstacles, const Loop& loop, const Source& source, double grow_mm, Loop& moved) {
  const int count = static_cast<int>(loop.size()), first_edge = static_cast<int>(obstacles.edges.size());
  std::vector<SourcedEdge> edges;
  for (int i = 0; i < count; ++i) {
    const Point &from = loop[i], &to = loop[(i + 1) % count];
    const Point along = (to - from).normalized();
    const auto [name, datum] = source.edge(from, to);
    edges.push_back({from, to, along, outward(along), name, datum ? 0 : grow_mm});
  }
  // Where each moved edge begins and ends.
  std::vector<Point> begin(count), end(count);
  std::vector<FixedCorner> corners;
  for (int i = 0; i < count; ++i) {
    const SourcedEdge &before = edges[(i + count - 1) % count], &after = edges[i];
    const double turned = turn(before.normal, after.normal);
    const bool convex = turned > kStraight_rad;
    Point &arrives = end[(i + count - 1) % count], &leaves = begin[i];
    arrives = loop[i] + before.grow * before.normal;
    leaves = loop[i] + after.grow * after.normal;
    const bool round = convex && before.grow > 0 && after.grow > 0;
    if (!round && (before.grow != 0 || after.grow != 0) && std::abs(cross(before.along, after.along)) > kNearlyParallel)
      arrives = leaves = meeting(arrives, before.along, leaves, after.along);
    if (convex) {
      FixedCorner corner;
      corner.centre = round ? loop[i] : leaves;
      corner.radius_mm = round ? grow_mm : 0;
      corner.normals = {angle(before.normal), turned};
      corner.name = source.corner(loop[i], after.name);
      corner.edge_before = first_edge + (i + count - 1) % count;
      corner.edge_after = first_edge + i;
      corners.push_back(corner);
    }
  }
  for (int i = 0; i < count; ++i) {
    const double length = edges[i].along.dot(end[i] - begin[i]);
    if (length <= 0 && grow_mm != 0) return false;
    obstacles.edges.push_back(
        {begin[i], end[i], edges[i].along, edges[i].normal, std::max(0.0, length), edges[i].name});
    moved.push_back(begin[i]);
    if ((end[i] - begin[(i + 1) % count]).norm() > kSamePlace_mm) moved.push_back(end[i]);
  }
  obstacles.corners.insert(obstacles.corners.end(), corners.begin(), corners.end());
  return true;
}

}  // namespace

bool DirectionRange::contains(double direction_rad, double tolerance_rad) const {
  const double middle = from_rad + width_rad / 2;
  return std::abs(std::remainder(direction_rad - middle, 2 * std::numbers::pi)) <= width_rad / 2 + tolerance_rad;
}

MovingShape MovingShape::of(const std::vector<Polygon>& bodies, double gyration_mm) {
  MovingShape shape;
  shape.gyration_mm = gyration_mm;
  shape.bodies = bodies.size() == 1 ? bodies : united(loops_of(bodies));
  int index = 0;
  for (const Polygon& body : shape.bodies) {
    for (const Loop& loop : loops_of(body)) {
      add_loop(shape, loop, index);
      index += static_cast<int>(loop.size());
      for (const Point& p : loop) shape.reach_mm = std::max(shape.reach_mm, p.norm());
    }
  }
  return shape;
}

namespace {

// Grown one by one, with tangents for arcs: where growing closes a notch, edges are not just moved.
std::optional<Obstacles> grown_apart(const std::vector<ObstacleShape>& shapes, double grow_mm) {
  std::vector<ObstacleShape> grown;
  for (const ObstacleShape& shape : shapes) {
    if (shape.is_datum || shape.radius_mm > 0) {
      grown.push_back(shape);
      if (!shape.is_datum) grown.back().radius_mm += grow_mm;
      continue;
    }
    OffsetOptions fine;
    fine.arc_step_rad = kArcStep_rad;
    for (const Polygon& area : united(offset(loops_of(normalised(shape.area)), grow_mm, fine)))
      grown.push_back({area, 0});
  }
  std::optional<Obstacles> obstacles = make_obstacles(grown, 0);
  if (obstacles) obstacles->round_exactly = false;
  return obstacles;
}

bool boxes_meet(const std::vector<Polygon>& polygons) {
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const Box a = bounding_box(polygons[i].outer);
    for (std::size_t j = 0; j < i; ++j) {
      const Box b = bounding_box(polygons[j].outer);
      if ((a.min.array() <= b.max.array()).all() && (b.min.array() <= a.max.array()).all()) return true;
    }
  }
  return false;
}

}  // namespace

std::optional<Obstacles> make_obstacles(const std::vector<ObstacleShape>& shapes, double grow_mm) {
  Obstacles obstacles;
  std::vector<Loop> loops;
  std::vector<Polygon> polygons;
  for (int k = 0; k < static_cast<int>(shapes.size()); ++k) {
    if (shapes[k].radius_mm > 0) {
      const double radius = shapes[k].radius_mm + grow_mm;
      if (radius <= 0) return std::nullopt;
      obstacles.corners.push_back(
          {shapes[k].area.outer.front(), radius, {-std::numbers::pi, 2 * std::numbers::pi}, {k, 0}, {}, {}});
      continue;
    }
    polygons.push_back(normalised(shapes[k].area));  // the union takes loops as they wind
    const std::vector<Loop> own = loops_of(polygons.back());
    loops.insert(loops.end(), own.begin(), own.end());
  }
  // Drawn apart from each other they need no union; drawn together their hidden corners must go.
  if (boxes_meet(polygons)) polygons = united(loops);
  const Source source{shapes};
  for (const Polygon& polygon : polygons) {
    const Polygon clean = normalised(polygon);
    Polygon area;
    const auto failed = [&] { return grow_mm > 0 ? grown_apart(shapes, grow_mm) : std::nullopt; };
    if (!add_boundary(obstacles, clean.outer, source, grow_mm, area.outer)) return failed();
    for (const Loop& hole : clean.holes) {
      area.holes.emplace_back();
      if (!add_boundary(obstacles, hole, source, grow_mm, area.holes.back())) return failed();
    }
    obstacles.areas.push_back(std::move(area));
  }
  return obstacles;
}

}  // namespace formotion
