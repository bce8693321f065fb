// Arrivals among obstacles for a whole set of frictions and drive directions: what all members agree on.
#pragma once

#include <string>

#include "applications/feeder/turning.hpp"

namespace formotion::feeder {

struct SetEvaluation {
  std::vector<Outcome> arrivals;     // the outcome of all members that were looked at, with one exit; or Ambiguous
  std::optional<std::string> bites;  // the interval that changes an arrival's end by itself, the first such
  std::int64_t projections = 0;
};

// Intervals as in the file ("wall_friction", "drive_deg"); others are not for here. Members are those that
// outcome_of_set (outcome_map.hpp) looks at.
SetEvaluation arrivals_over_sets(const PartModel& part, const Layout& layout, const Environment& environment,
                                 const std::map<std::string, std::pair<double, double>>& intervals,
                                 const TurningEvaluation& nominal);

}  // namespace formotion::feeder
