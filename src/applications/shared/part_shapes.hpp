// A part with its expressions evaluated: each aspect's areas about its centre of mass.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "applications/shared/part_spec.hpp"

namespace formotion {

struct AspectShape {
  std::string name;
  Polygon footprint;            // what needs support; outer counter-clockwise
  std::vector<Polygon> bodies;  // all layers (the footprint alone where there are none): what meets obstacles
  double height_mm = 0;
  double com_height_mm = 0;
  double probability = 1;
};

bool is_literal(const PartSpec& part);
Loop evaluated(const AffineLoop& loop, std::span<const double> values);
Polygon evaluated(const AffineLoop& outline, const std::vector<AffineLoop>& holes, std::span<const double> values);
std::vector<AspectShape> aspect_shapes(const PartSpec& part, std::span<const double> values);
// All loops of an aspect in the order in which their corners are numbered, as written, about its centre of mass.
std::vector<Loop> written_loops(const AspectSpec& spec, const AspectShape& shape, std::span<const double> values);
Loop all_corners(const AspectShape& shape);
// The greatest k for which all bodies map onto themselves when turned by 2 pi / k about the centre of mass.
int rotational_order(const AspectShape& shape);

}  // namespace formotion
