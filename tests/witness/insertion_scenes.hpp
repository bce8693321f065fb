// Joints for tests and measurements of compliant insertions: pegs and holes, points on slopes, random joints.
#pragma once

#include "witness/insertion_stepping.hpp"
#include "witness/random_shapes.hpp"

namespace formotion::witness {

// A peg above a hole between two blocks, the hole's axis on x = 0 and its mouth at y = 0; pushed along -y. Chamfers:
// width across the axis, angle from the axis.
struct PegInHole {
  double peg_half_mm = 10, peg_length_mm = 60, peg_chamfer_mm = 0;
  double hole_half_mm = 10.1, hole_depth_mm = 40, hole_chamfer_mm = 3;
  double chamfer_rad = 0.7853981633974483;
  double centre_mm = 30;  // of compliance, above the peg's tip
  double above_mm = 1;    // the tip over the mouth
  double seated_mm = 25;  // the tip below the mouth, at the goal
  double friction = 0.2;
  Stiffness stiffness{10, 100, 20000};
};
SteppingScene scene_of(const PegInHole& joint);

// A pointed part whose tip, straight below the compliance centre, comes down on a slope at slope_rad from the
// approach, width_mm short of the slope's foot at x = 0. Goal: the foot.
struct PointOnSlope {
  double slope_rad = 0.7853981633974483;
  double width_mm = 3;
  double centre_mm = 30;
  double friction = 0.2;
  Stiffness stiffness{10, 1e6, 1e9};
};
SteppingScene scene_of(const PointOnSlope& joint);

// A peg, a part with a slot over a tenon, or a stepped peg in a stepped hole with a floor; a stiffness, a friction.
SteppingScene random_joint(Random& random);

// The same joint for the program.
struct JointTask {
  MovingShape part;
  Obstacles obstacles;
  ContactSpace space;
  InsertionTask task;
  explicit JointTask(const SteppingScene& scene);
  JointTask(const JointTask&) = delete;
  JointTask& operator=(const JointTask&) = delete;
};

}  // namespace formotion::witness
