// How far every edge of a track's voids may be off: the robustness that designs are ranked by.
#pragma once

#include <cstdint>

#include "applications/feeder/part_model.hpp"
#include "applications/feeder/track_layout.hpp"

namespace formotion::feeder {

struct ToleranceResult {
  double tolerance_mm = 0;
  std::int64_t sweeps = 0;
};

// Positions of the centre of mass at which a rail holds the pose down: the whole pose is under it, and the rail is
// lower than twice the pose (higher ones let it tip, and parts pass in piles).
std::vector<Interval> held_intervals(const PoseModel& pose, const Layout& layout);

// Signed clearance of the pose under the track's blades: the least of (blade height - part height); infinite without.
double blade_clearance(const PoseModel& pose, const Layout& layout);

// The largest e such that every delivered pose keeps a margin of at least e when all voids are grown by e, and every
// other pose is still lost by at least e when all voids are shrunk by e, to 1e-8 mm. delivered[i] says which pose i is.
// Blades count like edges: a pose that passes under one needs a clearance of e, one that a blade rejects
// must be taller by e. Support only falls as voids grow, so both conditions are monotone in e.
// nominal_mm[i]: margin or depth of pose i without errors; the tolerance cannot exceed the least of them.
ToleranceResult tolerance(const PartModel& part, const Layout& layout, const std::vector<bool>& delivered,
                          const std::vector<double>& nominal_mm);

}  // namespace formotion::feeder
