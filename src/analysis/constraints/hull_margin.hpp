// How far the supported point is from tipping: its signed distance to the boundary of the support hull.
#pragma once

#include <span>

#include "analysis/geometry/polygon.hpp"

namespace formotion {

struct HullMargin {
  // Signed distance (mm) from the origin to the boundary of the points' convex hull: positive inside, negative outside,
  // 0 on it. For a single point or a segment: minus the distance.
  double margin_mm = 0;
  // The hull edge nearest to the origin, counter-clockwise, as indices of the points; equal for a single point.
  // If the nearest place is a corner: the incident edge with the larger outward distance.
  int from = -1, to = -1;
  bool at_corner = false;
  int other_from = -1, other_to = -1;  // at a corner: the corner's other edge, when both are equally far beyond
};

// Points relative to the supported point; at least one. O(k log k), or O(k) if nearly sorted by x in a repeated call:
// order is a permutation of 0..k-1 that the caller keeps between calls.
HullMargin hull_margin(std::span<const Point> points, std::vector<int>& order);
HullMargin hull_margin(std::span<const Point> points);

// Its two halves. Corners of the hull, counter-clockwise, of the points that order lists by ascending x, then y;
// and the margin of a convex polygon whose corners are listed counter-clockwise.
void hull_of_sorted(std::span<const Point> points, std::span<const int> order, std::vector<int>& hull);
HullMargin margin_of_hull(std::span<const Point> points, std::span<const int> corners);

}  // namespace formotion
