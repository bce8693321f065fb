// The outcomes of all starts of a box of errors (x, y, theta).
#pragma once

#include <functional>
#include <vector>

#include "analysis/insertion/success_region.hpp"
#include "applications/shared/asked.hpp"

namespace formotion {

// How finely boundaries are located for a search, where many designs are compared.
RegionOptions search_region_options();

struct StartShares {
  double share = 0;       // of the box with the wanted outcome: rows' shares, Simpson's rule over y
  double scaled_box = 1;  // the largest scaled box of that outcome alone (success_region.hpp), least over y
  std::vector<OutcomeRegion> regions;  // over (x, theta), at the ends and the middle of y
  std::vector<double> y_mm;
};

StartShares shares_of_starts(const StartsSpec& starts, int wanted,
                             const std::function<StartOutcome(double x_mm, double y_mm, double theta_rad)>& at,
                             const RegionOptions& options);

// count values of an interval from end to end; its middle for a single value or a count below 2.
std::vector<double> values_of(const ErrorInterval& interval, int count);

}  // namespace formotion
