// Planar support of one configuration: the part is held up iff the supported point lies in the convex hull of
// part and track (Berretty, Goldberg, Overmars, van der Stappen 2001).
#pragma once

#include <optional>

#include "analysis/geometry/polygon.hpp"

namespace formotion {

// The strip 0 <= y <= width_mm (unbounded in x) without its voids. The metal is closed: an edge supports.
struct Track {
  double width_mm = 0;
  std::vector<Polygon> voids;  // disjoint; may reach beyond the strip
};

// Every point that can be a corner of the hull of part and track: the part's corners on metal, the metal's corners
// under the part, and crossings of their edges. A point within tolerance_mm of a boundary counts as on it.
Loop support_generators(const Polygon& part, const Track& track, double tolerance_mm = 1e-9);

// Signed distance (mm) of the supported point to the boundary of that hull; none where nothing supports the part.
// Positive inside; 0 is marginal and counts as supported. O(n m).
std::optional<double> support_margin(const Polygon& part, const Track& track, const Point& supported_point,
                                     double tolerance_mm = 1e-9);

}  // namespace formotion
