#include "analysis/contact/facet_paths.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/contact/facets.hpp"

namespace formotion {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kParallel = 1e-12;     // sine; and how far a direction may lie outside a corner's normals
constexpr double kSamePlace_mm = 1e-8;  // nodes of one path

Point direction(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

// A range of directions as its two ends: cheaper to ask than angles.
struct Cone {
  Point from, to;
  double width_rad = 0;
  explicit Cone(const DirectionRange& range)
      : from(direction(range.from_rad)), to(direction(range.from_rad + range.width_rad)), width_rad(range.width_rad) {}
  bool contains(const Point& d) const {
    if (width_rad >= 2 * kPi) return true;
    const bool after = cross(from, d) >= -kParallel, before = cross(d, to) >= -kParallel;
    if (width_rad > kPi) return after || before;
    return after && before && (from + to).dot(d) >= 0;
  }
};

FacetPath straight(const ContactPair& pair, const Point& from, const Point& to, const Point& along, double length_mm) {
  FacetPath path;
  path.pair = pair;
  path.from = from;
  path.to = to;
  path.along = along;
  path.length_mm = length_mm;
  path.box.include(from);
  path.box.include(to);
  return path;
}

// zero_rad: the direction from which along runs.
FacetPath arc(const ContactPair& pair, const Point& centre, double radius_mm, double zero_rad,
              const AlongRange& range) {
  FacetPath path;
  path.pair = pair;
  path.centre = centre;
  path.radius_mm = radius_mm;
  path.from_rad = zero_rad + range.from_mm / radius_mm;
  path.length_mm = range.to_mm - range.from_mm;
  path.from = centre + radius_mm * direction(path.from_rad);
  path.to = centre + radius_mm * direction(zero_rad + range.to_mm / radius_mm);
  path.along_from_mm = range.from_mm;
  path.box.include(centre - Point::Constant(radius_mm));
  path.box.include(centre + Point::Constant(radius_mm));
  return path;
}

struct NodeList {
  const FacetPath& path;
  std::vector<PathNode> nodes;

  // p: a point of another path that lies on this one if it is near enough to it.
  void touch(const Point& p, int meets) {
    const double place = path.nearest_place(p);
    if ((path.at(place) - p).norm() <= kSamePlace_mm) nodes.push_back({place, meets});
  }
  // p: on the unbounded line or circle of both; a node if it is on both pieces.
  void cross_at(const Point& p, const FacetPath& other) {
    if ((other.at(other.nearest_place(p)) - p).norm() <= kSamePlace_mm) touch(p, 1);
  }
};

void meet_lines(NodeList& list, const FacetPath& a, const FacetPath& b) {
  const double sine = cross(a.along, b.along);
  if (std::abs(sine) > kParallel) list.cross_at(a.from + cross(b.from - a.from, b.along) / sine * a.along, b);
  // Near-parallel crossings are ill placed: the ends that lie on this path count as well.
  const int meets = std::abs(sine) > 1e-6 ? 1 : 2;
  list.touch(b.from, meets);
  list.touch(b.to, meets);
}

void meet_line_and_arc(NodeList& list, const FacetPath& line, const FacetPath& round, const FacetPath& other) {
  const double middle = line.along.dot(round.centre - line.from);
  const Point foot = line.from + middle * line.along;
  const double off = (foot - round.centre).norm(), r = round.radius_mm;
  if (off > r + kSamePlace_mm) return;
  const double half = std::sqrt(std::max(0.0, r * r - off * off));
  if (std::abs(off - r) <= kSamePlace_mm) list.cross_at(foot, other);
  list.cross_at(foot - half * line.along, other);
  list.cross_at(foot + half * line.along, other);
}

void meet_arcs(NodeList& list, const FacetPath& a, const FacetPath& b) {
  const Point between = b.centre - a.centre;
  const double d = between.norm(), ra = a.radius_mm, rb = b.radius_mm;
  list.touch(b.from, 2);
  list.touch(b.to, 2);
  if (d <= kSamePlace_mm || d > ra + rb + kSamePlace_mm || d < std::abs(ra - rb) - kSamePlace_mm) return;
  const double foot = (d * d + ra * ra - rb * rb) / (2 * d);
  const double half = std::sqrt(std::max(0.0, ra * ra - foot * foot));
  const Point u = between / d;
  list.cross_at(a.centre + foot * u + half * turned_left(u), b);
  list.cross_at(a.centre + foot * u - half * turned_left(u), b);
}

}  // namespace

Point FacetPath::at(double place_mm) const {
  if (is_arc()) return centre + radius_mm * direction(from_rad + place_mm / radius_mm);
  return from + place_mm * along;
}

double FacetPath::nearest_place(const Point& p) const {
  if (!is_arc()) return std::clamp(along.dot(p - from), 0.0, length_mm);
  const double half = length_mm / (2 * radius_mm);
  const double off = std::remainder(std::atan2(p.y() - centre.y(), p.x() - centre.x()) - from_rad - half, 2 * kPi);
  return std::clamp(off + half, 0.0, 2 * half) * radius_mm;
}

std::vector<FacetPath> facet_paths(const MovingShape& part, const Obstacles& obstacles, double c, double s) {
  std::vector<FacetPath> paths;
  std::vector<Cone> moving_cones, fixed_cones;
  for (const MovingCorner& corner : part.corners) moving_cones.emplace_back(corner.normals);
  for (const FixedCorner& corner : obstacles.corners) fixed_cones.emplace_back(corner.normals);
  for (int j = 0; j < static_cast<int>(obstacles.edges.size()); ++j) {
    const FixedEdge& edge = obstacles.edges[j];
    if (!(edge.length_mm > 0)) continue;
    const Point facing = rotated(-edge.normal, c, -s);  // in the part's frame
    for (int i = 0; i < static_cast<int>(part.corners.size()); ++i) {
      if (!moving_cones[i].contains(facing)) continue;
      const Point lever = rotated(part.corners[i].at, c, s);
      paths.push_back(
          straight({ContactKind::CornerOnEdge, i, j}, edge.from - lever, edge.to - lever, edge.along, edge.length_mm));
    }
  }
  for (int i = 0; i < static_cast<int>(part.edges.size()); ++i) {
    const MovingEdge& edge = part.edges[i];
    const Point facing = rotated(-edge.normal, c, s), along = rotated(-edge.along, c, s);
    const Point from = rotated(edge.from, c, s), to = rotated(edge.to, c, s);
    for (int j = 0; j < static_cast<int>(obstacles.corners.size()); ++j) {
      if (!fixed_cones[j].contains(facing)) continue;
      const Point contact = obstacles.corners[j].centre + obstacles.corners[j].radius_mm * facing;
      paths.push_back(straight({ContactKind::EdgeOnCorner, i, j}, contact - from, contact - to, along, edge.length_mm));
    }
  }
  const double theta = std::atan2(s, c);
  for (int j = 0; j < static_cast<int>(obstacles.corners.size()); ++j) {
    const FixedCorner& corner = obstacles.corners[j];
    if (!(corner.radius_mm > 0)) continue;
    for (int i = 0; i < static_cast<int>(part.corners.size()); ++i) {
      const ContactPair pair{ContactKind::CornerOnCorner, i, j};
      for (const AlongRange& range : along_ranges(part, obstacles, pair, theta)) {
        paths.push_back(arc(pair, corner.centre - rotated(part.corners[i].at, c, s), corner.radius_mm,
                            corner.normals.from_rad, range));
      }
    }
  }
  return paths;
}

std::vector<PathNode> path_nodes(const std::vector<FacetPath>& paths, int i) {
  const FacetPath& path = paths[i];
  NodeList list{path, {{0, 0}, {path.length_mm, 0}}};
  for (int j = 0; j < static_cast<int>(paths.size()); ++j) {
    const FacetPath& other = paths[j];
    if (i == j || (path.box.max.array() + kSamePlace_mm < other.box.min.array()).any() ||
        (other.box.max.array() + kSamePlace_mm < path.box.min.array()).any()) {
      continue;
    }
    if (path.is_arc() && other.is_arc()) {
      meet_arcs(list, path, other);
    } else if (path.is_arc() || other.is_arc()) {
      meet_line_and_arc(list, path.is_arc() ? other : path, path.is_arc() ? path : other, other);
    } else {
      meet_lines(list, path, other);
    }
  }
  std::sort(list.nodes.begin(), list.nodes.end(),
            [](const PathNode& a, const PathNode& b) { return a.place_mm < b.place_mm; });
  std::vector<PathNode> merged;
  for (const PathNode& node : list.nodes) {
    if (!merged.empty() && node.place_mm - merged.back().place_mm <= kSamePlace_mm) {
      merged.back().meets += node.meets;
    } else {
      merged.push_back(node);
    }
  }
  return merged;
}

}  // namespace formotion
