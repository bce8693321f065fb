#include "analysis/contact/clearance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/contact/free_slice.hpp"
#include "analysis/contact/interiors.hpp"

namespace formotion {
namespace {

constexpr double kSameNormal = 1e-6;                          // contacts whose normals differ by less are one
constexpr double kTouchingRounded_mm = 1.001 * kTouching_mm;  // no overlap that is let pass shows as a distance
constexpr double kAngle_rad = 1e-12;                          // orientations a rounding beyond their range

Point nearest_on(const BoundarySegment& segment, const Point& p) {
  return segment.from + std::clamp(segment.along.dot(p - segment.from), 0.0, segment.length_mm) * segment.along;
}

struct Nearest {
  double mm = std::numeric_limits<double>::infinity();
  Point on_part = Point::Zero(), on_obstacles = Point::Zero();
  void offer(const Point& part, const Point& obstacle) {
    const double distance = (part - obstacle).norm();
    if (distance < mm) *this = {distance, part, obstacle};
  }
};

// Of boundaries that do not cross.
Nearest nearest_points(const Boundary& part, const Boundary& obstacles) {
  Nearest nearest;
  for (const BoundarySegment& b : obstacles.segments) {
    if (box_distance(part.box, b.box) >= nearest.mm) continue;
    for (const BoundarySegment& a : part.segments) {
      if (box_distance(a.box, b.box) >= nearest.mm) continue;
      nearest.offer(a.from, nearest_on(b, a.from));
      nearest.offer(a.to, nearest_on(b, a.to));
      nearest.offer(nearest_on(a, b.from), b.from);
      nearest.offer(nearest_on(a, b.to), b.to);
    }
  }
  for (const BoundaryArc& arc : obstacles.arcs) {
    if (box_distance(part.box, arc.box) >= nearest.mm) continue;
    for (const BoundarySegment& a : part.segments) {
      const Point on_part = nearest_on(a, arc.centre), off = on_part - arc.centre;
      const double distance = off.norm();
      if (distance - arc.radius_mm >= nearest.mm || distance == 0) continue;
      if (!arc.directions.contains(std::atan2(off.y(), off.x()))) continue;  // its ends are ends of segments
      nearest.offer(on_part, arc.centre + arc.radius_mm / distance * off);
    }
  }
  return nearest;
}

// Beyond its orientations by more than rounding, the neighbouring edges' far ends sink in: by how much at most.
double reach_of_neighbours(const MovingShape& part, const Obstacles& obstacles, const ContactPair& pair) {
  double reach = 0;
  if (pair.kind != ContactKind::EdgeOnCorner) {
    const MovingCorner& corner = part.corners[pair.moving];
    reach = std::max(part.edges[corner.edge_before].length_mm, part.edges[corner.edge_after].length_mm);
  }
  if (pair.kind != ContactKind::CornerOnEdge) {
    const FixedCorner& corner = obstacles.corners[pair.fixed];
    reach = std::max(reach, corner.radius_mm);
    for (const auto& edge : {corner.edge_before, corner.edge_after}) {
      if (edge) reach = std::max(reach, obstacles.edges[*edge].length_mm);
    }
    // A wall without end against an edge: the edge's length is what sinks in.
    if (pair.kind == ContactKind::EdgeOnCorner) reach = std::min(reach, part.edges[pair.moving].length_mm);
  }
  return reach;
}

}  // namespace

Clearance clearance(const MovingShape& part, const Obstacles& obstacles, const Configuration& q) {
  const double c = std::cos(q.theta_rad), s = std::sin(q.theta_rad);
  const Boundary placed = placed_boundary(part, q.position(), c, s), fixed = fixed_boundary(obstacles);
  Clearance result;
  if (interiors_overlap(placed, fixed)) {
    const auto free = nearest_boundary(part, obstacles, q.theta_rad, q.position());
    if (!free) return {-std::numeric_limits<double>::infinity(), Point::Zero(), Point::Zero()};
    const Point out = free->position - q.position();
    return {-std::max(out.norm(), kTouching_mm), free->contact - out, free->contact};
  }
  const Nearest nearest = nearest_points(placed, fixed);
  return {nearest.mm <= kTouchingRounded_mm ? 0.0 : nearest.mm, nearest.on_part, nearest.on_obstacles};
}

double clearance_mm(const MovingShape& part, const Obstacles& obstacles, const Configuration& q) {
  return clearance(part, obstacles, q).mm;
}

bool is_free(const MovingShape& part, const Obstacles& obstacles, const Configuration& q) {
  const double c = std::cos(q.theta_rad), s = std::sin(q.theta_rad);
  return !interiors_overlap(placed_boundary(part, q.position(), c, s), fixed_boundary(obstacles));
}

std::vector<Contact> contacts_at(const MovingShape& part, const Obstacles& obstacles, const Configuration& q,
                                 double tolerance_mm) {
  const double c = std::cos(q.theta_rad), s = std::sin(q.theta_rad);
  std::vector<Contact> contacts;
  for (const ContactPair& pair : contact_pairs(part, obstacles)) {
    const ContactState state = contact_state(part, obstacles, pair, q.position(), c, s);
    if (std::abs(state.gap_mm) > tolerance_mm) continue;
    if (state.along_mm < -tolerance_mm || state.along_mm > state.extent_mm + tolerance_mm) continue;
    const auto orientations = contact_orientations(part, obstacles, pair);
    const double beyond =
        kAngle_rad + tolerance_mm / std::max(reach_of_neighbours(part, obstacles, pair), tolerance_mm);
    if (!orientations || !orientations->contains(q.theta_rad, beyond)) continue;
    if (pair.kind == ContactKind::CornerOnCorner) {  // the part's corner must face this direction
      const DirectionRange& cone = part.corners[pair.moving].normals;
      if (!cone.contains(std::atan2(-state.normal.y(), -state.normal.x()) - q.theta_rad, beyond)) continue;
    }
    const Point point =
        q.position() + state.lever - state.gap_mm * (pair.kind == ContactKind::EdgeOnCorner ? 0 : 1) * state.normal;
    const auto same = [&](const Contact& other) {
      return (other.point - point).norm() <= 3 * tolerance_mm &&
             (other.state.normal - state.normal).norm() <= kSameNormal + beyond;
    };
    if (std::none_of(contacts.begin(), contacts.end(), same)) contacts.push_back({pair, state, point});
  }
  return contacts;
}

}  // namespace formotion
