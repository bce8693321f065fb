#include "applications/feeder/world.hpp"

#include <algorithm>
#include <cmath>

#include "applications/feeder/feeder_problem.hpp"

namespace formotion::feeder {

double gyration_mm(const AspectShape& shape, const Environment& environment) {
  if (environment.radius_of_gyration_mm) return *environment.radius_of_gyration_mm;
  const AreaMoments moments = area_moments(shape.footprint);
  // The footprint's origin is the centre of mass, which need not be its centroid.
  return std::sqrt(moments.second_mm4.trace() / moments.area_mm2 + moments.centroid.squaredNorm());
}

Drive drive_of(const Environment& environment) {
  return {{std::cos(environment.drive_rad), std::sin(environment.drive_rad)}, environment.wall_friction};
}

double far_mm(const Layout& layout, double part_diameter_mm) {
  double reach = 0;
  for (const LaidFeature& feature : layout.features)
    reach = std::max({reach, std::abs(feature.start_mm), std::abs(feature.end_mm)});
  return reach + 1e4 + 1000 * part_diameter_mm;
}

std::optional<World> world_of(const AspectShape& shape, const Layout& layout, const Environment& environment,
                              double part_diameter_mm, double grow_mm) {
  World world;
  world.part = MovingShape::of(shape.bodies, gyration_mm(shape, environment));
  world.shapes = obstacle_shapes(layout, far_mm(layout, part_diameter_mm));
  std::optional<Obstacles> obstacles = make_obstacles(world.shapes, grow_mm);
  if (!obstacles) return std::nullopt;
  world.obstacles = std::move(*obstacles);
  world.drive = drive_of(environment);
  return world;
}

}  // namespace formotion::feeder
