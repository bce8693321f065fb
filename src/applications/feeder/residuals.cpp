#include "applications/feeder/residuals.hpp"

#include <ceres/jet.h>

#include <limits>

#include "analysis/geometry/offset.hpp"
#include "applications/feeder/configuration_support.hpp"
#include "applications/feeder/feeder_problem.hpp"
#include "applications/feeder/inverse_goals.hpp"
#include "applications/feeder/pose_travel.hpp"
#include "applications/feeder/turning_track.hpp"

namespace formotion::feeder {
namespace {

constexpr int kStride = 4;             // variables that one pass differentiates
constexpr double kSpare_mm = 1e-3;     // goals are asked for by this much more, so that rounding leaves none unmet
constexpr double kArcStep_rad = 0.05;  // of rounded corners: tangents leave arcs by 3e-4 of their radius
using Jet = ceres::Jet<double, kStride>;

class Pieces final : public SmoothPieces {
 public:
  Pieces(const FeederSpec& spec, int topology, std::vector<double> values, std::vector<int> used,
         std::vector<Residual> residuals, double part_diameter_mm)
      : spec_(spec),
        topology_(static_cast<std::size_t>(topology)),
        values_(std::move(values)),
        used_(std::move(used)),
        residuals_(std::move(residuals)),
        part_diameter_mm_(part_diameter_mm) {}

  int residuals() const override { return static_cast<int>(residuals_.size()); }
  bool lasts(int residual) const override { return residuals_[static_cast<std::size_t>(residual)].lasts; }

  bool evaluate(std::span<const double> values, double* residuals, double* jacobian) const override {
    const std::size_t n = used_.size();
    for (std::size_t first = 0; first == 0 || (jacobian && first < n); first += kStride) {
      std::vector<Jet> jets(values_.begin(), values_.end());
      for (std::size_t i = 0; i < n; ++i) {
        Jet& jet = jets[static_cast<std::size_t>(used_[i])];
        jet = Jet(values[i]);
        if (i >= first && i < first + kStride) jet.v[static_cast<Eigen::Index>(i - first)] = 1;
      }
      std::vector<std::optional<TracedShapes<Jet>>> shapes(spec_.part.aspects.size());
      for (std::size_t k = 0; k < residuals_.size(); ++k) {
        const Residual& residual = residuals_[k];
        auto& of_aspect = shapes[static_cast<std::size_t>(residual.aspect)];
        if (!of_aspect) {
          of_aspect = traced_shapes<Jet>(spec_, spec_.designs[topology_], residual.aspect, part_diameter_mm_, jets);
        }
        const Jet lacking = residual.wanted_mm - residual.sign * signed_mm(residual.piece, *of_aspect);
        if (!std::isfinite(lacking.a) || !lacking.v.allFinite()) return false;
        residuals[k] = std::max(0.0, lacking.a);
        for (std::size_t i = first; jacobian && i < std::min(n, first + kStride); ++i)
          jacobian[k * n + i] = lacking.a > 0 ? lacking.v[static_cast<Eigen::Index>(i - first)] : 0;
      }
    }
    return true;
  }

