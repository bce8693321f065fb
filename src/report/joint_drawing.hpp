// Drawings of an assembly's joint that can be cut from: SVG with dimensions, DXF with the contours; STL to be printed.
#pragma once

#include <string>
#include <vector>

#include "analysis/geometry/polygon.hpp"

namespace formotion {

// What a drawing calls things: an assembly's, unless others are given.
struct JointWords {
  const char* arrow = "APPROACH";
  const char* direction = "The approach";
  const char* to_direction = "to approach";
  const char* shape = "fixed";  // of the tables of corners
  const char* shapes = "fixed shapes";
  const char* part = "part, as drawn";
  const char* part_layer = "the part where it starts";
  const char* goal = "part at the goal's depth";  // empty: the part is drawn in one place alone
  const char* centre = "compliance centre";
  bool has_goal() const { return *goal != 0; }
};
JointWords nest_words();

struct JointDrawing {
  std::string title;           // problem's name and design's id
  std::vector<Loop> fixed_mm;  // as written; shapes that touch are drawn as one piece
  Polygon part;                // as drawn, in the same frame
  Point centre_mm = Point::Zero();
  double approach_rad = -1.5707963267948966;
  double depth_mm = 0;             // the goal's
  std::vector<std::string> notes;  // lines of the title block: goal, start errors, friction, ...
  double thickness_mm = 10;        // of the fixed shapes
  JointWords words = {};
};

// The approach points down on paper. Enlarged or reduced by the scale that the title block names; its bar is 50 mm on
// paper. Constant widths of openings and of the part, the mouth and the slanted faces (width across the approach, depth
// along it, angle to it) are dimensioned; all corners stand in tables, in the file's coordinates.
std::string joint_svg(const JointDrawing& drawing);
// Layers: FIXED and PART (closed contours), GOAL (the part at the goal's depth), DATUM (the approach, or gravity,
// through the centre), CENTER (the centre's cross), NOTE (texts). Lengths in mm, the file's coordinates.
std::string joint_dxf(const JointDrawing& drawing);
// The fixed shapes from z = 0 on; those that touch are one.
std::string joint_stl(const JointDrawing& drawing);

}  // namespace formotion
