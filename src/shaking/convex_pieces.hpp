// Areas as convex pieces, which is all that the rigid-body engine knows.
#pragma once

#include <vector>

#include "analysis/geometry/polygon.hpp"

namespace formotion {

// Convex pieces of at most max_corners corners, which meet along diagonals between corners of the area: ears, then
// joined over diagonals while convex (Hertel & Mehlhorn 1983). The area is simple and normalised (polygon.hpp); throws
// std::invalid_argument where that shows.
std::vector<Loop> convex_pieces(const Polygon& area, int max_corners);

}  // namespace formotion
