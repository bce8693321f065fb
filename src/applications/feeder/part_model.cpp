#include "applications/feeder/part_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/resting/wall_poses.hpp"

namespace formotion::feeder {
PoseModel pose_model(const AspectShape& shape, const StablePose& stable, const Environment& environment) {
  PoseModel pose;
  pose.stable = stable;
  pose.height_mm = shape.height_mm;
  const Point offset(0, stable.com_wall_mm);
  pose.footprint = placed(shape.footprint, stable.orientation_rad, offset);
  Box box;
  for (const Polygon& body : shape.bodies) {
    pose.bodies.push_back(placed(body, stable.orientation_rad, offset));
    for (const Point& p : pose.bodies.back().outer) box.include(p);
  }
  pose.x_min = box.min.x();
  pose.x_max = box.max.x();
  pose.travelling = TravellingPart::of(pose.footprint, stable.com_wall_mm, wall_shift(shape.com_height_mm, environment),
                                       environment.track_width_mm);
  return pose;
}

bool PoseModel::footprint_reaches(double y_mm) const { return bounding_box(footprint.outer).max.y() > y_mm; }

double wall_shift(double com_height_mm, const Environment& environment) {
  return com_height_mm * std::tan(environment.tilt_rad);
}

PartModel part_model(const PartSpec& part, const Environment& environment, std::span<const double> values) {
  PartModel model;
  model.shapes = aspect_shapes(part, values);
  for (int aspect = 0; aspect < static_cast<int>(model.shapes.size()); ++aspect) {
    const AspectShape& shape = model.shapes[aspect];
    const Loop corners = all_corners(shape);
    model.diameter_mm = std::max(model.diameter_mm, diameter(corners));
    model.symmetry.push_back(rotational_order(shape));
    for (const WallPose& pose :
         merged_by_symmetry(wall_poses(corners, environment.settling_friction), model.symmetry.back())) {
      const StablePose stable{aspect,
                              pose.orientation_rad,
                              pose.com_wall_mm,
                              shape.probability * pose.basin_rad / (2 * std::numbers::pi),
                              pose.basin_from_rad,
                              pose.basin_rad};
      model.poses.push_back(pose_model(shape, stable, environment));
      model.longest_mm = std::max(model.longest_mm, model.poses.back().x_max - model.poses.back().x_min);
    }
  }
  return model;
}

}  // namespace formotion::feeder
