// Whether a placed part and the obstacles overlap, decided with a tolerance: touching is not overlapping.
//
// The boundaries are cut where the one touches the other. Without a proper crossing each piece then lies inside,
// outside, or on the other shape, and the piece's middle tells which. Interiors overlap iff boundaries cross, a piece
// lies inside, or two pieces lie on each other with their material on the same side (derived). Any closed loops will
// do for obstacles, also overlapping ones: a point is inside where they wind about it.
#pragma once

#include <vector>

#include "analysis/contact/shapes.hpp"

namespace formotion {

// Boundaries nearer than this touch, interiors that overlap by less do not overlap. The grid on which obstacles are
// united (boolean.hpp) moves corners by half of it, and rounding by 1e-13 at 100 mm.
inline constexpr double kTouching_mm = 1e-9;

struct BoundarySegment {
  Point from, to, along, normal;  // material on the left; unit; the normal points out of it
  double length_mm = 0;
  Box box;
};

// A fixed round corner as a curve, counter-clockwise.
struct BoundaryArc {
  Point centre;
  double radius_mm = 0;
  DirectionRange directions;  // the whole circle from width 2 pi on
  Point from, to;
  Box box;
};

struct Boundary {
  std::vector<BoundarySegment> segments;
  std::vector<BoundaryArc> arcs;
  std::vector<int> runs;  // the first segments of runs in which each begins where the last ended
  Box box;
};

Boundary fixed_boundary(const Obstacles& obstacles);
Boundary placed_boundary(const MovingShape& part, const Point& position, double c, double s);
// The boundary moved by offset, into a boundary that may be one of earlier calls (no allocation then).
void move_to(const Boundary& from, const Point& offset, Boundary& moved);

bool interiors_overlap(const Boundary& part, const Boundary& obstacles);

// The signed winding number of the boundary about p.
int winding(const Boundary& boundary, const Point& p);
// Wound about at least once, and farther than tolerance_mm from all boundary.
bool is_inside(const Boundary& boundary, const Point& p, double tolerance_mm);

double box_distance(const Box& a, const Box& b);  // 0 where they meet

}  // namespace formotion
