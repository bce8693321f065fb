#include "applications/feeder/judge.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <numbers>
#include <sstream>

#include "applications/feeder/pose_travel.hpp"
#include "applications/feeder/tolerance.hpp"
#include "applications/feeder/turning.hpp"
#include "applications/feeder/turning_sets.hpp"

namespace formotion::feeder {
namespace {

constexpr double kSamePose_rad = 1e-6 * std::numbers::pi / 180;

std::string degrees(double rad) {
  std::ostringstream out;
  out << std::fixed << std::setprecision(2) << rad * 180 / std::numbers::pi;
  return out.str();
}

std::string pose_name(const PartModel& part, const StablePose& pose) {
  return part.shapes[pose.aspect].name + " " + degrees(pose.orientation_rad) + " deg";
}

bool named_by_goal(const Goal& goal, const PartModel& part, int aspect, double orientation_rad, double within_rad) {
  const double period = 2 * std::numbers::pi / part.symmetry[aspect];
  return (goal.aspect == "any" || goal.aspect == part.shapes[aspect].name) &&
         std::abs(std::remainder(orientation_rad - goal.orientation_rad, period)) <= within_rad;
}

bool named_by_goal(const Goal& goal, const PartModel& part, const StablePose& pose) {
  return named_by_goal(goal, part, pose.aspect, pose.orientation_rad, kSamePose_rad);
}

std::string arrival_name(const PartModel& part, const TurningEvaluation& travels, std::size_t i, bool on_belt) {
  if (!on_belt) return "pose " + pose_name(part, part.poses[i].stable);
  const MapInterval& interval = travels.map[i];
  return "starts " + interval.aspect + " " + degrees(interval.from_rad) + " to " + degrees(interval.to_rad) + " deg";
}

// The intervals that forward projection covers, if there are some and nothing else is uncertain.
std::optional<std::map<std::string, std::pair<double, double>>> projected_intervals(const Uncertainty& uncertainty) {
  if (uncertainty.outline_mm > 0 || uncertainty.com_mm > 0 || uncertainty.feature_mm > 0) return std::nullopt;
  for (const auto& [name, interval] : uncertainty.intervals) {
    if (name != "wall_friction" && name != "drive_deg") return std::nullopt;
  }
  if (uncertainty.intervals.empty()) return std::nullopt;
  return uncertainty.intervals;
}

}  // namespace

std::vector<Violation> defects_of(const PartModel& part) {
  std::vector<Violation> violations;
  for (const AspectShape& shape : part.shapes) {
    for (const Polygon& body : shape.bodies) {
      if (const auto found = defect(body)) {
        violations.push_back({"part, aspect " + shape.name + ": " + *found, "part", 1});
      }
    }
  }
  return violations;
}

// One design, judged. Details (unsupported travel, sentences) cost more than the score needs.
Judged judge(const DesignCase& design, bool in_detail) {
  const FeederSpec& spec = design.spec;
  const PartModel& model = design.part;
  Judged judged;
  FeederEvaluation& result = judged.evaluation;
  const Layout layout = lay_out(design.features, spec.environment, spec.manufacture, model.diameter_mm, design.values);
  result.metrics.length_mm = layout.length_mm;
  result.metrics.feature_count = static_cast<int>(layout.features.size());
  result.violations = layout.invalid;
  result.violations.insert(result.violations.end(), design.part_defects.begin(), design.part_defects.end());
  if (spec.manufacture.min_web_mm)
    check_webs(layout, *spec.manufacture.min_web_mm, spec.environment.track_width_mm, result.violations);

  const bool detail = in_detail || spec.goal.require_tip;
  const bool turns = has_obstacles(layout);
  TurningEvaluation travels;
  if (turns) {
    travels = travel_all_turning(model, layout, spec.environment, detail);
    judged.work = travels.projections;
    result.outcome_map = travels.map;
  } else {
    travels.poses = travel_all(model, layout, spec.environment, detail);
    travels.arrivals = travels.poses;
    judged.work =
        static_cast<std::int64_t>(travels.poses.size()) * std::max<std::int64_t>(1, result.metrics.feature_count);
  }
  for (const PoseTravel& travel : travels.poses) result.poses.push_back(travel.result);
  const std::vector<PoseTravel>& arrivals = travels.arrivals;

  // The goal: named poses, or the one that is delivered most. The cost of a goal is what keeps it from being met, in
  // mm.
  const std::size_t count = model.poses.size();
  const bool on_belt = turns && is_belt(spec.environment);
  std::vector<bool> is_goal(count, false);
  int most_class = -1;
  if (spec.goal.one_pose) {
    std::map<int, double> leaving;
    double most = 0;
    for (const PoseTravel& arrival : arrivals) {
      if (arrival.exit_class < 0) continue;
      double& probability = leaving[arrival.exit_class];
      probability += arrival.result.prior;
      if (probability <= most) continue;
      most = probability;
      most_class = arrival.exit_class;
      result.goal_pose = arrival.exit_pose;
    }
    if (result.goal_pose >= 0) is_goal[result.goal_pose] = true;
  } else {
    for (std::size_t i = 0; i < count; ++i) {
      is_goal[i] = named_by_goal(spec.goal, model, model.poses[i].stable);
      if (is_goal[i] && result.goal_pose < 0) result.goal_pose = static_cast<int>(i);
    }
  }
  const auto serves = [&](const PoseTravel& arrival) {
    if (spec.goal.one_pose) return arrival.exit_class >= 0 && arrival.exit_class == most_class;
    if (!on_belt) return arrival.exit_pose >= 0 && is_goal[arrival.exit_pose];
    return arrival.exit_class >= 0 &&
           named_by_goal(spec.goal, model, arrival.aspect, *arrival.result.exit_orientation_rad, spec.goal.within_rad);
  };

  Metrics& metrics = result.metrics;
  double delivered_prior = 0, pitch = 0, arriving = 0;
  for (const PoseTravel& arrival : arrivals) {
    const PoseResult& pose = arrival.result;
    arriving += pose.prior;
    pitch += pose.prior * arrival.extent_mm;
    if (pose.outcome == Outcome::Delivered) {
      delivered_prior += pose.prior;
      if (serves(arrival)) metrics.efficiency += pose.prior;
    } else if (pose.outcome == Outcome::Jammed) {
      metrics.jam_probability += pose.prior;
    }
    if (pose.margin_mm) metrics.margin_mm = std::min(metrics.margin_mm.value_or(*pose.margin_mm), *pose.margin_mm);
  }
  if (delivered_prior > 0) metrics.purity = metrics.efficiency / delivered_prior;
  if (pitch > 0)
    metrics.feed_rate_per_min = 60 * spec.environment.conveying_speed_mm_s * metrics.efficiency * arriving / pitch;

  // What is wrong, in words and in mm; the sum falls as a design comes nearer to a feasible one. Where parts turn, mm
  // say nothing of how near that is: the probability of what ends wrong does.
  double lost_goal = -1;  // how deep the least lost goal pose is lost
  for (std::size_t i = 0; i < arrivals.size(); ++i) {
    const PoseTravel& arrival = arrivals[i];
    const PoseResult& pose = arrival.result;
    const bool delivered = pose.outcome == Outcome::Delivered;
    const double by = turns ? std::max(1e-6, pose.prior) : std::max(1e-6, std::abs(arrival.nominal_mm));
    const auto violate = [&](const char* what, double amount) {  // words cost more than the score
      const std::string where = !in_detail ? std::string() : arrival_name(model, travels, i, on_belt);
      result.violations.push_back({in_detail ? what : "", where, amount});
    };
    if (delivered && !serves(arrival)) violate("a wrong pose is delivered", by);
    if (!delivered && (turns || spec.goal.one_pose || is_goal[i]))
      lost_goal = lost_goal < 0 ? by : std::min(lost_goal, by);
    if (pose.outcome == Outcome::Jammed) violate("a pose jams", turns ? by : std::max(1e-3, arrival.lacking_mm));
    if (pose.outcome == Outcome::Ambiguous) violate("a pose has several consistent ends", by);
    if (pose.outcome == Outcome::Undecided) violate("a pose is undecided", 1);
    if (spec.goal.require_tip && !delivered && pose.unsupported_mm && pose.tip_mm &&
        *pose.unsupported_mm < *pose.tip_mm) {
      violate("a lost pose has no time to tip", *pose.tip_mm - *pose.unsupported_mm);
    }
  }
  if (metrics.efficiency <= 0)
    result.violations.push_back({"the goal pose is not delivered", "goal", turns ? 1 : std::max(lost_goal, 1e-6)});
  for (const Violation& violation : result.violations) judged.violation += violation.by;
  if (count == 0) result.violations.push_back({"the part rests in no pose on the wall", "part", 1});
  result.feasible = result.violations.empty();
  if (in_detail && turns) {
    if (const auto box = projected_intervals(spec.uncertainty)) {
      const SetEvaluation sets = arrivals_over_sets(model, layout, spec.environment, *box, travels);
      judged.work += sets.projections;
      Metrics worst = metrics;
      worst.efficiency = worst.jam_probability = 0;
      double leaves = 0;
      for (std::size_t i = 0; i < arrivals.size(); ++i) {
        const double prior = arrivals[i].result.prior;
        if (sets.arrivals[i] == Outcome::Delivered) {
          leaves += prior;
          if (serves(arrivals[i])) worst.efficiency += prior;
        } else if (sets.arrivals[i] == Outcome::Jammed || sets.arrivals[i] == Outcome::Ambiguous) {
          worst.jam_probability += prior;
        }
      }
      worst.purity = leaves > 0 ? std::optional<double>(worst.efficiency / leaves) : std::nullopt;
      worst.tolerance_mm = worst.margin_mm = std::nullopt;
      worst.feed_rate_per_min =
          metrics.efficiency > 0 && metrics.feed_rate_per_min
              ? std::optional<double>(*metrics.feed_rate_per_min * worst.efficiency / metrics.efficiency)
              : std::nullopt;
      result.worst_case = worst;
      result.bites = sets.bites;
    }
  }
  if (in_detail) collect_warnings(travels.poses, layout, spec.environment, result.warnings);

  // Invalid shapes have no tolerance; for the score's sake infeasible designs need none.
  const bool wanted = in_detail || std::any_of(spec.objectives.begin(), spec.objectives.end(),
                                               [](const Objective& o) { return o.name == "tolerance_mm"; });
  if (!wanted || count == 0 || !layout.invalid.empty() || !(in_detail || result.feasible)) return judged;
  if (turns) {
    const TurningTolerance found = turning_tolerance(model, layout, spec.environment, travels);
    metrics.tolerance_mm = found.tolerance_mm;
    judged.work += found.projections;
  } else {
    std::vector<bool> delivered(count);
    std::vector<double> nominal(count);
    for (std::size_t i = 0; i < count; ++i) {
      delivered[i] = arrivals[i].result.outcome == Outcome::Delivered;
      nominal[i] = arrivals[i].nominal_mm;
    }
    const ToleranceResult found = tolerance(model, layout, delivered, nominal);
    metrics.tolerance_mm = found.tolerance_mm;
    judged.work += found.sweeps;
  }
  return judged;
}

std::optional<std::string> goal_defect(const FeederSpec& spec) {
  if (spec.goal.one_pose || !is_literal(spec.part)) return std::nullopt;
  const PartModel part = part_model(spec.part, spec.environment, {});
  std::string list;
  for (const PoseModel& pose : part.poses) {
    if (named_by_goal(spec.goal, part, pose.stable)) return std::nullopt;
    list += (list.empty() ? "" : ", ") + pose_name(part, pose.stable);
  }
  return "one of the stable poses: " + (list.empty() ? "there are none" : list);
}

}  // namespace formotion::feeder
