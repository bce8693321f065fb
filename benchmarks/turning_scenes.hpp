// Scenes in which parts turn at wall features: the same for forward projection and for Box2D.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/motion/projection.hpp"
#include "box2d_track.hpp"

namespace formotion::bench {

struct TurningScene {
  std::string name;
  Polygon part;  // about its centre of mass
  double gyration_mm = 1;
  std::vector<ObstacleShape> obstacles;
  Drive drive;
  double start_x_mm = 0, exit_x_mm = 0;
  bool has_wall = true;  // starts stand half a millimetre off it; without one they are centred at y = 0
};

Configuration start_at(const TurningScene& scene, double theta_rad);
Box2dTrack box2d_track(const TurningScene& scene);

// A ramp (0,0), (40,0), (40,15) with its foot prolonged below the wall, and a pin (85, 34) of radius 2; drive -30
// degrees, friction 0.2. Starts that have settled on the wall when they meet the ramp, and starts that have not.
// Two straight fences on a belt, drive 0. Parts: the L of docs/feeder.md, and a polygon of nine corners.
// At a pin of radius 2 the L jams, at one of 2.05 it does not; at one of 1.8 it jams for certain.
std::vector<TurningScene> turning_scenes();

// A random star-shaped part past one to three random ramps, fences and pins on the wall's track; drive and friction
// random too.
TurningScene random_scene(std::uint64_t seed);

}  // namespace formotion::bench
