#include "analysis/insertion/lasting_overlap.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/contact/clearance.hpp"

namespace formotion {
namespace {

constexpr double kSlack_mm = 1e-7;  // overlaps that are taken as touching, and rounding
constexpr int kMostPoints = 400;    // on a boundary
constexpr int kInteriorSteps = 8;   // of a grid across the part

// The radius of a disc of material about p, at least; 0 outside. The whole circle stands for a round corner's arc.
double disc_at(const Boundary& boundary, const Point& p) {
  if ((p.array() < boundary.box.min.array()).any() || (p.array() > boundary.box.max.array()).any()) return 0;
  double radius = 1e300;
  for (const BoundarySegment& segment : boundary.segments) {
    const double place = std::clamp(segment.along.dot(p - segment.from), 0.0, segment.length_mm);
    radius = std::min(radius, (segment.from + place * segment.along - p).squaredNorm());
  }
  radius = std::sqrt(radius);
  for (const BoundaryArc& arc : boundary.arcs) {
    radius = std::min(radius, std::abs((p - arc.centre).norm() - arc.radius_mm));
  }
  return winding(boundary, p) > 0 ? radius : 0;
}

std::vector<MaterialPoint> on_boundary(const Boundary& boundary, double spacing_mm) {
  double length = 0;
  for (const BoundarySegment& segment : boundary.segments) length += segment.length_mm;
  for (const BoundaryArc& arc : boundary.arcs) length += arc.directions.width_rad * arc.radius_mm;
  const double spacing = std::max(spacing_mm, length / kMostPoints);
  std::vector<MaterialPoint> points;
  for (const BoundarySegment& segment : boundary.segments) {
    const int steps = std::max(1, static_cast<int>(std::ceil(segment.length_mm / spacing)));
    for (int i = 0; i < steps; ++i) points.push_back({segment.from + segment.length_mm * i / steps * segment.along, 0});
  }
  for (const BoundaryArc& arc : boundary.arcs) {
    const double width = arc.directions.width_rad;
    const int steps = std::max(4, static_cast<int>(std::ceil(width * arc.radius_mm / spacing)));
    for (int i = 0; i < steps; ++i) {
      const double angle = arc.directions.from_rad + width * i / steps;
      points.push_back({arc.centre + arc.radius_mm * Point(std::cos(angle), std::sin(angle)), 0});
    }
  }
  return points;
}

// Big discs first: they decide most.
void add_interior(const Boundary& boundary, std::vector<MaterialPoint>& points) {
  const Point size = boundary.box.max - boundary.box.min;
  for (int i = 0; i < kInteriorSteps; ++i) {
    for (int j = 0; j < kInteriorSteps; ++j) {
      const Point p =
          boundary.box.min + Point(size.x() * (i + 0.5) / kInteriorSteps, size.y() * (j + 0.5) / kInteriorSteps);
      const double radius = disc_at(boundary, p);
      if (radius > 0) points.push_back({p, radius});
    }
  }
  std::stable_sort(points.begin(), points.end(),
                   [](const MaterialPoint& a, const MaterialPoint& b) { return a.radius_mm > b.radius_mm; });
}

}  // namespace

LastingOverlap::LastingOverlap(const MovingShape& part, const Obstacles& obstacles, double spacing_mm)
    : part_(part),
      obstacles_(obstacles),
      fixed_(fixed_boundary(obstacles)),
      moving_(placed_boundary(part, Point::Zero(), 1, 0)),
      of_part_(on_boundary(moving_, spacing_mm)),
      of_obstacles_(on_boundary(fixed_, spacing_mm)) {
  add_interior(moving_, of_part_);
}

bool LastingOverlap::at(const Configuration& q, double move_mm, double turn_rad) const {
  const double c = std::cos(q.theta_rad), s = std::sin(q.theta_rad), least = move_mm + kSlack_mm;
  for (const MaterialPoint& point : of_part_) {
    const double disc = disc_at(fixed_, q.position() + rotated(point.at, c, s));
    if (disc > 0 && disc + point.radius_mm > least + point.at.norm() * turn_rad) return true;
  }
  return std::any_of(of_obstacles_.begin(), of_obstacles_.end(), [&](const MaterialPoint& point) {
    const Point in_part = rotated(point.at - q.position(), c, -s);
    const double disc = disc_at(moving_, in_part);
    return disc > 0 && disc + point.radius_mm > least + in_part.norm() * turn_rad;
  });
}

bool LastingOverlap::free_at(const Configuration& q, double move_mm, double turn_rad) const {
  const double least = move_mm + part_.reach_mm * turn_rad + kSlack_mm;
  return is_free(part_, obstacles_, q) && clearance_mm(part_, obstacles_, q) > least;
}

}  // namespace formotion
