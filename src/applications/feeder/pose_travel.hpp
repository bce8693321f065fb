// The travel of every pose past a laid-out track: outcome, margin and what decided.
#pragma once

#include "applications/feeder/evaluation.hpp"
#include "applications/feeder/part_model.hpp"
#include "applications/feeder/passages.hpp"
#include "applications/feeder/tolerance.hpp"
#include "applications/feeder/track_layout.hpp"
#include "applications/feeder/void_rule.hpp"

namespace formotion::feeder {

inline constexpr double kLost_mm = -1e-9;     // margins below this are losses; 0 is marginal and holds
inline constexpr double kMarginal_mm = 1e-6;  // decisions by less than this mean nothing

struct PoseTravel {
  PoseResult result;
  double lacking_mm = 0;  // jammed: about how far it is from being rejected
  double nominal_mm = 0;  // what a tolerance can use up: margin and clearance, or the depth of the loss
  int aspect = 0;
  int exit_pose = -1;    // delivered: the stable pose in which it leaves
  int exit_class = -1;   // arrivals that leave alike, guided by an edge, have the same; on a track the exit pose
  double extent_mm = 0;  // along the feed, as it comes
};

// detail: also unsupported travel, tipping, catching, and the sentences.
std::vector<PoseTravel> travel_all(const PartModel& part, const Layout& layout, const Environment& environment,
                                   bool detail);
// passages: of this part, always asked with the same detail.
std::vector<PoseTravel> travel_all(const PartModel& part, const Layout& layout, const Environment& environment,
                                   bool detail, Passages& passages);

// Webs between voids thinner than least_mm, within the strip.
void check_webs(const Layout& layout, double least_mm, double track_width_mm, std::vector<Violation>& violations);
void collect_warnings(const std::vector<PoseTravel>& travels, const Layout& layout, const Environment& environment,
                      std::vector<std::string>& warnings);

}  // namespace formotion::feeder
