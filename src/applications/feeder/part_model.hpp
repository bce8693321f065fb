// The part as the track meets it: aspects about their centres of mass, and the poses in which it arrives.
#pragma once

#include <span>
#include <vector>

#include "analysis/constraints/support_travel.hpp"
#include "applications/feeder/feeder_problem.hpp"
#include "applications/shared/part_shapes.hpp"

namespace formotion::feeder {

// A stable pose with its geometry; x from the centre of mass along the feed, y from the wall.
struct PoseModel {
  StablePose stable;
  Polygon footprint;
  std::vector<Polygon> bodies;
  TravellingPart travelling;
  double x_min = 0, x_max = 0;  // of all bodies
  double height_mm = 0;
  bool footprint_reaches(double y_mm) const;
};

struct PartModel {
  std::vector<AspectShape> shapes;
  std::vector<int> symmetry;  // rotational order of each aspect
  std::vector<PoseModel> poses;
  double diameter_mm = 0;  // the largest over aspects
  double longest_mm = 0;   // the largest extent of a pose along the feed
};

// Poses by aspect, then by orientation; their priors sum to 1 (where every aspect can rest).
PartModel part_model(const PartSpec& part, const Environment& environment, std::span<const double> values);

// The part in some orientation, its centre of mass at x = 0 and com_wall_mm over the wall, at rest or not.
PoseModel pose_model(const AspectShape& shape, const StablePose& stable, const Environment& environment);

// How far the supported point lies nearer to the wall than the centre of mass.
double wall_shift(double com_height_mm, const Environment& environment);

}  // namespace formotion::feeder
