// The largest fixed shape that leaves a given motion of the part free: what is left of a region when the part has
// passed through it. A start for fences, walls and cut-outs, never a result: that this motion is free does not make it
// the one that happens, and others may be free, too.
#pragma once

#include <vector>

#include "analysis/contact/configuration.hpp"

namespace formotion::feeder {

struct SweptObstacle {
  std::vector<Polygon> pieces;  // by falling area; the part touches none of them anywhere on the path
};

// bodies: of the part, from its centre of mass. Between two configurations of the path (at least one) x, y and theta
// change evenly. Points of the region that are farther than precision_mm from all that the part sweeps are in a piece.
SweptObstacle swept_obstacle(const std::vector<Polygon>& bodies, const std::vector<Configuration>& path,
                             const Loop& region, double precision_mm);

}  // namespace formotion::feeder
