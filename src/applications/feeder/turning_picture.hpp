// A design with obstacles as pictures need it: where parts of every orientation go, and the configuration space.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/motion/projection.hpp"
#include "applications/feeder/feeder_problem.hpp"
#include "applications/feeder/space_picture.hpp"
#include "applications/feeder/turning.hpp"

namespace formotion::feeder {

// Legs that go on with the motion and the contacts of the one before are of one.
struct LegPicture {
  MotionKind motion = MotionKind::Free;
  std::string event;                    // at its start
  std::size_t from = 0;                 // its first point
  std::vector<ActiveContact> contacts;  // at its start
};

// Straight between points to 0.01 mm, on and about the part. The last translation ends behind the last feature.
struct PathPicture {
  int aspect = 0;
  double start_rad = 0;
  Outcome outcome = Outcome::Undecided;
  std::string reason;
  bool is_goal = false;
  std::vector<LegPicture> legs;
  std::vector<Configuration> points;  // of the centre of mass; theta is not wrapped
};

// Starting orientations and the path of one of them. Where the drive pulls to the wall: those that settle into one
// pose, neighbours of one outcome apart (other than in the evaluation's map).
struct IntervalPicture {
  int aspect = 0;
  MapInterval interval;
  std::size_t path = 0;
};

struct ObstaclePicture {
  std::string name;
  ObstacleShape shape;  // walls without what is far below their face
};

struct TurningPicture {
  std::vector<ObstaclePicture> obstacles;  // components 1, 2, ...
  std::vector<Polygon> parts;              // by aspect, about the centre of mass: all heights
  std::vector<IntervalPicture> map;
  std::vector<PathPicture> paths;
  std::vector<SpacePicture> spaces;  // by aspect; empty unless asked for
  std::vector<Sensitivity> sensitivity;
  std::vector<std::string> poses, features;                   // names, of the matrices' rows and of the matrices
  std::vector<std::vector<std::vector<double>>> transitions;  // empty where the drive does not pull to the wall
};

// None where nothing can turn a part. values are of all the problem's variables.
std::optional<TurningPicture> turning_picture(const FeederProblem& problem, int topology,
                                              std::span<const double> values, bool with_space);

}  // namespace formotion::feeder
