// The contours of a drawing of shapes, read back.
#pragma once

#include <string>
#include <vector>

#include "analysis/geometry/polygon.hpp"

namespace formotion {

struct DrawnShapes {
  std::vector<Loop> fixed, part;  // of the part: the outline first
};
// Layers FIXED and PART. Throws InputError.
DrawnShapes read_back(const std::string& dxf);

// The farthest that a corner of the one is from the other's edges.
double apart_mm(const std::vector<Loop>& a, const std::vector<Loop>& b);

}  // namespace formotion
