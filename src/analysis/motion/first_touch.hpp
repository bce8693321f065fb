// When a part that moves on a path first touches something new. No gap is looked at by samples alone: on every step it
// is bounded by a cubic and what the cubic misses, and pieces that the bound cannot clear are halved.
#pragma once

#include "analysis/motion/guided_path.hpp"

namespace formotion {

// A stretch of a path from its start; rates are per unit of h.
struct FlowStep {
  Configuration start;
  Twist rate;
  Configuration end;
  Twist rate_end;
  double h = 0;
  double chord_mm = 0;  // between the path and the cubic through the step's ends and rates, in its middle
};

// The distance between two configurations: of the centres of mass, and of points at this reach for the turn.
double chord(const Configuration& a, const Configuration& b, double reach);

bool carries(const GuidedPath& path, const ContactPair& pair);

// Whether a pair whose gap is about 0 at q touches there: its features are in reach of each other, and where convex
// corners meet no other pair of their edges keeps them apart.
bool closes(const ContactSpace& space, const GuidedPath& path, std::size_t index, const Configuration& q);

// The first h of a step at which a pair that does not carry closes its gap; infinite if none does.
double first_touch(const ContactSpace& space, const GuidedPath& path, const FlowStep& step);

}  // namespace formotion
