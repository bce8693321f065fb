// Seeded shapes for tests, degenerate ones among them.
#pragma once

#include <random>

#include "analysis/constraints/planar_support.hpp"

namespace formotion::witness {

using Random = std::mt19937_64;

double uniform(Random& random, double from, double to);
int below(Random& random, int n);

// A simple polygon (star-shaped about a point) of 3 to 10 corners, radius up to size.
Polygon random_polygon(Random& random, double size);
// Rectangles, els, ladders of axis-parallel edges on a grid of whole mm: parallel and touching edges by design.
Polygon grid_polygon(Random& random, int size);

struct Situation {
  Polygon part;  // placed
  Track track;
  Point supported_point;
};
// General position.
Situation random_situation(Random& random);
// Everything on the grid, so that corners lie on edges, edges on edges and the supported point on the hull.
Situation degenerate_situation(Random& random);

}  // namespace formotion::witness
