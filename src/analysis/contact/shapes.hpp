// The two sides of a contact: a moving part and fixed obstacles, as the edges and corners that can touch.
//
// Only convex corners can touch an edge (mechanics of polygons; derived). Obstacles may have rounded corners: a pin is
// one corner with a radius and no edge, and a polygon grown by e is its edges moved out by e and corners of radius e.
#pragma once

#include <optional>
#include <vector>

#include "analysis/contact/configuration.hpp"

namespace formotion {

// A range of directions, counter-clockwise from `from`: the outward normals at a corner.
struct DirectionRange {
  double from_rad = 0, width_rad = 0;
  bool contains(double direction_rad, double tolerance_rad = 0) const;
};

// An edge of the moving part, material on the left; frame: the centre of mass, the outline as given.
struct MovingEdge {
  Point from, to;
  Point along, normal;  // unit; the normal points out of the material
  double length_mm = 0;
  int index = 0;  // of its first corner: outline, then holes, as given
};

// A convex corner of the moving part.
struct MovingCorner {
  Point at;
  DirectionRange normals;  // outward
  int index = 0;
  int edge_before = 0, edge_after = 0;  // places in MovingShape::edges
};

struct MovingShape {
  std::vector<MovingEdge> edges;
  std::vector<MovingCorner> corners;
  std::vector<Polygon> bodies;  // disjoint areas
  double reach_mm = 0;          // the farthest corner from the centre of mass
  double gyration_mm = 1;       // radius of gyration of the damping

  // bodies: areas relative to the centre of mass; several (the layers of a part) act as their union.
  static MovingShape of(const std::vector<Polygon>& bodies, double gyration_mm);
};

// Of what a fixed feature is: its place in the list that the obstacles were made from.
struct FixedName {
  int component = 0;  // which shape
  int index = 0;      // its corner, or the first corner of its edge
};

struct FixedEdge {
  Point from, to;       // the free side is on the right
  Point along, normal;  // unit; the normal points into the free side
  double length_mm = 0;
  FixedName name;
};

struct FixedCorner {
  Point centre;
  double radius_mm = 0;
  DirectionRange normals;                      // outward; the whole circle for a pin
  FixedName name;                              // of the corner
  std::optional<int> edge_before, edge_after;  // places in Obstacles::edges
};

// One fixed shape as drawn.
struct ObstacleShape {
  Polygon area;           // or, with a radius, a disc about outer[0]
  double radius_mm = 0;   // 0: a polygon
  bool is_datum = false;  // the wall: its face on y = 0 does not grow
};

struct Obstacles {
  std::vector<FixedEdge> edges;
  std::vector<FixedCorner> corners;  // convex ones
  std::vector<Polygon> areas;        // without rounding: what the edges and corners with radius 0 bound
  bool round_exactly = true;         // false where tangents stand for arcs (see make_obstacles)
};

// The union of the shapes, grown (grow_mm > 0) or shrunk (< 0) but for data. Grown convex corners are round, exactly;
// inner corners, and all corners of shrunk shapes, stay sharp (a shrunk shape is thus never too small).
// Where growing makes an edge vanish (a notch closes), shapes are grown one by one and arcs become tangents
// (offset.hpp); edges then have no names. None where shrinking makes an edge vanish: the shapes are thinner than that.
std::optional<Obstacles> make_obstacles(const std::vector<ObstacleShape>& shapes, double grow_mm = 0);

}  // namespace formotion
