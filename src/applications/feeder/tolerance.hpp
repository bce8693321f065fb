// How far every edge of a track's voids may be off: the robustness that designs are ranked by.
#pragma once

#include <limits>

#include "applications/feeder/passages.hpp"

namespace formotion::feeder {

// Positions of the centre of mass at which a rail holds the pose down: the whole pose is under it, and the rail is
// lower than twice the pose (higher ones let it tip, and parts pass in piles).
std::vector<Interval> held_intervals(const PoseModel& pose, const Layout& layout);
// Of every pose, positions from origin_mm.
std::vector<std::vector<Interval>> held_from(double origin_mm, const PartModel& part, const Layout& layout);

// Signed clearance of the pose under the track's blades: the least of (blade height - part height); infinite without.
double blade_clearance(const PoseModel& pose, const Layout& layout);

// What the tolerance is asked for.
struct PoseDemand {
  bool counts = true;     // else whatever becomes of the pose
  bool kept = false;      // delivered; else lost
  double nominal_mm = 0;  // its margin or depth without errors: no tolerance can exceed it
};

// The largest e such that every delivered pose keeps a margin of at least e when all voids are grown by e, and every
// other pose is still lost by at least e when all voids are shrunk by e, to 1e-8 mm; at most at_most_mm. demands: of
// every pose.
// Blades count like edges: a pose that passes under one needs a clearance of e, one that a blade rejects
// must be taller by e. Support only falls as voids grow, so both conditions are monotone in e.
double tolerance(const PartModel& part, const Layout& layout, const std::vector<PoseDemand>& demands,
                 Passages& passages, double at_most_mm = std::numeric_limits<double>::infinity());

}  // namespace formotion::feeder
