// Where a part is: the centre of mass and the rotation from the outline as given.
#pragma once

#include <cmath>

#include "analysis/geometry/polygon.hpp"

namespace formotion {

struct Configuration {
  double x_mm = 0, y_mm = 0;
  double theta_rad = 0;  // not wrapped: a full turn is another place of a path
  Point position() const { return {x_mm, y_mm}; }
};

// A velocity, or a displacement: of the centre of mass, and about it.
struct Twist {
  Point linear = Point::Zero();
  double angular = 0;
};

inline Point rotated(const Point& p, double c, double s) { return {c * p.x() - s * p.y(), s * p.x() + c * p.y()}; }
inline Point rotated(const Point& p, double theta) { return rotated(p, std::cos(theta), std::sin(theta)); }
inline Point turned_left(const Point& p) { return {-p.y(), p.x()}; }  // by 90 degrees

}  // namespace formotion
