// Whether a part and obstacles overlap not only at one configuration but at all those near it: certified by a disc of
// material in each, about one point.
#pragma once

#include <vector>

#include "analysis/contact/interiors.hpp"

namespace formotion {

// Points with the radius of a disc of material about them.
struct MaterialPoint {
  Point at;
  double radius_mm = 0;
};

// Why discs, and not the depth of the overlap as clearance.hpp has it: a part in a close hole, turned by next to
// nothing, must be moved far to come free, and is nevertheless next to a free configuration.
class LastingOverlap {
 public:
  // Both must outlive it. Points on boundaries are at most spacing_mm apart.
  LastingOverlap(const MovingShape& part, const Obstacles& obstacles, double spacing_mm);

  // True only if the part overlaps the obstacles at every configuration that is moved by at most move_mm and turned by
  // at most turn_rad from q. A material point p of both then moves by at most move_mm + |p - q| turn_rad in the one
  // relative to the other, and overlap remains while the discs' radii sum to more.
  bool at(const Configuration& q, double move_mm, double turn_rad) const;

  // True only if the part overlaps nothing at any of those configurations.
  bool free_at(const Configuration& q, double move_mm, double turn_rad) const;

 private:
  const MovingShape& part_;
  const Obstacles& obstacles_;
  Boundary fixed_, moving_;
  std::vector<MaterialPoint> of_part_, of_obstacles_;
};

}  // namespace formotion
