// Solids bounded by triangles: areas raised to a height, one upon the other.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "analysis/geometry/polygon.hpp"

namespace formotion {

// Every edge belongs to two triangles, once in each direction; counter-clockwise seen from outside. Triangles have an
// area. Points and triangles are in a fixed order.
struct Solid {
  std::vector<Eigen::Vector3f> points;
  std::vector<std::array<int, 3>> triangles;
};

struct Layer {
  std::vector<Polygon> area;  // pieces may overlap and touch: they are united
  double height_mm = 0;
};

// The layers upon each other, the first one on z = 0; of one piece or several. At most 31.
// Corners are moved to a grid on which floats are exact: 6e-5 mm, coarser where a coordinate is beyond 1024 mm. What
// would meet itself in a single point or line, such as areas that touch at a corner, is joined there by some 0.01 mm of
// material.
Solid stacked(const std::vector<Layer>& layers);

}  // namespace formotion
