// Drawings of a design's track that can be cut from: SVG with dimensions, DXF with the contours.
#pragma once

#include <string>
#include <vector>

#include "applications/feeder/evaluation.hpp"

namespace formotion {

struct TrackDrawing {
  std::string title;  // problem's name and design's id
  double track_width_mm = 0;
  double margin_mm = 30;  // plain track drawn before the first and after the last void
  std::vector<feeder::PlacedFeature> features;
  std::vector<std::string> notes;  // lines of the title block: tolerance, goal pose, ...
};

// To scale: printed without fitting to the page, 1 mm on paper is 1 mm. What each feature removes is dimensioned from
// the datum (x = 0) and the wall; the corners of cut-outs, drawings, fences and wall profiles, and pins, stand in
// tables.
std::string track_svg(const TrackDrawing& drawing);
// Layers: TRACK (what is cut: the contours of the metal, outer and inner), VOID (what is removed: each void within the
// strip as a closed contour, also where it is open to an edge, so that a `drawing` feature reads the track back), DATUM
// (y = 0 and the line x = 0), NOTE (texts), BLADE (wipers and rails, seen from above), WALL (what stands on the track,
// as closed contours that a `drawing` feature reads back; pins as circles), FACE (the wall's face, where profiles
// change it: recesses are only there), CENTER (crosses of pins). Lengths in mm. Metal that a void surrounds on all
// sides falls out when it is cut: it counts as void.
std::string track_dxf(const TrackDrawing& drawing);

}  // namespace formotion
