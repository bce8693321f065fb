// The generators of a travelling part's support hull with their lives: see support_travel.hpp.
#pragma once

#include "analysis/constraints/support_travel.hpp"

namespace formotion {

struct Generator {
  double x_in = 0, x_out = 0;  // it lives while the centre of mass is here (closed)
  Point position;              // at x_in, relative to the supported point
  Point velocity;              // per mm of travel
  bool moving = false;
  Point at(double x) const { return moving ? Point(position + (x - x_in) * velocity) : position; }
};

struct GeneratorSet {
  std::vector<Generator> generators;
  std::vector<int> by_start;      // ascending x_in
  std::vector<int> by_end;        // ascending x_out
  std::vector<int> resting_by_x;  // those at rest, by ascending x, then y
  std::vector<double> events;     // ascending, from where the part is wholly before the voids to wholly behind
};

// Clears and fills set (its memory is kept between calls).
void collect_generators(const Travel& travel, GeneratorSet& set);

// Corners at which the area to the left of the loops is convex.
std::vector<Point> convex_corners(const std::vector<Loop>& loops);

}  // namespace formotion
