// Areas grown and shrunk by a distance: where the edges of a void may be.
#pragma once

#include <span>

#include "analysis/geometry/polygon.hpp"

namespace formotion {

// An extra tangent to the arc around a corner, where the polygon that stands for the arc shall be exact.
struct ArcTangent {
  Point corner;
  double angle_rad = 0;  // direction from the corner to the touching point
};

struct OffsetOptions {
  double arc_step_rad = 0.5235987755982988;  // largest turn between two tangents of an arc (30 degrees)
  std::span<const ArcTangent> tangents;
};

// The area bounded by loops (outer ones counter-clockwise, holes clockwise, disjoint), grown (delta > 0: every point
// within delta of it) or shrunk (delta < 0: every point farther than |delta| from its complement).
// Arcs around corners are replaced by tangents. A grown area is thus never too small, a shrunk one never too large by
// this: for the voids of a track both err to the adverse side. Between tangents that differ by s the polygon
// leaves the arc by |delta| (1 / cos(s / 2) - 1) at most.
// Convex loops away from each other are offset in closed form; others on the grid of boolean.hpp.
std::vector<Loop> offset(const std::vector<Loop>& loops, double delta_mm, const OffsetOptions& options = {});

}  // namespace formotion
