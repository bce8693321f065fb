// One aspect of the part among a design's obstacles: what the analysis of contacts and motion works on.
#pragma once

#include "analysis/motion/projection.hpp"
#include "applications/feeder/track_layout.hpp"
#include "applications/shared/part_shapes.hpp"

namespace formotion::feeder {

struct World {
  MovingShape part;
  Obstacles obstacles;
  Drive drive;
  std::vector<ObstacleShape> shapes;  // what the obstacles are made of, by component
};

// Obstacles but for the wall grown (or shrunk) by grow_mm; none where that makes one vanish.
std::optional<World> world_of(const AspectShape& shape, const Layout& layout, const Environment& environment,
                              double part_diameter_mm, double grow_mm = 0);

// The environment's radius of gyration; default: the footprint's about the centre of mass.
double gyration_mm(const AspectShape& shape, const Environment& environment);
Drive drive_of(const Environment& environment);
// How far the wall must go on: no part meets its ends.
double far_mm(const Layout& layout, double part_diameter_mm);

}  // namespace formotion::feeder
