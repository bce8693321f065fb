// Slow, obviously right answers to the support question, by CGAL in exact arithmetic.
#pragma once

#include <optional>

#include "analysis/constraints/planar_support.hpp"

namespace formotion::witness {

// The hull of the regularised intersection of part and metal (CGAL Boolean operations on polygons): contact without
// area does not count. None where the intersection has no area.
std::optional<double> margin_by_boolean_operations(const Polygon& part, const Track& track,
                                                   const Point& supported_point);

// The hull of all common points that can be corners, closed membership decided exactly: contact without area counts.
std::optional<double> margin_by_exact_generators(const Polygon& part, const Track& track, const Point& supported_point);

// The union of loops (counter-clockwise) as disjoint polygons, computed exactly and rounded to doubles at the end.
std::vector<Polygon> united_exactly(const std::vector<Loop>& loops);

}  // namespace formotion::witness
