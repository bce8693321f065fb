// Which edges of a drawing's contours touch each other, without comparing all with all.
#pragma once

#include <functional>
#include <vector>

#include "analysis/geometry/polygon.hpp"

namespace formotion {

struct Meeting {
  int a = 0, b = 0;  // indices of the loops, a <= b
  Point at_mm = Point::Zero();
};

struct MeetingsResult {
  std::vector<Meeting> meetings;  // one for each pair of loops, ascending; at most `most`
  bool complete = false;          // false: the work limit was reached before all edges were compared
};

// Pairs of loops (and loops with themselves) whose edges come within tolerance_mm of each other, edges that follow each
// other in a loop apart from those that fold back. Loops for which comparable(a, b) is false are not compared.
// By a tree of boxes: about n log n for edges that lie apart.
MeetingsResult meetings(const std::vector<Loop>& loops, double tolerance_mm, std::size_t most,
                        const std::function<bool(int, int)>& comparable);

}  // namespace formotion
