// Slow, obviously right answers about contact, by CGAL in exact arithmetic on the corners as given (rounded to doubles
// once placed).
#pragma once

#include <vector>

#include "analysis/geometry/polygon.hpp"

namespace formotion::witness {

// Whether the interiors of two sets of areas have a point in common: exact predicates where boundaries cross, exact
// Boolean operations where they touch.
bool interiors_meet(const std::vector<Polygon>& a, const std::vector<Polygon>& b);

// Twice the area of what two sets of areas have in common over its perimeter: how wide a sliver it is.
double overlap_width(const std::vector<Polygon>& a, const std::vector<Polygon>& b);

// The distance of areas that do not overlap: exact squared distances of all pairs of edges, rounded at the end.
double exact_distance(const std::vector<Polygon>& a, const std::vector<Polygon>& b);

// The positions of the part's reference point at which it overlaps the obstacles: the Minkowski sum of these and the
// part turned by 180 degrees, regularised (slots without width are lost), rounded at the end. part: about its
// reference point, rotated as it shall be.
std::vector<Polygon> configuration_obstacle(const std::vector<Polygon>& part, const std::vector<Polygon>& obstacles);

}  // namespace formotion::witness
