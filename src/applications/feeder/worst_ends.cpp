#include "applications/feeder/worst_ends.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/geometry/offset.hpp"
#include "applications/feeder/pose_travel.hpp"

namespace formotion::feeder {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kJustNot_mm = 1e-6;

// Whether a rail that is off by this much holds the pose in some members alone.
bool may_be_held(const PoseModel& pose, const Layout& layout, double off_mm) {
  return std::any_of(layout.features.begin(), layout.features.end(), [&](const LaidFeature& feature) {
    return feature.holds_down && off_mm > 0 && std::abs(*feature.blade_mm - 2 * pose.height_mm) <= off_mm;
  });
}

// The narrowest of the voids' openings to the free edge: a pose that is no thicker falls wherever it is lost.
double least_opening(const Layout& layout, double reach_mm, double track_width_mm) {
  double least = kInfinity;
  for (const VoidGroup& group : grouped(layout, reach_mm)) {
    for (const VoidPieces::Piece& piece : void_pieces(group, track_width_mm).pieces)
      least = std::min(least, piece.opening_mm);
  }
  return least;
}

std::vector<PoseTravel> travels(const PartModel& poses, const Layout& layout, const Environment& environment,
                                bool detail, std::int64_t& work) {
  Passages passages(poses);
  std::vector<PoseTravel> found = travel_all(poses, layout, environment, detail, passages);
  work += passages.sweeps;
  return found;
}

}  // namespace

Layout with_errors(const Layout& layout, double voids_mm, double blades_mm, double reach_mm) {
  if (voids_mm == 0 && blades_mm == 0) return layout;
  Layout moved;
  moved.length_mm = layout.length_mm;
  for (const VoidGroup& group : grouped(layout, reach_mm)) {
    LaidFeature feature;
    feature.type = layout.features[static_cast<std::size_t>(group.features.front())].type;
    feature.voids = offset(group.loops, voids_mm);
    if (feature.voids.empty()) continue;
    Box box;
    for (const Loop& loop : feature.voids) {
      for (const Point& p : loop) box.include(p);
    }
    feature.own_voids = feature.voids;  // its start is at 0
    feature.x_min = box.min.x();
    feature.end_mm = feature.x_max = box.max.x();
    moved.features.push_back(std::move(feature));
  }
  for (const LaidFeature& drawn : layout.features) {
    if (!drawn.voids.empty()) continue;
    moved.features.push_back(drawn);
    if (drawn.blade_mm) *moved.features.back().blade_mm += blades_mm;
  }
  return moved;
}

std::vector<WorstEnd> worst_kept(const PartSpread& spread, const std::vector<int>& poses, const Layout& layout,
                                 const Environment& environment, std::int64_t& work) {
  std::vector<WorstEnd> ends;
  if (poses.empty()) return ends;
  const double f = spread.uncertainty.feature_mm;
  const Layout grown = with_errors(layout, f, -f, spread.least.longest_mm);
  const PartModel chosen = chosen_poses(spread.least, poses);
  const std::vector<PoseTravel> found = travels(chosen, grown, environment, false, work);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const PartSpread::Pose& pose = spread.poses[static_cast<std::size_t>(poses[i])];
    const PoseResult& result = found[i].result;
    WorstEnd end;
    if (result.outcome == Outcome::Delivered) {
      end.slack_mm = std::min(*result.margin_mm - pose.away_mm, blade_clearance(chosen.poses[i], grown));
    } else {
      end.slack_mm = -found[i].nominal_mm - pose.away_mm - kJustNot_mm;
    }
    if (!pose.remains || may_be_held(chosen.poses[i], layout, f)) end.slack_mm = std::min(end.slack_mm, -kJustNot_mm);
    ends.push_back(end);
  }
  return ends;
}

