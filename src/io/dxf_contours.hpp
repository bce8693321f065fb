// Paths in any order and direction joined to closed contours.
#pragma once

#include <vector>

#include "io/dxf_entities.hpp"

namespace formotion {

// The closed contours that the drawing's paths make within each layer, counter-clockwise, without repeated and
// collinear corners, each once; what does not close goes to issues. The contours may still cross.
std::vector<DxfContour> joined_contours(const DxfDrawing& drawing, double join_tolerance_mm, DxfIssues& issues);

}  // namespace formotion
