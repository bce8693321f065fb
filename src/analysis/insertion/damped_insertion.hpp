// Forward projection of one start of an insertion on a generalised damper (Lozano-Perez, Mason, Taylor 1984).
//
// The carrier goes with v0 = speed times the approach, and the part's twist is v0 + B^-1 (contact wrenches), with
// B = diag(bx, by, btheta) at the compliance centre: first-order motion without memory. That is the motion of a part
// under the force B v0 (project()), for bx = by: its paths, with the carrier's time and the support's force along them.
#pragma once

#include "analysis/insertion/insertion.hpp"

namespace formotion {

// task.stiffness holds B, task.damper_speed_mm_s the speed. The outcome is undecided where bx and by differ. A part
// that rests does so until the carrier's way or force ends. Moments of the path stand at the ends of short pieces.
Insertion insert_damped(const InsertionTask& task, const Configuration& start, const InsertionOptions& options = {});

}  // namespace formotion
