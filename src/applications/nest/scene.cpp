#include "applications/nest/scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace formotion::nest {
namespace {

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

// Of gravity, with the pallet's tilt.
double direction_deg(const Environment& environment, std::span<const double> values, const Member& member) {
  return member.value_of("gravity_deg", environment.gravity_deg.value(values)) +
         member.value_of("tilt_deg", environment.tilt_deg.value(values));
}

// Exact where the direction is along an axis.
Point direction(double degrees) {
  const double quarters = degrees / 90;
  if (quarters == std::round(quarters)) {
    const int turns = static_cast<int>(((static_cast<long>(quarters) % 4) + 4) % 4);
    constexpr double kCos[] = {1, 0, -1, 0}, kSin[] = {0, 1, 0, -1};
    return {kCos[turns], kSin[turns]};
  }
  return {std::cos(radians(degrees)), std::sin(radians(degrees))};
}

// Of what the environment's key may be, at this member of the rest.
std::pair<double, double> ends(const NestSpec& spec, std::span<const double> values, const Number& number,
                               const std::string& key, const Member& member = {}) {
  const auto interval = spec.uncertainty.intervals.find(key);
  if (!member.values.count(key) && interval != spec.uncertainty.intervals.end()) return interval->second;
  const double value = member.value_of(key, number.value(values));
  return {value, value};
}

}  // namespace

Configuration seat_of(const NestSpec& spec, std::span<const double> values) {
  const SeatSpec& seat = spec.goal.seat;
  return {seat.at_mm[0](values), seat.at_mm[1](values), seat.orientation_rad};
}

std::vector<Violation> defects_of(const NestSpec& spec, int topology, std::span<const double> values) {
  std::vector<Violation> found;
  for (const AspectShape& shape : aspect_shapes(spec.part, values)) {
    if (const auto what = defect(shape.footprint)) found.push_back({*what, "/part", 1});
  }
  const DesignSpec& design = spec.designs[static_cast<std::size_t>(topology)];
  for (std::size_t i = 0; i < design.nest_mm.size(); ++i) {
    if (const auto what = defect(normalised({evaluated(design.nest_mm[i], values), {}})))
      found.push_back({*what, "/nest_mm/" + std::to_string(i), 1});
  }
  return found;
}

std::unique_ptr<Scene> scene_of(const NestSpec& spec, int topology, std::span<const double> values,
                                const AspectShape& shape, const Member& member) {
  auto scene = std::make_unique<Scene>();
  scene->shape = shape;
  scene->symmetry = rotational_order(shape);
  // The centre of mass off by centre_off: the outline moves the other way about it.
  Polygon body = placed(shape.footprint, 0, -member.centre_off_mm);
  const AreaMoments moments = area_moments(body);
  const double polar = moments.second_mm4.trace() + moments.area_mm2 * moments.centroid.squaredNorm();
  scene->part = MovingShape::of({body}, std::sqrt(polar / moments.area_mm2));
  std::vector<ObstacleShape> shapes;
  for (const AffineLoop& loop : spec.designs[static_cast<std::size_t>(topology)].nest_mm)
    shapes.push_back({normalised({evaluated(loop, values), {}}), 0, false});
  auto obstacles = make_obstacles(shapes, member.grow_mm);
  if (!obstacles) return nullptr;
  scene->obstacles = std::move(*obstacles);
  scene->space = std::make_unique<ContactSpace>(scene->part, scene->obstacles);
  scene->gravity.down = direction(direction_deg(spec.environment, values, member));
  scene->friction = member.value_of("friction", spec.environment.friction.value(values));
  scene->outside = beyond(scene->obstacles, scene->gravity);
  return scene;
}

PushSet push_set(const NestSpec& spec, std::span<const double> values, const Member& member) {
  const Environment& environment = spec.environment;
  const auto [from, to] = ends(spec, values, environment.gravity_deg, "gravity_deg", member);
  const auto [tilt_from, tilt_to] = ends(spec, values, environment.tilt_deg, "tilt_deg", member);
  const auto [least, most] = ends(spec, values, environment.friction, "friction", member);
  return {radians(from + tilt_from), radians(to + tilt_to), least, most};
}

ImpactLaw impact_law(const NestSpec& spec, std::span<const double> values, const Scene& scene) {
  const Environment& environment = spec.environment;
  const Number& restitution = environment.table ? environment.table->restitution : environment.restitution;
  return {ends(spec, values, restitution, "restitution").second,
          ends(spec, values, environment.friction, "friction").second, scene.part.gyration_mm};
}

Configuration reduced(const Configuration& q, int symmetry) {
  const double period = 2 * std::numbers::pi / symmetry;
  double theta = std::fmod(q.theta_rad, period);
  if (theta < 0) theta += period;
  if (period - theta < 1e-9) theta = 0;
  return {q.x_mm, q.y_mm, theta};
}

double apart_mm(const Scene& scene, const Configuration& a, const Configuration& b) {
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < scene.symmetry; ++k) {
    const double turn = 2 * std::numbers::pi * k / scene.symmetry;
    double farthest = 0;
    for (const MovingCorner& corner : scene.part.corners) {
      const Point first = a.position() + rotated(corner.at, a.theta_rad + turn);
      farthest = std::max(farthest, (first - b.position() - rotated(corner.at, b.theta_rad)).norm());
    }
    least = std::min(least, farthest);
  }
  return least;
}

Configuration member_near(const NestRest& rest, const Configuration& q) {
  Configuration nearest = rest.at;
  double least = (rest.at.position() - q.position()).norm();
  for (std::size_t i = 0; i + 1 < rest.set.size(); ++i) {
    const Point from = rest.set[i].position(), way = rest.set[i + 1].position() - from;
    const double share = way.isZero(0) ? 0 : std::clamp((q.position() - from).dot(way) / way.squaredNorm(), 0.0, 1.0);
    const Point at = from + share * way;
    if ((at - q.position()).norm() >= least) continue;
    least = (at - q.position()).norm();
    nearest = {at.x(), at.y(), rest.at.theta_rad};
  }
  return nearest;
}

double apart_mm(const Scene& scene, const Configuration& q, const NestRest& rest) {
  return apart_mm(scene, q, member_near(rest, q));
}

}  // namespace formotion::nest
