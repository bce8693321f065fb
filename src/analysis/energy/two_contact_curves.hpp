// All curves of two contacts of a part with fixed shapes, each as far as both features reach.
#pragma once

#include <vector>

#include "analysis/motion/contact_space.hpp"

namespace formotion {

// By theta; or straight, at one theta: an edge that slides on an edge, a part across a slot.
struct TwoContactCurve {
  std::size_t first = 0, second = 0;  // places in ContactSpace::pairs
  int branch = 0;                     // which of two positions, with round corners
  bool straight = false;
  double theta_rad = 0;                                             // straight
  Point origin = Point::Zero(), direction = Point::Zero();          // straight: unit
  double from = 0, to = 0;                                          // rad; straight: mm
  Configuration at(const ContactSpace& space, double place) const;  // not a number where the two cannot touch
};

// Both contacts within their features and orientations; what else overlaps is not asked. Edge contacts: ends in closed
// form (derived: a corner on a corner leaves the other gap of degree one in cos and sin). With a corner on a round
// corner: stretches that fall between samples (grid_rad) are missed. Curves of two contacts at one place (a convex
// corner that stays on a convex corner) are among them.
std::vector<TwoContactCurve> two_contact_curves(const ContactSpace& space, double grid_rad);

// Whether a pair's fixed feature can be reached by a part that touches the other's.
bool in_reach(const ContactSpace& space, std::size_t first, std::size_t second);
// Whether a pair's orientations have any in common with from..to.
bool has_orientations(const DirectionRange& range, double from_rad, double to_rad);

}  // namespace formotion
