// All arrivals on a track with obstacles: poses, or the whole circle of orientations on a belt; their outcome map, and
// how far obstacles and voids may be off.
#pragma once

#include "applications/feeder/turning_track.hpp"

namespace formotion::feeder {

struct TurningEvaluation {
  std::vector<PoseTravel> poses;     // in the part model's order: what becomes of a part that comes in this pose
  std::vector<PoseTravel> arrivals;  // what metrics count, priors sum to 1: the poses, or on a belt the map's intervals
  std::vector<MapInterval> map;
  std::int64_t projections = 0;
};

// detail: also reasons.
TurningEvaluation travel_all_turning(const PartModel& part, const Layout& layout, const Environment& environment,
                                     bool detail);

// The stable pose in which a part leaves: kSameExit of its orientation, by symmetry; -1 if in none.
inline constexpr double kSameExit_rad = 1.7453292519943296e-4;  // 0.01 degrees
int exit_pose(const PartModel& part, int aspect, double exit_rad);

inline constexpr double kMostTurningTolerance_mm = 5;

// A lower bound, to 1e-3 mm, of the e up to which all of the following end as they do without errors (delivered ones
// in the same orientation and, where there are voids, with a margin of e): every arrival, past obstacles grown by e and
// shrunk by e, each with voids grown by e (for what is delivered) and shrunk by e (for what is not). On a belt the
// arrivals are the middles of the map's intervals, and a further ring of starts must end in no new way. Outcomes are
// not monotone in e: they are checked at every e of a ladder (0.01 mm, times sqrt 2 each) up to the first that fails,
// and between the last two by halving. At most kMostTurningTolerance_mm.
struct TurningTolerance {
  double tolerance_mm = 0;
  std::int64_t projections = 0;
};
// counted: the arrivals that it is asked of; empty: all.
TurningTolerance turning_tolerance(const PartModel& part, const Layout& layout, const Environment& environment,
                                   const TurningEvaluation& nominal, const std::vector<bool>& counted = {});

// The same design with another damping: which starts end otherwise?
struct Sensitivity {
  double gyration_factor = 1;
  bool same_outcomes = true;
  double changed_probability = 0;  // of arrivals that end otherwise
};
std::vector<Sensitivity> gyration_sensitivity(const PartModel& part, const Layout& layout,
                                              const Environment& environment, const TurningEvaluation& nominal);

// P(pose i arrives at the feature, leaves as pose j), every feature alone; what is missing in a row does not leave, or
// in no stable pose.
std::vector<std::vector<std::vector<double>>> transition_matrices(const PartModel& part, const Layout& layout,
                                                                  const Environment& environment);

}  // namespace formotion::feeder
