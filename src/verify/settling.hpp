// How a part that is pressed to a straight wall comes to rest from any orientation, corner by corner: the walk that
// wall_poses.hpp has closed forms for.
#pragma once

#include <optional>

#include "analysis/geometry/polygon.hpp"

namespace formotion {

// hull: convex, counter-clockwise, relative to the centre of mass. The orientation at rest, [0, 2 pi); none where it is
// not found within a few turns. friction: at the wall, the part being dragged along +x.
std::optional<double> settled(const Loop& hull, double friction, double start_rad);

}  // namespace formotion
