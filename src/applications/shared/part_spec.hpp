// A part as asked for: the ways it can lie, as outlines with expressions in the variables. mm.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/geometry/polygon.hpp"
#include "problem/affine.hpp"

namespace formotion {

struct LayerSpec {
  double from_mm = 0;  // height range above the track
  double to_mm = 0;
  AffineLoop outline_mm;
  std::vector<AffineLoop> holes_mm;
};

// One way to lie: an outline as written in the file, seen from above (feeders) or from the side (nests).
struct AspectSpec {
  std::string name;  // "up", "down" or the user's
  AffineLoop outline_mm;
  std::vector<AffineLoop> holes_mm;
  double height_mm = 0;                 // the part's thickness in this aspect
  std::optional<Point> com_mm;          // default: the centroid (of the volume where there are layers)
  std::optional<double> com_height_mm;  // above the track; default: half of height_mm
  double probability = 1;
  std::vector<LayerSpec> layers;  // ascending; the first is the footprint; empty: the outline at all heights
};

struct PartSpec {
  std::vector<AspectSpec> aspects;  // probabilities sum to 1
};

}  // namespace formotion
