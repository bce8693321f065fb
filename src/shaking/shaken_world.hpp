// One nest and one part in Box2D 2.4, step by step.
//
// The nest is a kinematic body that moves along gravity's line; its outlines are edges that are solid on one side, so
// holes and overlapping pieces need no decomposition and a part catches on no seam. The part is one dynamic body of
// convex pieces whose seams end in its corners. Impacts restitute at any speed; the engine finds times of impact within
// steps.
#pragma once

#include <memory>

#include "shaking/shaking.hpp"

namespace formotion {

struct ShakenStart {
  Configuration at;  // relative to the nest
  Twist velocity;    // relative to the nest, mm/s and rad/s
  double phase_rad = 0;
};

class ShakenWorld {
 public:
  ShakenWorld(const ShakenScene& scene, const ShakenStart& start, double step_s);
  ~ShakenWorld();
  ShakenWorld(const ShakenWorld&) = delete;
  ShakenWorld& operator=(const ShakenWorld&) = delete;

  void step();
  double time_s() const;
  Configuration part() const;  // relative to the nest
  Twist velocity() const;      // of the part, not relative
  double nest_mm() const;      // over the table's mean level
  double gyration_mm() const;  // of the part, its area taken as uniform
  double energy_mm() const;    // over weight: height over the table's mean level and both motions

 private:
  struct Engine;
  std::unique_ptr<Engine> engine_;
};

}  // namespace formotion
