// Unions, intersections and differences of polygons, on a grid of 2^-30 mm (about 1e-9 mm).
// Clipper stays behind this wall. For areas: pieces without area are dropped.
#pragma once

#include "analysis/geometry/polygon.hpp"

namespace formotion {

// The points around which the loops wind at least once, as disjoint polygons in a fixed order.
std::vector<Polygon> united(const std::vector<Loop>& loops);
std::vector<Polygon> intersection(const std::vector<Loop>& a, const std::vector<Loop>& b);
std::vector<Polygon> difference(const std::vector<Loop>& a, const std::vector<Loop>& b);

std::vector<Loop> loops_of(const Polygon& polygon);
std::vector<Loop> loops_of(const std::vector<Polygon>& polygons);
Loop rectangle(double x_min, double y_min, double x_max, double y_max);

}  // namespace formotion