 private:
  const FeederSpec& spec_;
  std::size_t topology_;
  std::vector<double> values_;  // of all the problem's variables
  std::vector<int> used_;
  std::vector<Residual> residuals_;
  double part_diameter_mm_;
};

TracedShapes<double> shapes_of(const DesignCase& design, int aspect) {
  return traced_shapes<double>(design.spec, design.features, aspect, design.part.diameter_mm, design.values);
}

// Whether the piece is the distance from a hull's edge, not from its corner.
bool is_edge(const Piece& piece) {
  const auto* hull = std::get_if<HullRef>(&piece.decided_by);
  return hull && hull->to;
}

// The poses that a passive track shall keep: those that the goal names, or of those that it keeps the most frequent
// one; if it keeps none, the one that is lost by the least.
std::vector<bool> wanted_poses(const DesignCase& design, const Layout& layout) {
  const PartModel& part = design.part;
  std::vector<bool> wanted(part.poses.size(), false);
  if (!design.spec.goal.one_pose) {
    for (std::size_t i = 0; i < wanted.size(); ++i)
      wanted[i] = named_by_goal(design.spec.goal, part, part.poses[i].stable);
    return wanted;
  }
  Passages passages(part);
  const std::vector<PoseTravel> travels = travel_all(part, layout, design.spec.environment, false, passages);
  std::optional<std::size_t> best;
  const auto better = [&](const PoseTravel& a, const PoseTravel& b) {
    const bool a_kept = a.result.outcome == Outcome::Delivered, b_kept = b.result.outcome == Outcome::Delivered;
    if (a_kept != b_kept) return a_kept;
    return a_kept ? a.result.prior > b.result.prior : std::abs(a.nominal_mm) < std::abs(b.nominal_mm);
  };
  for (std::size_t i = 0; i < travels.size(); ++i) {
    if (!best || better(travels[i], travels[*best])) best = i;
  }
  if (best) wanted[*best] = true;
  return wanted;
}

}  // namespace

std::vector<Residual> goal_residuals(const DesignCase& design, const Layout& layout) {
  const FeederSpec& spec = design.spec;
  std::vector<Residual> residuals;
  for (const ConfigurationGoal& goal : spec.goal.configurations) {
    const AspectShape& shape = design.part.shapes[static_cast<std::size_t>(goal.aspect)];
    const TracedShapes<double> shapes = shapes_of(design, goal.aspect);
    const ActiveSearch search(shapes, spec.environment.track_width_mm);
    const bool contact = goal.must == Must::Free || goal.must == Must::Blocked;
    const ActiveAnswer answer =
        contact ? search.clearance(*world_of(shape, layout, spec.environment, design.part.diameter_mm), goal.q)
                : search.support(shape, track_of(layout, spec.environment), spec.environment, goal.q);
    if (!answer.piece) continue;
    const double sign = goal.must == Must::Free || goal.must == Must::Supported ? 1 : -1;
    // Apart, the clearance is the least of all pairs' distances; a depth is the least of all ways out; a margin the
    // least of all hull edges' distances.
    const bool lasts = contact ? sign * *answer.mm > 0 : sign > 0 && is_edge(*answer.piece);
    residuals.push_back({goal.aspect, *answer.piece, sign, goal.by_mm + kSpare_mm, sign * *answer.mm, lasts});
  }
  for (const FacetGoal& goal : spec.goal.facets) {
    const TracedShapes<double> shapes = shapes_of(design, goal.aspect);
    if (!facet_exists(goal, shapes)) continue;
    const Piece piece{{goal.reference, std::nullopt, std::nullopt}, facet_gap(goal, shapes)};
    residuals.push_back({goal.aspect, piece, -1, goal.outward_mm + kSpare_mm, -signed_mm(piece, shapes), true});
  }
  return residuals;
}

std::vector<Residual> tolerance_residuals(const DesignCase& design, const Layout& layout, const std::vector<bool>& kept,
                                          double tolerance_mm) {
  const PartModel& part = design.part;
  std::vector<Residual> residuals;
  OffsetOptions options;
  options.arc_step_rad = kArcStep_rad;
  std::vector<std::vector<Loop>> loops[2];  // by group: shrunk, grown
  for (const VoidGroup& group : grouped(layout, part.longest_mm + 2.2 * tolerance_mm)) {
    for (const bool grown : {false, true})
      loops[grown].push_back(offset(group.loops, grown ? tolerance_mm : -tolerance_mm, options));
  }
  for (std::size_t i = 0; i < part.poses.size(); ++i) {
    const PoseModel& pose = part.poses[i];
    const int aspect = pose.stable.aspect;
    const TracedShapes<double> shapes = shapes_of(design, aspect);
    const ActiveSearch search(shapes, design.spec.environment.track_width_mm);
    const double sign = kept[i] ? 1 : -1, grow = sign * tolerance_mm;
    std::optional<Residual> worst;  // of a lost pose the group that loses it best
    for (const std::vector<Loop>& group : loops[kept[i]]) {
      if (group.empty()) continue;
      const VoidOutline outline = VoidOutline::of(group);
      const LeastMargin least = least_margin({pose.travelling, outline, held_intervals(pose, layout)});
      if (!std::isfinite(least.margin_mm)) continue;
      const auto piece = search.travel(pose, part.shapes[static_cast<std::size_t>(aspect)], design.spec.environment,
                                       group, grow, least);
      if (!piece) continue;
      const Residual residual{aspect, *piece, sign, tolerance_mm, sign * least.margin_mm, kept[i] && is_edge(*piece)};
      if (kept[i]) {
        residuals.push_back(residual);
      } else if (!worst || residual.got_mm > worst->got_mm) {
        worst = residual;
      }
    }
    if (worst) residuals.push_back(*worst);
  }
  return residuals;
}

std::unique_ptr<SmoothPieces> as_pieces(const FeederSpec& spec, int topology, std::vector<double> values,
                                        std::vector<int> used, std::vector<Residual> residuals,
                                        double part_diameter_mm) {
  return std::make_unique<Pieces>(spec, topology, std::move(values), std::move(used), std::move(residuals),
                                  part_diameter_mm);
}

std::unique_ptr<SmoothPieces> FeederResiduals::pieces(const Candidate& candidate, const SmoothAim& aim) const {
  const FeederSpec& spec = problem_.spec();
  const std::vector<double> values = all_values(problem_, candidate);
  const PartModel part = part_model(spec.part, spec.environment, values);
  const std::vector<Violation> defects = defects_of(part);
  const DesignCase design{spec, spec.designs[static_cast<std::size_t>(candidate.topology)], part, defects, values};
  const Layout layout = lay_out(design.features, spec.environment, spec.manufacture, part.diameter_mm, values);
  if (!layout.invalid.empty() || !defects.empty()) return nullptr;
  std::vector<Residual> residuals = goal_residuals(design, layout);
  if (aim.objective && spec.objectives[*aim.objective].name == "tolerance_mm" && !has_obstacles(layout)) {
    const std::vector<Residual> more = tolerance_residuals(design, layout, wanted_poses(design, layout), aim.value);
    residuals.insert(residuals.end(), more.begin(), more.end());
  }
  const bool lacks =
      std::any_of(residuals.begin(), residuals.end(), [](const Residual& r) { return r.got_mm < r.wanted_mm; });
  if (!lacks) return nullptr;
  return as_pieces(spec, candidate.topology, values,
                   problem_.topologies()[static_cast<std::size_t>(candidate.topology)].variables, std::move(residuals),
                   part.diameter_mm);
}

}  // namespace formotion::feeder
