// How a part may come to rest against a wall when its outline, its centre of mass and the friction are not known
// exactly: every edge that it may rest on, and bounds of how many orientations settle there.
#pragma once

#include <vector>

#include "analysis/resting/wall_poses.hpp"

namespace formotion {

struct PoseErrors {
  double friction_from = 0, friction_to = 0;
  double com_mm = 0;      // the centre of mass anywhere in a disc of this radius
  double outline_mm = 0;  // every corner of the hull off by at most this; edges keep their directions
};

struct PoseRange {
  double orientation_rad = 0;
  double com_wall_mm = 0;  // as drawn
  bool always = false;     // stable for every member
  double least_basin_rad = 0, most_basin_rad = 0;
};

// Every edge of the hull on which some member may rest, ascending orientation. Edges that stand for arcs (is_chord) are
// among them only if the part as drawn rests on them: `drawn`, its poses by wall_poses.
// With friction all bounds of basins turn alike, so basins change by what is stable alone, and by how far corners and
// the centre of mass move (derived: a corner at distance r is seen from the centre of mass in a direction that changes
// by at most asin((com + outline) / r)).
std::vector<PoseRange> pose_ranges(const Loop& points, const PoseErrors& errors, const std::vector<WallPose>& drawn);

}  // namespace formotion
