#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "analysis/geometry/boolean.hpp"
#include "applications/assembly/judge.hpp"

namespace formotion::assembly {
namespace {

constexpr double kSlanted_rad = 0.052359877559829887;  // 3 degrees

Point at(const AffinePoint& p, std::span<const double> values) { return {p[0](values), p[1](values)}; }
Loop at(const AffineLoop& loop, std::span<const double> values) {
  Loop points;
  for (const AffinePoint& p : loop) points.push_back(at(p, values));
  return points;
}

double worth(const Number& number, const std::string& name, std::span<const double> values, const Member& member) {
  return member.value_of(name, number.value(values));
}

// Runs of slanted edges of a closed line, by their extent across.
double widest_slant(const Loop& loop, const Point& along) {
  const std::size_t n = loop.size();
  const Point aside = turned_left(along);
  const auto slanted = [&](std::size_t i) {
    const Point edge = loop[(i + 1) % n] - loop[i];
    const double angle = std::atan2(std::abs(edge.dot(aside)), std::abs(edge.dot(along)));
    return angle > kSlanted_rad && angle < 1.5707963267948966 - kSlanted_rad;
  };
  double widest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (!slanted(i) || slanted((i + n - 1) % n)) continue;  // runs begin here
    double extent = 0;
    for (std::size_t k = i; slanted(k % n) && k < i + n; ++k)
      extent += std::abs((loop[(k + 1) % n] - loop[k % n]).dot(aside));
    widest = std::max(widest, extent);
  }
  return widest;
}

}  // namespace

Joint joint_of(const AssemblySpec& spec, int topology, std::span<const double> values) {
  Joint joint;
  joint.part.outer = at(spec.part.outline_mm, values);
  for (const AffineLoop& hole : spec.part.holes_mm) joint.part.holes.push_back(at(hole, values));
  joint.part_mm = loops_of(joint.part);
  joint.part = normalised(std::move(joint.part));
  for (const AffineLoop& loop : spec.designs[topology].fixed_mm) joint.fixed_mm.push_back(at(loop, values));
  joint.centre_mm =
      spec.support.centre_is_centroid ? area_moments(joint.part).centroid : at(spec.support.centre_mm, values);
  joint.com_mm = spec.part.com_mm.value_or(area_moments(joint.part).centroid);
  return joint;
}

std::vector<Violation> defects(const AssemblySpec& spec, int topology, std::span<const double> values) {
  std::vector<Violation> found;
  const Joint joint = joint_of(spec, topology, values);
  if (const auto what = defect(joint.part)) found.push_back({*what, "/part", 1});
  for (std::size_t i = 0; i < joint.fixed_mm.size(); ++i) {
    if (const auto what = defect(normalised({joint.fixed_mm[i], {}})))
      found.push_back({*what, "/fixed_mm/" + std::to_string(i), 1});
  }
  for (const auto& [name, number] :
       {std::pair{"x", &spec.support.kx}, {"y", &spec.support.ky}, {"theta", &spec.support.ktheta}}) {
    if (const double k = number->value(values); !(k > 0))
      found.push_back(
          {(spec.support.damper ? "b" : "k") + std::string(name) + " is not positive", "/environment", 1 - k});
  }
  return found;
}

std::unique_ptr<Scene> scene_of(const AssemblySpec& spec, int topology, std::span<const double> values,
                                const std::string& aspect, double orientation_rad, const Member& member) {
  const Joint joint = joint_of(spec, topology, values);
  const Point centre = joint.centre_mm + member.centre_off_mm;
  Polygon body = joint.part;
  const auto place = [&](Loop& loop) {
    for (Point& p : loop) p = Joint::held(p, centre, aspect);
  };
  place(body.outer);
  for (Loop& hole : body.holes) place(hole);
  body = normalised(std::move(body));
  auto scene = std::make_unique<Scene>();
  double reach = 0;
  for (const Point& p : body.outer) reach = std::max(reach, p.norm());
  const SupportSpec& support = spec.support;
  Stiffness stiffness{worth(support.kx, "kx_n_per_mm", values, member),
                      worth(support.ky, "ky_n_per_mm", values, member),
                      worth(support.ktheta, "ktheta_nmm_per_rad", values, member)};
  double gyration = reach / 2;  // comparable to a radius of gyration: a measure of tilts
  if (support.damper) {
    const double b = worth(support.kx, "bx_ns_per_mm", values, member);  // and by, which is the same
    stiffness = {b, b, worth(support.ktheta, "btheta_nmms_per_rad", values, member)};
    gyration = std::sqrt(stiffness.ktheta_nmm_per_rad / b);
  }
  scene->part = MovingShape::of({body}, gyration);
  std::vector<ObstacleShape> shapes;
  for (const Loop& loop : joint.fixed_mm) shapes.push_back({normalised({loop, {}}), 0, false});
  auto obstacles = make_obstacles(shapes, member.grow_mm);
  if (!obstacles) return nullptr;
  scene->obstacles = std::move(*obstacles);
  scene->space = std::make_unique<ContactSpace>(scene->part, scene->obstacles);
  InsertionTask& task = scene->task;
  task.space = scene->space.get();
  task.stiffness = stiffness;
  if (support.damper) task.damper_speed_mm_s = spec.approach.speed_mm_s;
  task.friction = worth(spec.friction, "friction", values, member);
  task.approach.direction = {std::cos(spec.approach.direction_rad), std::sin(spec.approach.direction_rad)};
  // Exact where the approach is along an axis.
  for (int k = 0; k < 2; ++k) {
    if (std::abs(task.approach.direction[k]) < 1e-15) task.approach.direction[k] = 0;
  }
  task.approach.distance_mm = spec.approach.distance_mm;
  task.approach.max_force_n = spec.approach.max_force_n;
  task.drawn = {centre.x(), centre.y(), orientation_rad};
  task.goal = {spec.goal.depth_mm, spec.goal.lateral_mm, spec.goal.tilt_rad};
  return scene;
}

double measured_chamfer_mm(const Joint& joint, double approach_rad) {
  const Point along(std::cos(approach_rad), std::sin(approach_rad));
  double widest = widest_slant(joint.part.outer, along);
  for (const Loop& loop : joint.fixed_mm) widest = std::max(widest, widest_slant(loop, along));
  return widest;
}

}  // namespace formotion::assembly
