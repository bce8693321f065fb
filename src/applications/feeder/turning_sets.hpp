// Arrivals among obstacles for a whole set of uncertain values: what all members agree on. Members are looked at, not
// proved in between.
#pragma once

#include <string>

#include "applications/feeder/part_spread.hpp"
#include "applications/feeder/turning.hpp"

namespace formotion::feeder {

struct TurningCase {
  const PartModel& part;  // every pose that arrives in some member
  const Layout& layout;
  const Environment& environment;
  const std::vector<PoseTravel>& arrivals;  // without uncertainties: one for every pose, or on belts the map's
};

struct SetEvaluation {
  std::vector<bool> alike;           // whether all members that were looked at end as the arrival does as drawn
  std::optional<std::string> bites;  // the value that changes an arrival's end by itself, the first such
  std::int64_t projections = 0;
};

// Members of the box of all uncertain values: those that outcome_of_set (outcome_map.hpp) looks at. Friction, drive and
// tilt from their intervals; obstacles and the part's outline grown or shrunk evenly; the centre of mass in the square
// within its disc; voids off to the adverse side of each arrival.
SetEvaluation arrivals_over_sets(const TurningCase& turning, const Uncertainty& uncertainty, bool find_what_bites);

}  // namespace formotion::feeder
