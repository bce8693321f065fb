// A part pushed along a track in a general engine, Box2D 2.4: what forward projection is measured against.
//
// Box2D steps a rigid body; damping so strong that a step forgets the last one's velocity makes its motion first order:
// velocity = force / damping, under the same law of contact as analysis/motion, to the engine's slop and iterations.
#pragma once

#include <vector>

#include "analysis/contact/configuration.hpp"
#include "analysis/contact/shapes.hpp"
#include "analysis/motion/projection.hpp"

namespace formotion::bench {

struct Box2dOptions {
  double free_travel_mm = 0.2;  // of one step without contact
  int velocity_iterations = 20, position_iterations = 8;
  int max_steps = 200'000;
  double unit_mm = 10;  // of the engine's length: shapes may overlap, or keep apart, by 0.005 of it
};

struct Box2dTrack {
  std::vector<Polygon> bodies;  // of the part, relative to its centre of mass
  double gyration_mm = 1;
  std::vector<ObstacleShape> obstacles;
  Drive drive;
  double exit_x_mm = 0;  // a part whose centre of mass passes it is delivered
};

struct Box2dOutcome {
  enum class End { Delivered, Stuck, Undecided } end = End::Undecided;
  Configuration last;
  int steps = 0;
};

// Stuck: in a window of 100 mm of free travel it came less than 0.05 mm and 0.05 degrees away.
Box2dOutcome run_box2d(const Box2dTrack& track, const Configuration& start, const Box2dOptions& options = {});

}  // namespace formotion::bench
