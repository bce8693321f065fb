// How far the part is from the obstacles, or how deep in them, and what it touches.
#pragma once

#include <vector>

#include "analysis/contact/contact_pair.hpp"

namespace formotion {

struct Clearance {
  double mm = 0;  // > 0: the distance; 0: they touch; < 0: minus the least translation that separates them
  Point on_part, on_obstacles;  // apart: the nearest points. Overlapping: moving the part by on_obstacles - on_part
                                // (the least translation) brings the one onto the other, in contact
};

// Infinity (and points of zeros) where there are no obstacles. Distances of kTouching_mm (interiors.hpp) and less are
// 0, and so are overlaps of this depth: slots without clearance are free.
Clearance clearance(const MovingShape& part, const Obstacles& obstacles, const Configuration& q);
double clearance_mm(const MovingShape& part, const Obstacles& obstacles, const Configuration& q);

// Whether part and obstacles at most touch: clearance_mm >= 0, without the distance.
bool is_free(const MovingShape& part, const Obstacles& obstacles, const Configuration& q);

struct Contact {
  ContactPair pair;
  ContactState state;
  Point point;  // in the world, on the obstacle
};

// The contacts at q: pairs whose features are within tolerance_mm of each other, at orientations at which they can
// touch (beyond it by the angle that lifts the end of a neighbouring edge by the tolerance). One for each place and
// normal: an edge on an edge counts at both ends of their common stretch; corner against corner lists each facet.
// What else overlaps is not asked.
std::vector<Contact> contacts_at(const MovingShape& part, const Obstacles& obstacles, const Configuration& q,
                                 double tolerance_mm);

}  // namespace formotion
