// What a track's drawing shows: the voids of all features together, the metal that is left, what stands on it, the
// wall's face, and how to say a contour's corners in few numbers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/track_drawing.hpp"

namespace formotion {

struct Disc {
  Point centre = Point::Zero();
  double radius_mm = 0;
};

// A stretch of the track: x_min to x_max, 0 to its width.
struct TrackOutline {
  double x_min = 0, x_max = 0, width_mm = 0;
  std::vector<Loop> voids;     // united, counter-clockwise; what they surround falls out, so it is void too
  std::vector<Polygon> metal;  // the stretch without the voids
  // What stands on the track: fences and what wall profiles have above y = 0, united where they meet (no part gets into
  // what they surround), and the pins that touch nothing else.
  std::vector<Loop> fences;
  std::vector<Disc> pins;
  Loop face;                    // the wall's, x ascending; profiles in place of y = 0
  double y_min = 0, y_max = 0;  // of obstacles, face and strip
  bool has_profile = false;     // the face is not just y = 0
};

// From the margin before the first start, corner or x = 0 to the margin behind the last of these.
TrackOutline track_outline(const TrackDrawing& drawing);

// A corner of a contour; rounded ones are given where their edges would meet, with the radius.
struct Corner {
  Point at = Point::Zero();
  double radius_mm = 0;  // 0: sharp
};

// The corners of a loop whose arcs are chords (three or more equal turns in a row are an arc). Arcs that turn too
// far to have a meeting point of edges, or that end in none, are given by their ends.
std::vector<Corner> corners_of(const Loop& loop);
// The circle that the whole loop stands for, if it does.
std::optional<Disc> disc_of(const Loop& loop);

// "12.346", "60.00": three decimals, the last one only where it is none; no negative zero.
std::string length_text(double value_mm);

// UTF-8 as it is, each byte that is none as '?', control characters as blanks.
std::string printable(const std::string& text);

}  // namespace formotion
