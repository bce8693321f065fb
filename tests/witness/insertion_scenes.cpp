#include "witness/insertion_scenes.hpp"

#include <cmath>
#include <numbers>

namespace formotion::witness {
namespace {

Loop mirrored(const Loop& loop) { return mirrored_x({loop, {}}).outer; }

Obstacles obstacles_of(const SteppingScene& scene) {
  std::vector<ObstacleShape> shapes;
  for (const Polygon& polygon : scene.fixed) shapes.push_back({polygon, 0, false});
  return *make_obstacles(shapes);
}

void push_down(SteppingScene& scene, double centre_y, double depth, double distance) {
  scene.drawn = {0, centre_y, 0};
  scene.approach = {Point(0, -1), distance, std::nullopt};
  scene.goal = {depth, 5, 0.2};
}

}  // namespace

SteppingScene scene_of(const PegInHole& joint) {
  const double r = joint.peg_half_mm, bottom = -joint.centre_mm, top = bottom + joint.peg_length_mm;
  const double c = joint.peg_chamfer_mm, slope = 1 / std::tan(joint.chamfer_rad);
  SteppingScene scene;
  if (c > 0) {
    scene.part.outer = {Point(-r, top),       Point(-r, bottom + c * slope), Point(-r + c, bottom),
                        Point(r - c, bottom), Point(r, bottom + c * slope),  Point(r, top)};
  } else {
    scene.part.outer = {Point(-r, top), Point(-r, bottom), Point(r, bottom), Point(r, top)};
  }
  const double hole = joint.hole_half_mm, u = joint.hole_chamfer_mm, far = hole + u + 30;
  Loop right = {Point(far, 0), Point(hole + u, 0), Point(hole, -u * slope), Point(hole, -joint.hole_depth_mm),
                Point(far, -joint.hole_depth_mm)};
  if (u == 0) right.erase(right.begin() + 1);
  scene.fixed = {{right, {}}, {mirrored(right), {}}};
  scene.stiffness = joint.stiffness;
  scene.friction = joint.friction;
  push_down(scene, joint.centre_mm + joint.above_mm, joint.above_mm + joint.seated_mm,
            joint.above_mm + joint.seated_mm + 3);
  return scene;
}

SteppingScene scene_of(const PointOnSlope& joint) {
  SteppingScene scene;
  // Slimmer than the slope, so that only the tip touches.
  const double half = 5 * std::tan(joint.slope_rad) * 0.5, h = joint.centre_mm;
  scene.part.outer = {Point(0, -h), Point(half, 5 - h), Point(half, 10), Point(-half, 10), Point(-half, 5 - h)};
  const double tangent = std::tan(joint.slope_rad), u = joint.width_mm, beyond = 4 * u;
  const Point foot(0, -u / tangent), head(-u - beyond, beyond / tangent);
  scene.fixed = {{{head, head + Point(-50, 0), Point(head.x() - 50, foot.y() - 20), foot + Point(0, -20), foot}, {}}};
  scene.stiffness = joint.stiffness;
  scene.friction = joint.friction;
  push_down(scene, h + 1, 1 + u / tangent, 20 + 2 * u / tangent);
  scene.drawn.x_mm = -u;
  scene.goal.lateral_mm = 100;
  return scene;
}

SteppingScene random_joint(Random& random) {
  PegInHole joint;
  joint.friction = uniform(random, 0.05, 0.5);
  joint.stiffness = {uniform(random, 2, 30), uniform(random, 20, 200), uniform(random, 2e3, 1e5)};
  joint.centre_mm = uniform(random, -5, 50);
  joint.hole_half_mm = joint.peg_half_mm + uniform(random, 0.05, 0.5);
  joint.hole_chamfer_mm = below(random, 3) ? uniform(random, 1, 4) : 0;
  joint.chamfer_rad = uniform(random, 0.3, 1.2);
  joint.peg_chamfer_mm = below(random, 2) ? uniform(random, 0.5, 2) : 0;
  SteppingScene scene = scene_of(joint);
  const int kind = below(random, 3);
  if (kind == 0) return scene;
  const double play = joint.hole_half_mm - joint.peg_half_mm, u = joint.hole_chamfer_mm, h = joint.centre_mm;
  const double depth = u / std::tan(joint.chamfer_rad);
  if (kind == 1) {
    // A slot of depth 30 over a tenon of half-width 5.
    const double w = 5 + play;
    scene.part.outer = {Point(-15, -h), Point(-w, -h), Point(-w, 30 - h), Point(w, 30 - h),
                        Point(w, -h),   Point(15, -h), Point(15, 45 - h), Point(-15, 45 - h)};
    const double c = std::min(u, 4.0), high = c / std::tan(joint.chamfer_rad);
    Loop tenon = {Point(-5, -45), Point(5, -45), Point(5, -high), Point(5 - c, 0), Point(c - 5, 0), Point(-5, -high)};
    if (c == 0) tenon = {Point(-5, -45), Point(5, -45), Point(5, 0), Point(-5, 0)};
    scene.fixed = {{tenon, {}}};
  } else {
    // Steps: half-width 6 for the lowest 10 mm, then 10; a floor at -34.
    scene.part.outer = {Point(-6, -h),     Point(6, -h),       Point(6, 10 - h),   Point(10, 10 - h),
                        Point(10, 50 - h), Point(-10, 50 - h), Point(-10, 10 - h), Point(-6, 10 - h)};
    const double w = 10 + play, n = 6 + play;
    Loop block = {Point(-45, -40), Point(45, -40), Point(45, 0), Point(w + u, 0)};
    if (u > 0) block.emplace_back(w, -depth);
    for (const Point& p : {Point(w, -22), Point(n, -22), Point(n, -34), Point(-n, -34), Point(-n, -22), Point(-w, -22)})
      block.push_back(p);
    if (u > 0) block.emplace_back(-w, -depth);
    block.emplace_back(-w - u, 0);
    block.emplace_back(-45, 0);
    scene.fixed = {{block, {}}};
  }
  return scene;
}

JointTask::JointTask(const SteppingScene& scene)
    : part(MovingShape::of({scene.part}, 10)), obstacles(obstacles_of(scene)), space(part, obstacles) {
  task.space = &space;
  task.stiffness = scene.stiffness;
  task.friction = scene.friction;
  task.approach = scene.approach;
  task.drawn = scene.drawn;
  task.goal = scene.goal;
}

}  // namespace formotion::witness
