// How a part comes to rest against a straight wall: stable poses and their probabilities, in closed form.
#pragma once

#include <vector>

#include "analysis/geometry/polygon.hpp"

namespace formotion {

struct WallPose {
  double orientation_rad = 0;  // rotation from the outline as given, [0, 2 pi)
  double com_wall_mm = 0;      // height of the centre of mass over the wall
  double basin_rad = 0;        // width of the range of orientations that settle into it
  Point edge_from, edge_to;    // the resting edge, in the outline's frame, counter-clockwise
  double basin_from_rad = 0;   // where that range begins, [0, 2 pi)
};

struct WallPoseOptions {
  double tolerance_mm = 1e-9;  // a line through an edge's end, within this, is not stable on that side
  // A pose on the chord of an arc that a rise of the centre of mass by less than this leads out of is none (with
  // friction: as much work); poses on other edges are kept, however shallow. On an arc of radius R about a centre at
  // distance c from the centre of mass r = R + c cos, with one minimum at most, its chords make many. Above the chord
  // tolerance of imported arcs (0.002 mm).
  double shallow_mm = 0.0025;
};

// The part is pressed against the wall y = 0 (it lies in y >= 0) and dragged along +x, with friction f at the wall.
// points: the part's outline (its convex hull counts), relative to the centre of mass.
// Frictionless, the poses are the local minima of the radius function r(phi) = max over points of p . u(phi), and its
// local maxima bound the basins (Goldberg 1993). With friction the wall's force leans back by atan f, so the line
// through the centre of mass that must meet the resting edge does (derived: moment balance under steady sliding).
// Ascending orientation; basins sum to 2 pi. Empty if the centre of mass lies outside the hull so that it never
// settles.
std::vector<WallPose> wall_poses(const Loop& points, double friction, const WallPoseOptions& options = {});

// Whether edge `from` of a convex hull may be the chord of an arc with a sagitta of less than shallow_mm: length times
// turn / 8, by the larger of the turns at its ends.
bool is_chord(const Loop& hull, std::size_t from, double shallow_mm);

// Poses that a rotation by 2 pi / order maps onto each other become one, of the least orientation.
std::vector<WallPose> merged_by_symmetry(const std::vector<WallPose>& poses, int order);

}  // namespace formotion
