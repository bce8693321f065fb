// Pushing against a straight wall in one dimension: starting orientation to resting orientation.
//
// The wall is y = 0, the part lies in y >= 0 and slides along +x under friction f. The wall's force leans back by
// atan f, so the part turns by the sign of r_x + f r_y, r the lever from the centre of mass to the lowest corner,
// whatever its damping and the drive, as long as the drive leans more along the wall than friction can hold (derived:
// by cases over sticking and sliding). Without friction that is the slope of the radius function (Goldberg 1993).
#pragma once

#include <vector>

#include "analysis/geometry/polygon.hpp"

namespace formotion::witness {

struct PushFunction {
  std::vector<double> bounds_rad;             // unstable orientations, ascending in [0, 2 pi)
  std::vector<double> rests_rad;              // stable ones
  double rest(double start_rad) const;        // where a start settles: a member of rests_rad
  double off_bounds(double start_rad) const;  // distance to the nearest of bounds_rad; infinite if there are none
};

// corners: of the part, relative to its centre of mass, in any order; what counts is their hull. friction < 0: the part
// slides along -x. A part that never settles (round, with friction) has no rests.
PushFunction push_function(const Loop& corners, double friction);

}  // namespace formotion::witness
