// The travel of every pose as pictures need it: outlines, and the hull's corners with their lives.
#pragma once

#include <span>
#include <vector>

#include "analysis/constraints/support_generators.hpp"
#include "applications/feeder/feeder_problem.hpp"

namespace formotion::feeder {

// Past voids that act together. Outside of from..to the pose stands on plain track.
struct GroupPicture {
  double from_mm = 0, to_mm = 0;      // positions of the centre of mass
  std::vector<Generator> generators;  // positions relative to the supported point
};

// x from the centre of mass along the feed, y from the wall.
struct PosePicture {
  StablePose stable;
  Polygon footprint;
  std::vector<Polygon> bodies;
  double x_min_mm = 0, x_max_mm = 0;
  double supported_y_mm = 0;  // of the supported point; the centre of mass is at stable.com_wall_mm
  Loop plain_hull;            // on plain track, relative to the supported point
  double plain_margin_mm = 0;
  std::vector<GroupPicture> groups;  // in the order of travel
  std::vector<Interval> held;        // while the centre of mass is here, a rail keeps the pose up
};

// In the order of stable_poses; values are of all the problem's variables.
std::vector<PosePicture> travel_pictures(const FeederProblem& problem, int topology, std::span<const double> values);

}  // namespace formotion::feeder
