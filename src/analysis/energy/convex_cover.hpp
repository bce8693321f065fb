// Areas as unions of convex pieces, which may overlap.
#pragma once

#include <vector>

#include "analysis/contact/shapes.hpp"

namespace formotion {

// Corners counter-clockwise; edge i runs from corner i to the next and lies on normal . p = offset.
struct ConvexPiece {
  std::vector<Point> corners, normals;
  std::vector<double> offsets_mm;
  double reach_mm = 0;  // the farthest corner from the origin
  bool holds_origin = false;
  Box box;

  // Of points that are corners of a convex area, in any order.
  static ConvexPiece of(const Loop& points);
  // How far the piece reaches in this direction.
  double support_mm(const Point& direction) const;
};

// An L is covered by its two whole legs: cut along either edge of every reflex corner, pieces within others left out.
std::vector<ConvexPiece> convex_cover(const Polygon& area);

enum class RoundCorners { Inscribed, Circumscribed };

// Of all obstacles, turned back by turned_rad. Round corners become polygons that miss the arc by sagitta_mm at most,
// inside or outside of it.
std::vector<ConvexPiece> convex_cover(const Obstacles& obstacles, double turned_rad, RoundCorners rounding,
                                      double sagitta_mm);

}  // namespace formotion
