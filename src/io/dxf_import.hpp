// Outlines from DXF drawings.
#pragma once

#include <string>
#include <vector>

#include "analysis/geometry/polygon.hpp"
#include "io/input_error.hpp"

namespace formotion {

struct DxfOptions {
  double chord_tolerance_mm = 0.002;  // largest distance between an arc and the chords that stand for it
  double join_tolerance_mm = 1e-3;    // ends of entities closer than this are one point
};

struct DxfContour {
  std::string layer;
  Loop points_mm;  // closed, simple, counter-clockwise
};

// Every closed contour of the drawing (LINE, LWPOLYLINE and POLYLINE with bulges, ARC, CIRCLE), in file order of
// the contour's first entity. $INSUNITS is honoured (inch, mm, cm, m, ...; unitless is mm).
// Open, crossing, self-touching contours, unsupported entities and unreadable files throw InputError with positions in mm.
std::vector<DxfContour> read_dxf(const std::string& path, const DxfOptions& options = {});

// The part in a drawing: the contours (any layer) as one outline with holes; errors unless exactly one is outermost.
Polygon read_dxf_part(const std::string& path, const DxfOptions& options = {});

}  // namespace formotion