std::vector<WorstEnd> worst_lost(const PartSpread& spread, const std::vector<int>& poses, const Layout& layout,
                                 const Environment& environment, bool require_tip, std::int64_t& work) {
  std::vector<WorstEnd> ends;
  if (poses.empty()) return ends;
  const double f = spread.uncertainty.feature_mm;
  const Layout shrunk = with_errors(layout, -f, f, spread.most.longest_mm);
  const PartModel chosen = chosen_poses(spread.most, poses);
  const std::vector<PoseTravel> found = travels(chosen, shrunk, environment, require_tip, work);
  const double opening = least_opening(shrunk, spread.most.longest_mm, environment.track_width_mm);
  std::vector<int> look, where;  // poses whose fall no argument decides
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const PartSpread::Pose& pose = spread.poses[static_cast<std::size_t>(poses[i])];
    const PoseResult& result = found[i].result;
    const double clearance = blade_clearance(chosen.poses[i], shrunk);
    WorstEnd end;
    if (result.outcome == Outcome::Delivered) {
      end.slack_mm = -std::max(kJustNot_mm, std::min(*result.margin_mm + pose.away_mm, clearance));
    } else {
      end.slack_mm = std::max(found[i].nominal_mm - pose.away_mm, clearance < 0 ? -clearance : -kInfinity);
      // What is supported by next to nothing in one member may be by nothing in another.
      if (end.slack_mm <= 0) end.slack_mm -= kJustNot_mm;
      end.may_jam = result.outcome == Outcome::Jammed;
      end.lacking_mm = found[i].lacking_mm;
      if (!end.may_jam && opening < chosen.poses[i].height_mm) {
        look.push_back(poses[i]);
        where.push_back(static_cast<int>(i));
      }
    }
    if (may_be_held(chosen.poses[i], layout, f)) end.slack_mm = std::min(end.slack_mm, -kJustNot_mm);
    if (require_tip && result.unsupported_mm && result.tip_mm) {
      const double faster = spread.speed_mm_s.second / environment.conveying_speed_mm_s;
      end.hurried_mm = std::max(0.0, *result.tip_mm * faster - *result.unsupported_mm);
    }
    ends.push_back(end);
  }
  const bool all_lost = std::all_of(ends.begin(), ends.end(), [](const WorstEnd& end) { return end.slack_mm >= 0; });
  if (look.empty() || !all_lost) return ends;
  // In the other extreme member they may be lost elsewhere.
  const Layout grown = with_errors(layout, f, -f, spread.least.longest_mm);
  const PartModel others = chosen_poses(spread.least, look);
  const std::vector<PoseTravel> again = travels(others, grown, environment, false, work);
  for (std::size_t k = 0; k < look.size(); ++k) {
    if (again[k].result.outcome != Outcome::Jammed) continue;
    ends[static_cast<std::size_t>(where[k])].may_jam = true;
    ends[static_cast<std::size_t>(where[k])].lacking_mm = again[k].lacking_mm;
  }
  return ends;
}

double worst_tolerance(const PartSpread& spread, const DemandedPoses& kept, const DemandedPoses& lost,
                       const Layout& layout, std::int64_t& work) {
  const double f = spread.uncertainty.feature_mm;
  double worst = kInfinity;
  for (const DemandedPoses* demanded : {&kept, &lost}) {
    for (const WorstEnd& end : demanded->ends) worst = std::min(worst, end.slack_mm);
  }
  for (const bool is_kept : {true, false}) {
    const DemandedPoses& demanded = is_kept ? kept : lost;
    if (demanded.poses.empty()) continue;
    const PartModel& all = is_kept ? spread.least : spread.most;
    // A margin of e + away past voids that are off by f + e is one of E past voids off by (f - away) + E.
    double away = 0;
    for (const int i : demanded.poses) away = std::max(away, spread.poses[static_cast<std::size_t>(i)].away_mm);
    const double before = std::max(0.0, f - away);
    Layout moved = with_errors(layout, is_kept ? before : -before, 0, all.longest_mm);
    // Blades that push off are lower by f + e, not by E. Rails also hold; they are left to the adverse side.
    for (LaidFeature& feature : moved.features) {
      if (feature.blade_mm && !is_kept) *feature.blade_mm += feature.holds_down ? f : f - away;
    }
    const PartModel chosen = chosen_poses(all, demanded.poses);
    std::vector<PoseDemand> demands;
    for (const WorstEnd& end : demanded.ends) demands.push_back({true, is_kept, end.slack_mm + away});
    Passages passages(chosen);
    worst = std::min(worst, tolerance(chosen, moved, demands, passages, worst + away) - away);
    work += passages.sweeps;
  }
  return std::isfinite(worst) ? std::max(0.0, worst) : 0;
}

}  // namespace formotion::feeder
