// Where to begin with a feature's numbers: shapes carved from the part, sizes at which poses begin to fall.
#pragma once

#include <vector>

#include "applications/feeder/part_model.hpp"

namespace formotion::feeder {

// Values of the feature's variables (its expressions are in these), within their bounds; at most kMostCarved, none
// twice, in a fixed order. Guesses: what they do to poses is for the caller to see. wanted: poses that somebody may
// want kept; empty: any. None for obstacles, drawings and rails.
inline constexpr std::size_t kMostCarved = 400;
std::vector<std::vector<double>> carved_values(const FeatureSpec& feature, const std::vector<Variable>& variables,
                                               const PartModel& part, const Environment& environment,
                                               const std::vector<int>& wanted);

}  // namespace formotion::feeder
