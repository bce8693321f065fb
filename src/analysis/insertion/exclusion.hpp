// How deep a part can get at most, whatever friction and forces do: a bound from free configuration space alone, over
// a whole box of starts at once (non-assembly).
#pragma once

#include <string>

#include "analysis/insertion/insertion.hpp"

namespace formotion {

struct StartBox {
  double x_min_mm = 0, x_max_mm = 0, y_min_mm = 0, y_max_mm = 0;  // errors, as start_with_errors takes them
  double theta_min_rad = 0, theta_max_rad = 0;
};

struct ExclusionOptions {
  double cell_mm = 0.25;      // side of the smallest cells; angles by the part's reach
  long most_cells = 2000000;  // else no bound
};

struct Exclusion {
  bool proved = false;  // no configuration of depth at_depth_mm or more can be reached
  double bound_mm = 0;  // the depth that cannot be exceeded, if proved
  long cells = 0;       // looked at, of all sizes
  std::string why;      // where nothing is proved
};

// The part starts anywhere in the box and moves continuously without overlapping obstacles, within what the support's
// energy allows: with r the way from its start and S a the carrier's whole way, (r - S a)' K (r - S a) + ktheta
// dtheta^2
// <= S^2 a' K a; less with a largest force (docs/exclusion.md). Depth is along the approach from task.drawn, the wrong
// pose without errors. Cells in which the part and an obstacle overlap at all configurations are closed; cells
// connected to the start box through others are reachable. Conservative: true only if no path exists.
Exclusion deepest_reachable(const InsertionTask& task, const StartBox& starts, double at_depth_mm,
                            const ExclusionOptions& options = {});

}  // namespace formotion
