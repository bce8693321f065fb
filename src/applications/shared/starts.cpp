#include "applications/shared/starts.hpp"

#include <algorithm>

namespace formotion {

RegionOptions search_region_options() {
  RegionOptions options;
  options.starts_a_row = 5;
  options.rows = 3;
  options.most_rows = 9;
  options.boundary = 1e-4;
  options.history = 1.0 / 16;
  options.row_error = 0.02;
  return options;
}

StartShares shares_of_starts(const StartsSpec& starts, int wanted,
                             const std::function<StartOutcome(double x_mm, double y_mm, double theta_rad)>& at,
                             const RegionOptions& options) {
  StartShares shares;
  const ErrorBox box{starts.x_mm.min, starts.x_mm.max, starts.theta_rad.min, starts.theta_rad.max};
  shares.y_mm = values_of(starts.y_mm, 3);
  double sum = 0, weights = 0;
  for (std::size_t i = 0; i < shares.y_mm.size(); ++i) {
    const double y = shares.y_mm[i], weight = shares.y_mm.size() == 3 && i == 1 ? 4 : 1;
    const auto at_y = [&](double x, double theta) { return at(x, y, theta); };
    const OutcomeRegion region = outcome_region(box, at_y, options);
    sum += weight * share_of(region, wanted);
    weights += weight;
    shares.scaled_box = std::min(shares.scaled_box, largest_scaled_box(region, wanted, at_y, options));
    shares.regions.push_back(region);
  }
  shares.share = sum / weights;
  return shares;
}

std::vector<double> values_of(const ErrorInterval& interval, int count) {
  if (interval.is_single() || count < 2) return {interval.middle()};
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(interval.min + i * (interval.max - interval.min) / (count - 1));
  return values;
}

}  // namespace formotion
