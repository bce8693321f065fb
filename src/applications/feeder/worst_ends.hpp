// Past voids and blades: how poses fare at the worst of all uncertain values together. Bounds that hold for every
// member (docs/uncertainty.md has the arguments).
#pragma once

#include "applications/feeder/part_spread.hpp"
#include "applications/feeder/track_layout.hpp"

namespace formotion::feeder {

struct WorstEnd {
  // Every member does as demanded with at least this margin, depth or clearance; negative: about how much that lacks.
  double slack_mm = 0;
  bool may_jam = false;   // of a pose that is lost: in a member that was looked at
  double lacking_mm = 0;  // then: about how far from falling
  double hurried_mm = 0;  // by how much its travel without support may be shorter than what it needs to tip
};

// A layout's voids grown (or shrunk) by voids_mm, blades raised by blades_mm. Voids that act together become one
// feature; obstacles stay.
Layout with_errors(const Layout& layout, double voids_mm, double blades_mm, double reach_mm);

// Of the spread's poses with these numbers, in their order.
std::vector<WorstEnd> worst_kept(const PartSpread& spread, const std::vector<int>& poses, const Layout& layout,
                                 const Environment& environment, std::int64_t& work);
// require_tip: also hurried_mm, which is looked at in one member.
std::vector<WorstEnd> worst_lost(const PartSpread& spread, const std::vector<int>& poses, const Layout& layout,
                                 const Environment& environment, bool require_tip, std::int64_t& work);

// How far every edge may be off beside what is uncertain: a lower bound, exact where feature_mm is not below how far
// the supported point may be off. Every pose must do as demanded at the worst, with the slack of its end.
struct DemandedPoses {
  std::vector<int> poses;
  std::vector<WorstEnd> ends;
};
double worst_tolerance(const PartSpread& spread, const DemandedPoses& kept, const DemandedPoses& lost,
                       const Layout& layout, std::int64_t& work);

}  // namespace formotion::feeder
