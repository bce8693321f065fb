// Drawings of a design's track that can be cut from: SVG with dimensions, DXF with the contours; STL to be printed.
#pragma once

#include <string>
#include <vector>

#include "applications/feeder/evaluation.hpp"

namespace formotion {

struct TrackDrawing {
  std::string title;  // problem's name and design's id
  double track_width_mm = 0;
  double margin_mm = 30;           // plain track drawn before the first and after the last void
  double plate_mm = 3;             // thickness of the track
  double obstacle_height_mm = 10;  // of the wall and of what stands on the track, over the track
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
// The plate from z = 0 on, x and y as drawn; on it the wall, 5 mm deep behind its deepest recess, and what stands on
// the track. The plate goes on under the wall, but not under recesses, where it would support parts. What stands out
// over voids or the free edge hangs there. Blades (wipers, hold-downs) are left out: they belong to what carries them.
std::string track_stl(const TrackDrawing& drawing);

}  // namespace formotion
