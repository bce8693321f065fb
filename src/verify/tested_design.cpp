#include "verify/tested_design.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numbers>
#include <sstream>

#include "applications/feeder/turning_track.hpp"

namespace formotion {
namespace {

using namespace feeder;

constexpr double kTurn = 2 * std::numbers::pi;

bool delivered(const PoseResult& pose) { return pose.outcome == Outcome::Delivered; }

double claimed_tolerance(const FeederProblem& problem, const Evaluated& stored, const FeederEvaluation& evaluation) {
  const std::span<const Objective> objectives = problem.objectives();
  for (std::size_t i = 0; i < objectives.size() && i < stored.score.objectives.size(); ++i) {
    if (objectives[i].name == "tolerance_mm" && stored.score.feasible) return stored.score.objectives[i];
  }
  return evaluation.metrics.tolerance_mm.value_or(0);
}

std::string ended(const Outcome outcome, const std::optional<double>& exit_rad) {
  std::ostringstream out;
  out << name(outcome);
  if (exit_rad) out << " at " << std::fixed << std::setprecision(2) << *exit_rad * 360 / kTurn << " deg";
  return out.str();
}

AffineLoop literal_loop(const Loop& loop) {
  AffineLoop result;
  for (const Point& p : loop) result.push_back({Affine{p.x(), {}}, Affine{p.y(), {}}});
  return result;
}

Comparison compare_passive(const TestedDesign& design, const Layout& other, const CompareOptions& options) {
  Comparison result;
  const std::vector<PoseTravel> travels = travel_all(design.part, other, design.environment(), false);
  for (std::size_t i = 0; i < travels.size(); ++i) {
    const PoseResult &before = design.arrivals[i].result, &now = travels[i].result;
    if (!(delivered(before) ? options.delivered : options.lost)) continue;
    if (delivered(before) != delivered(now)) {
      if (!result.difference)
        result.difference =
            design.pose_name(design.arrivals[i]) + " is " + name(now.outcome) + " in place of " + name(before.outcome);
      continue;
    }
    if (before.outcome == Outcome::Rejected && now.outcome == Outcome::Jammed) ++result.newly_jammed;
    double& least = delivered(now) ? result.least_margin_mm : result.least_depth_mm;
    least = std::min(least, travels[i].nominal_mm);
  }
  return result;
}

Comparison compare_turning(const TestedDesign& design, const Layout& other, const CompareOptions& options) {
  Comparison result;
  std::optional<TurningTrack> track = TurningTrack::of(design.part, other, design.environment(), options.errors);
  if (!track) {
    result.difference = "an obstacle vanishes";
    return result;
  }
  for (std::size_t i = 0; i < design.arrivals.size(); ++i) {
    const PoseTravel& arrival = design.arrivals[i];
    const PoseResult& before = arrival.result;
    if (!(delivered(before) ? options.delivered : options.lost)) continue;
    const Configuration start =
        design.belt ? track->belt_start(before.orientation_rad) : track->pose_start(design.part.poses[i]);
    const StartTravel travel =
        design.has_voids ? track->travel(arrival.aspect, start) : track->travel_quickly(arrival.aspect, start);
    const double period = kTurn / design.part.symmetry[static_cast<std::size_t>(arrival.aspect)];
    const bool same_exit = !delivered(before) || arrival.exit_class < 0 ||
                           (travel.exit_rad && std::abs(std::remainder(*travel.exit_rad - *before.exit_orientation_rad,
                                                                       period)) <= kSameExit_rad);
    if (travel.outcome != before.outcome || !same_exit) {
      if (!result.difference)
        result.difference = design.pose_name(arrival) + " is " + ended(travel.outcome, travel.exit_rad) +
                            " in place of " + ended(before.outcome, before.exit_orientation_rad);
      continue;
    }
    if (delivered(before) && design.has_voids)
      result.least_margin_mm = std::min(result.least_margin_mm, travel.margin_mm);
  }
  return result;
}

}  // namespace

std::string TestedDesign::pose_name(const PoseTravel& arrival) const {
  std::ostringstream out;
  out << (belt ? "start " : "pose ") << arrival.result.aspect << " " << std::fixed << std::setprecision(2)
      << arrival.result.orientation_rad * 360 / kTurn << " deg";
  return out.str();
}

TestedDesign tested_design(const FeederProblem& problem, const Evaluated& stored) {
  const FeederSpec& spec = problem.spec();
  const int topology = stored.candidate.topology;
  std::vector<double> values = all_values(problem, stored.candidate);
  PartModel part = part_model(spec.part, spec.environment, values);
  Layout layout = lay_out(spec.designs[static_cast<std::size_t>(topology)], spec.environment, spec.manufacture,
                          part.diameter_mm, values);
  Layout plain = plain_layout(layout);
  FeederEvaluation evaluation = problem.evaluate(topology, values);
  const double claimed = claimed_tolerance(problem, stored, evaluation);
  TestedDesign design{problem,           stored,           std::move(values),    std::move(part),
                      std::move(layout), std::move(plain), std::move(evaluation)};
  design.turns = has_obstacles(design.layout);
  design.belt = design.turns && is_belt(spec.environment);
  design.has_voids = std::any_of(design.layout.features.begin(), design.layout.features.end(),
                                 [](const LaidFeature& f) { return !f.voids.empty(); });
  design.arrivals = design.turns ? travel_all_turning(design.part, design.layout, spec.environment, false).arrivals
                                 : travel_all(design.part, design.layout, spec.environment, false);
  design.claimed_mm = claimed;
  return design;
}

Layout plain_layout(const Layout& layout) {
  Layout plain;
  plain.length_mm = layout.length_mm;
  for (VoidGroup& group : grouped(layout, 0)) {
    LaidFeature feature;
    feature.type = "cutout";
    set_voids(feature, std::move(group.loops));
    plain.features.push_back(std::move(feature));
  }
  for (const LaidFeature& laid : layout.features) {
    if (laid.obstacles.empty() && laid.wall_cuts.empty() && !laid.blade_mm) continue;
    LaidFeature feature = laid;
    feature.voids.clear();
    feature.own_voids.clear();
    plain.features.push_back(std::move(feature));
  }
  return plain;
}

void set_voids(LaidFeature& feature, std::vector<Loop> voids) {
  Box box;
  for (const Loop& loop : voids) {
    for (const Point& p : loop) box.include(p);
  }
  feature.x_min = box.min.x();
  feature.x_max = box.max.x();
  feature.start_mm = 0;
  feature.end_mm = feature.x_max;
  feature.own_voids = voids;
  feature.voids = std::move(voids);
}

std::optional<DesignSpec> literal_features(const Layout& plain) {
  DesignSpec design;
  const auto add = [&design](auto shape, double at_mm) {
    FeatureSpec feature;
    feature.shape = std::move(shape);
    feature.at_mm = Affine{at_mm, {}};
    design.push_back(std::move(feature));
  };
  for (const LaidFeature& feature : plain.features) {
    for (const Loop& loop : feature.voids) {
      if (signed_area(loop) < 0) return std::nullopt;
      add(Cutout{literal_loop(loop)}, 0);
    }
    if (!feature.wall_face_mm.empty()) {
      add(WallProfile{literal_loop(feature.wall_face_mm)}, 0);
    } else {
      for (const ObstacleShape& obstacle : feature.obstacles) {
        const Loop& loop = obstacle.area.outer;
        if (obstacle.radius_mm > 0) {
          add(Pin{Affine{loop.front().x(), {}}, Affine{loop.front().y(), {}}, Affine{2 * obstacle.radius_mm, {}}}, 0);
        } else {
          add(Fence{literal_loop(loop)}, 0);
        }
      }
    }
    if (!feature.blade_mm) continue;
    const Affine height{*feature.blade_mm, {}};
    if (feature.holds_down) {
      add(HoldDown{height, Affine{feature.end_mm - feature.start_mm, {}}}, feature.start_mm);
    } else {
      add(Wiper{height}, feature.start_mm);
    }
  }
  return design;
}

Comparison compare_ends(const TestedDesign& design, const Layout& other, const CompareOptions& options) {
  return design.turns ? compare_turning(design, other, options) : compare_passive(design, other, options);
}

}  // namespace formotion
