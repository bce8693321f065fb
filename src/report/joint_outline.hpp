// What a joint's drawing measures, seen along the approach: pieces, widths that stay the same over a depth, slanted
// faces.
#pragma once

#include <vector>

#include "report/joint_drawing.hpp"

namespace formotion {

// Coordinates of the drawing: x across the approach (to its left), y along it.
struct ApproachFrame {
  Point across = Point(1, 0), along = Point(0, -1);

  explicit ApproachFrame(double approach_rad);
  Point seen(const Point& p) const { return {across.dot(p), along.dot(p)}; }
  Loop seen(const Loop& loop) const;
};

// The fixed shapes, each as written but counter-clockwise; united where some touch.
std::vector<Polygon> fixed_pieces(const std::vector<Loop>& fixed_mm);
// The drawn part, moved by the goal's depth.
Polygon at_goal(const JointDrawing& drawing);

// A place between two faces. In the drawing's coordinates, as all below.
struct Width {
  double from = 0, to = 0;      // across
  double y_from = 0, y_to = 0;  // along
  bool constant = true;         // both faces are parallel to the approach; else from, to are those at y_from
};

enum class Between { Material, Opening };

// Constant widths, and openings that narrow from the first level on (mouths).
std::vector<Width> widths(const std::vector<Loop>& loops, Between between);

struct SlantedFace {
  std::size_t loop = 0, edge = 0;  // edge i runs from corner i to the next
  Point from = Point::Zero(), to = Point::Zero();
  double width_mm = 0, depth_mm = 0, angle_rad = 0;  // across, along, to the approach
};

std::vector<SlantedFace> slanted_faces(const std::vector<Loop>& loops);

}  // namespace formotion
