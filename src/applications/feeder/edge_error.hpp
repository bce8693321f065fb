// How far the edges of one group of voids may be off for one pose: the largest error that it bears.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "analysis/geometry/offset.hpp"
#include "applications/feeder/part_model.hpp"

namespace formotion::feeder {

// A pose that travels past voids which act together; positions have x from the group's origin. What is referred to must
// outlive it.
struct GroupTravel {
  const PoseModel& pose;
  const std::vector<Loop>& loops;
  const std::vector<Interval>& held;  // a rail holds the pose down there
};

// A search that can be stopped as soon as an answer is known, and goes on from there when more is asked. Its result is
// the same whatever was asked before: a pure function of the travel.
class EdgeError {
 public:
  // kept: the pose shall keep a margin of e past voids grown by e; else it shall be lost by e past voids shrunk by e.
  // most_mm: its margin or depth without errors, which no e exceeds.
  EdgeError(const GroupTravel& travel, bool kept, double most_mm);

  // Whether the largest error is e_mm or more.
  bool bears(double e_mm, std::int64_t& sweeps);
  // To 1e-8 mm, from below; 0 where even that is too much.
  double largest(std::int64_t& sweeps);

 private:
  void step(std::int64_t& sweeps);
  void probe(double e, std::int64_t& sweeps);
  void refine_or_end(std::int64_t& sweeps);

  GroupTravel travel_;
  bool kept_;
  double most_;
  // It bears low_, and not high_ where that was tried; slack without errors and with these.
  double low_ = 0, high_, at_low_, at_high_ = 0;
  bool tried_half_ = false, tried_high_ = false, ended_ = false;
  std::optional<double> beyond_;  // a hit from one side leaves the bracket's other end far away: looked at next
  double last_width_;
  int refinements_ = 0;
  double failed_e_ = 0;
  LeastMargin failed_;
  std::vector<ArcTangent> tangents_;
};

// Whether the pose bears one error, without the search: one sweep, and one for every time that arcs must be made finer.
bool bears_error(const GroupTravel& travel, bool kept, double e_mm, std::int64_t& sweeps);

}  // namespace formotion::feeder
