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

std::string track_svg(const TrackDrawing& drawing);
// Layers: TRACK (the plate's outer contour with the voids that are open to an edge taken out), VOID (closed cut-outs),
// WALL (the wall's face, a line at y = 0), NOTE (texts), BLADE (wipers and rails, seen from above). Lengths in mm.
std::string track_dxf(const TrackDrawing& drawing);

}  // namespace formotion
