// When a part that moves on a path first touches something new. No gap is looked at by samples alone: on every step it
// is bounded by a cubic and what the cubic misses, and pieces that the bound cannot clear are halved.
#pragma once

#include "analysis/motion/path_step.hpp"

namespace formotion {

bool carries(const GuidedPath& path, const ContactPair& pair);

// Whether a pair whose gap is about 0 at q touches there: its features are in reach of each other, and where convex
// corners meet no other pair of their edges keeps them apart.
bool closes(const ContactSpace& space, const GuidedPath& path, std::size_t index, const Configuration& q);

// The first h of a step at which a pair that does not carry closes its gap; infinite if none does.
double first_touch(const ContactSpace& space, const GuidedPath& path, const FlowStep& step);

}  // namespace formotion
