// What the report page shows of a design whose parts turn, as JSON: where each start goes, the configuration space.
#pragma once

#include <span>

#include "applications/feeder/turning_picture.hpp"
#include "io/feeder_json.hpp"

namespace formotion {

// Paths to 0.001 mm and degrees, the space to 0.01 mm; the ends of intervals as the evaluation writes them.
OrderedJson turning_json(const feeder::FeederProblem& problem, const feeder::TurningPicture& picture);

}  // namespace formotion
