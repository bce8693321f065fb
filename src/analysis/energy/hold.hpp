// The loads that contacts can hold, within one plane of (force, moment) space, exactly.
//
// All held loads are a convex cone, spanned by the edges of the contacts' friction cones. Its section with a plane
// through the origin is spanned by the edges in the plane and, for every two on either side of it, by where the face
// between them crosses it (double description; Motzkin et al. 1953). A section is planar, so it is a range of
// directions: no linear program, and its ends are known.
#pragma once

#include <span>
#include <vector>

#include "analysis/motion/contact_law.hpp"

namespace formotion {

inline constexpr double kHeld_rad = 1e-9;  // loads that are out of a cone by less are held

// A convex cone in a plane.
struct PlaneCone {
  enum class Kind { Nothing, Sector, Line, Everything };
  Kind kind = Kind::Nothing;
  double from_rad = 0, width_rad = 0;  // Sector: counter-clockwise, up to pi. Line: this direction and the opposite

  bool contains(double direction_rad) const;
  // Whether all, or some, of the directions counter-clockwise from..to are in it.
  bool covers(double range_from_rad, double range_to_rad) const;
  bool meets(double range_from_rad, double range_to_rad) const;
};
PlaneCone cone_of(const std::vector<Point>& rays);  // rays of no length are left out by the caller

// Friction cone edges as (force, moment / length).
std::vector<Eigen::Vector3d> friction_edges(std::span<const ContactPoint> contacts, double friction, double length_mm);

// Directions of forces through the centre of mass that the contacts hold.
PlaneCone held_forces(const std::vector<Eigen::Vector3d>& edges);
// Loads (cos a) force + (sin a) moment / length that they hold, by a; force: along this direction.
PlaneCone held_moments(const std::vector<Eigen::Vector3d>& edges, double along_rad);

// The largest t for which the unit vector along `along_rad`, plus t times that towards `towards_rad`, is in the cone;
// infinite where there is none, 0 where already the first is not in it.
double way_out(const PlaneCone& cone, double along_rad, double towards_rad);

}  // namespace formotion
