// After support is lost: does the part fall off the track, or does it stay and jam?
#pragma once

#include "applications/feeder/part_model.hpp"
#include "applications/feeder/track_layout.hpp"

namespace formotion::feeder {

// The connected pieces of a group's voids within the strip.
struct VoidPieces {
  struct Piece {
    Polygon polygon;
    double opening_mm = 0;  // the longest stretch of the free edge that it meets
  };
  std::vector<Piece> pieces;
};

VoidPieces void_pieces(const VoidGroup& group, double track_width_mm);

// 0 if a pose that loses its support like this falls through, by the rule of docs/feeder.md: a void (or the free
// edge) under the material beyond the tipping line lets it through iff it meets the free edge over at least the part's
// thickness, or holds a rectangle, along the tipping line, as long as the part and as wide as its thickness. Necessary,
// not sufficient. Where two tipping lines are possible, both must let it through.
// Else about how many mm the voids lack: a slope for the search, no measure of safety.
double fall_shortfall(const PoseModel& pose, const SupportLoss& loss, const VoidPieces& pieces, double track_width_mm);

// Whether the polygon (a strip-clipped void) holds a rectangle of this length along direction (unit) and this width,
// up to 1e-6 mm.
bool holds_rectangle(const Polygon& polygon, const Point& direction, double length_mm, double width_mm);

}  // namespace formotion::feeder
