// Where to look at a travel: positions at which a part's support can change, found corner by corner from the shapes
// alone, and a dense set between them.
#pragma once

#include <vector>

#include "analysis/constraints/support_travel.hpp"

namespace formotion {

struct PlaceOptions {
  double step_mm = 0.5;    // largest gap between places
  int most_events = 2000;  // of more, evenly chosen ones are taken
};

// Positions of the centre of mass, ascending. footprint: as it is at 0; voids: of the whole track.
std::vector<double> travel_places(const Polygon& footprint, const std::vector<Loop>& voids, double track_width_mm,
                                  const PlaceOptions& options = {});
// From where the part is wholly before the voids to where it is wholly behind them.
Interval travel_range(const Polygon& footprint, const std::vector<Loop>& voids);

}  // namespace formotion
