// A compliant insertion simulated by small steps of the carrier, each one a complementarity problem over all features
// that are near: no events, no modes, none of the program's contact code.
//
//   K (carrier - q+) + W lambda = 0,  0 <= gap + Wn^T dq complementary to lambda_n >= 0,  friction against the slip
// (Stewart & Trinkle 1996 and Anitescu & Potra 1997, with a spring in place of the mass.)
#pragma once

#include <vector>

#include "analysis/insertion/insertion.hpp"

namespace formotion::witness {

struct SteppingScene {
  Polygon part;                // relative to the compliance centre
  std::vector<Polygon> fixed;  // disjoint
  Stiffness stiffness;
  double friction = 0;
  Approach approach;
  Configuration drawn;
  SeatedGoal goal;
};

struct SteppingOptions {
  double step_mm = 0.02;     // of the carrier
  double near_mm = 0.15;     // features nearer than this are in the problem
  double most_mm = 0.06;     // that the part moves in one step; a longer way is gone with a viscous support
  int linearisations = 3;    // of the gaps in one step
  int most_substeps = 3000;  // of one snap
  // The carrier goes on from where the part is: a damper, by Euler's backward steps. The scene's stiffness is then B
  // over the time of one step.
  bool damped = false;
};

struct SteppedInsertion {
  InsertionOutcome outcome = InsertionOutcome::Undecided;
  Configuration q;  // at the end
  double depth_mm = 0, lateral_mm = 0, tilt_rad = 0;
  double peak_axial_n = 0, work_nmm = 0;  // the work: of the carrier
  double overlap_mm2 = 0;                 // of the shapes at the end: how far the steps may be trusted
  int solves = 0;
};

SteppedInsertion step_insertion(const SteppingScene& scene, const Configuration& start,
                                const SteppingOptions& options = {});

}  // namespace formotion::witness
