// One step along a path, with how far it bends: what the search for touches looks at.
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

inline constexpr double kLongestChord_mm = 0.3;  // steps that bend more are to be shortened

// The distance between two configurations: of the centres of mass, and of points at this reach for the turn.
double chord(const Configuration& a, const Configuration& b, double reach);

// Ends the step at h, which the path has at `end`; its start and rate are there. False where the path cannot be
// followed so far.
bool step_to(const GuidedPath& path, FlowStep& step, double h, const Configuration& end, double reach_mm);

}  // namespace formotion
