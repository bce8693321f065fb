// Pegs over holes for tests of what cannot be reached.
#pragma once

#include "analysis/insertion/exclusion.hpp"

namespace formotion::testing {

inline Loop box_loop(double x_min, double y_min, double x_max, double y_max) {
  return {{x_min, y_min}, {x_max, y_min}, {x_max, y_max}, {x_min, y_max}};
}

// A part over fixed shapes, its lowest edge on y = lift, carried down. Not to be copied: the task points into it.
struct JointScene {
  MovingShape part;
  Obstacles obstacles;
  ContactSpace space;
  InsertionTask task;

  JointScene(const Polygon& drawn, const std::vector<Polygon>& fixed, double distance_mm, double turned_rad = 0,
             double lift_mm = 0)
      : part(MovingShape::of({drawn}, 5)), obstacles(made(fixed, turned_rad)), space(part, obstacles) {
    task.space = &space;
    task.stiffness = {10, 10, 20000};
    task.friction = 0.2;
    task.approach.direction = rotated(Point(0, -1), turned_rad);
    task.approach.distance_mm = distance_mm;
    double lowest = 0;
    for (const Point& p : drawn.outer) lowest = std::min(lowest, p.y());
    const Point at = rotated(Point(0, lift_mm - lowest), turned_rad);
    task.drawn = {at.x(), at.y(), turned_rad};
  }
  JointScene(const JointScene&) = delete;
  JointScene& operator=(const JointScene&) = delete;

 private:
  static Obstacles made(const std::vector<Polygon>& fixed, double turned_rad) {
    std::vector<ObstacleShape> shapes;
    for (const Polygon& area : fixed) shapes.push_back({placed(area, turned_rad, Point::Zero()), 0, false});
    return *make_obstacles(shapes);
  }
};

// A block with its top on y = 0 and a hole of this width, 20 deep.
inline Polygon block_with_hole(double width) {
  const double h = width / 2;
  return {{{-30, -25}, {30, -25}, {30, 0}, {h, 0}, {h, -20}, {-h, -20}, {-h, 0}, {-30, 0}}, {}};
}
inline Polygon square_peg() { return {box_loop(-5, -5, 5, 5), {}}; }

// A plate of 20 x 4 on a stem of 6 x 10 that is 3 to the right of its middle (mirrored: to the left), and a block with
// its pocket, 0.4 wider. Drawn rightly the part goes 14 deep; mirrored its plate lies on the rim at 10.
inline Polygon plate_with_stem(bool mirrored) {
  const Polygon part{{{0, -7}, {6, -7}, {6, 3}, {10, 3}, {10, 7}, {-10, 7}, {-10, 3}, {0, 3}}, {}};
  return mirrored ? mirrored_x(part) : part;
}
inline Polygon block_with_pocket() {
  return {{{-30, -20},
           {30, -20},
           {30, 0},
           {10.2, 0},
           {10.2, -4},
           {6.2, -4},
           {6.2, -14.2},
           {-0.2, -14.2},
           {-0.2, -4},
           {-10.2, -4},
           {-10.2, 0},
           {-30, 0}},
          {}};
}

}  // namespace formotion::testing
