// Outlines from DXF drawings.
#pragma once

#include <string>
#include <vector>

#include "analysis/geometry/polygon.hpp"
#include "io/input_error.hpp"

namespace formotion {

struct DxfOptions {
  double chord_tolerance_mm = 0.002;  // arcs become chords with their ends on the arc, inside of it by at most this
  double join_tolerance_mm = 1e-3;    // ends of entities closer than this are one point
  std::vector<std::string> layers;    // only these layers count, by name without regard to case; all if empty
};

struct DxfContour {
  std::string layer;  // as spelt in the options where they name layers, else as in the file
  Loop points_mm;     // closed, simple, counter-clockwise
};

// Every closed contour of the drawing (LINE, LWPOLYLINE and POLYLINE with bulges, ARC, CIRCLE; pieces join within
// their layer, in any order and direction), in file order of the contour's first entity. $INSUNITS is honoured (inch,
// feet, mm, cm, m, mil, micron; unitless is mm). Lines and contours drawn twice count once, lines without length not
// at all. What is not seen does not count: layers that are off or frozen, invisible entities, paper space. Texts,
// dimensions, hatches, points and construction lines never count.
// Open, crossing, self-touching contours, unsupported entities and unreadable files throw InputError, with positions
// in mm and in the drawing's units. Contours of one layer must not meet each other; those of different layers may.
std::vector<DxfContour> read_dxf(const std::string& path, const DxfOptions& options = {});
// The same from text; file is for messages.
std::vector<DxfContour> parse_dxf(const std::string& text, const std::string& file, const DxfOptions& options = {});

// The part in a drawing: the contours (any layer) as one outline with holes; errors unless exactly one is outermost.
Polygon read_dxf_part(const std::string& path, const DxfOptions& options = {});
Polygon parse_dxf_part(const std::string& text, const std::string& file, const DxfOptions& options = {});

}  // namespace formotion
