// Height in a uniform field of force: the potential energy of a part over its weight.
#pragma once

#include "analysis/contact/configuration.hpp"

namespace formotion {

struct Gravity {
  Point down = Point(0, -1);  // unit

  double height_mm(const Point& p) const { return -down.dot(p); }
  double height_mm(const Configuration& q) const { return height_mm(q.position()); }
  // Across gravity: +x where down is -y.
  double across_mm(const Point& p) const { return turned_left(down).dot(p); }
};

}  // namespace formotion
