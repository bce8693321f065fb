// The locally lowest positions of a part that keeps its orientation, and how far it can be lowered from above.
#pragma once

#include <optional>
#include <vector>

#include "analysis/contact/free_slice.hpp"
#include "analysis/energy/gravity.hpp"

namespace formotion {

// A position from which no way leads down at once, the orientation being kept; or a level stretch of them.
struct LowestPosition {
  Point left = Point::Zero(), right = Point::Zero();  // the stretch's ends, by Gravity::across_mm; the same: one place
  double height_mm = 0;
  bool leads_down = false;  // a ledge: at an end of it (or a gap in it) a way leads on down
  bool is_level() const { return left != right; }
  Point middle() const { return 0.5 * (left + right); }
};

// Ascending in height, then across.
std::vector<LowestPosition> lowest_positions(const FreeSlice& slice, const Gravity& gravity);

// Where a part first touches that is lowered from far above along gravity: the height of the centre of mass; none where
// nothing is below it.
std::optional<double> drop_height_mm(const FreeSlice& slice, const Gravity& gravity, double across_mm);

// The least height of the slice's boundary within reach_mm of p; none where no boundary is that near.
std::optional<double> lowest_within(const FreeSlice& slice, const Gravity& gravity, const Point& p, double reach_mm);

}  // namespace formotion
