// Planar polygons: the shapes of parts, voids and tracks. Lengths in mm, angles in rad, counter-clockwise.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace formotion {

using Point = Eigen::Vector2d;
using Loop = std::vector<Point>;  // a closed polygonal line: the last point joins the first

// An area bounded by one outer loop (counter-clockwise) and holes (clockwise).
struct Polygon {
  Loop outer;
  std::vector<Loop> holes;
};

struct Box {
  Point min = Point::Constant(1e300);
  Point max = Point::Constant(-1e300);
  void include(const Point& p) {
    min = min.cwiseMin(p);
    max = max.cwiseMax(p);
  }
};

struct AreaMoments {
  double area_mm2 = 0;
  Point centroid = Point::Zero();
  Eigen::Matrix2d second_mm4 = Eigen::Matrix2d::Zero();  // integral of r r^T over the area, r from the centroid
};

enum class Side { Outside, Boundary, Inside };

inline double cross(const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); }

// Positive for counter-clockwise loops.
double signed_area(const Loop& loop);

// Turned so that outer loops are counter-clockwise and holes clockwise, without repeated and collinear
// vertices (those closer than tolerance_mm to the line of their neighbours).
Polygon normalised(Polygon polygon, double tolerance_mm = 1e-9);

// Why the polygon is not a simple area (fewer than three vertices, no area, edges that cross or touch,
// holes outside of the outline or inside each other), in words with the place; empty if it is one.
std::optional<std::string> defect(const Polygon& polygon);

AreaMoments area_moments(const Polygon& polygon);
Box bounding_box(const Loop& loop);
double diameter(const Loop& loop);  // the largest distance between two vertices

// Where p lies; Boundary within tolerance_mm of an edge.
Side locate(const Loop& loop, const Point& p, double tolerance_mm);
Side locate(const Polygon& polygon, const Point& p, double tolerance_mm);

double distance_to_segment(const Point& p, const Point& a, const Point& b);

// Rotated about the origin by theta (rad), then moved by offset.
Polygon placed(const Polygon& polygon, double theta, const Point& offset);
Polygon mirrored_x(const Polygon& polygon);  // x -> -x, orientations kept

// The convex hull, counter-clockwise, without collinear vertices (Andrew 1979).
Loop convex_hull(Loop points);

// The greatest k such that the polygon maps onto itself when turned by 2 pi / k about centre (vertices met
// within tolerance_mm); 1 for a part without rotational symmetry, 1 also for discs given as polygons of no order.
int rotational_order(const Polygon& polygon, const Point& centre, double tolerance_mm);
// Whether some reflection maps the polygon onto itself.
bool has_mirror_symmetry(const Polygon& polygon, const Point& centre, double tolerance_mm);

}  // namespace formotion
