#include "applications/feeder/judge.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <numbers>
#include <sstream>

#include "applications/feeder/inverse_goals.hpp"
#include "applications/feeder/pose_travel.hpp"
#include "applications/feeder/tolerance.hpp"
#include "applications/feeder/turning.hpp"
#include "applications/feeder/uncertainty.hpp"

namespace formotion::feeder {
namespace {

constexpr double kSamePose_rad = 1e-6 * std::numbers::pi / 180;

std::string degrees(double rad) {
  std::ostringstream out;
  out << std::fixed << std::setprecision(2) << rad * 180 / std::numbers::pi;
  return out.str();
}

bool named_by_goal(const Goal& goal, const PartModel& part, int aspect, double orientation_rad, double within_rad) {
  const double period = 2 * std::numbers::pi / part.symmetry[aspect];
  return (goal.aspect == "any" || goal.aspect == part.shapes[aspect].name) &&
         std::abs(std::remainder(orientation_rad - goal.orientation_rad, period)) <= within_rad;
}

}  // namespace

std::string pose_name(const PartModel& part, const StablePose& pose) {
  return part.shapes[pose.aspect].name + " " + degrees(pose.orientation_rad) + " deg";
}

std::string arrival_name(const PartModel& part, const TurningEvaluation& travels, std::size_t i, bool on_belt) {
  if (!on_belt) return "pose " + pose_name(part, part.poses[i].stable);
  const MapInterval& interval = travels.map[i];
  return "starts " + interval.aspect + " " + degrees(interval.from_rad) + " to " + degrees(interval.to_rad) + " deg";
}

bool named_by_goal(const Goal& goal, const PartModel& part, const StablePose& pose) {
  return named_by_goal(goal, part, pose.aspect, pose.orientation_rad, kSamePose_rad);
}

double objective(const Metrics& metrics, const std::string& name) {
  if (name == "efficiency") return metrics.efficiency;
  if (name == "tolerance_mm") return metrics.tolerance_mm.value_or(0);
  if (name == "margin_mm") return metrics.margin_mm.value_or(0);
  if (name == "feed_rate_per_min") return metrics.feed_rate_per_min.value_or(0);
  if (name == "length_mm") return metrics.length_mm;
  if (name == "feature_count") return metrics.feature_count;
  throw std::logic_error("feeder has no objective " + name);
}

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
Judged judge(const DesignCase& design, bool in_detail, Passages& passages) {
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
  result.goals = goal_answers(design, layout);
  const std::vector<Violation> unmet = violations_of(result.goals);
  result.violations.insert(result.violations.end(), unmet.begin(), unmet.end());

  const bool detail = in_detail || spec.goal.require_tip;
  const bool turns = has_obstacles(layout);
  TurningEvaluation travels;
  if (turns) {
    travels = travel_all_turning(model, layout, spec.environment, detail);
    judged.work = travels.projections;
    result.outcome_map = travels.map;
  } else {
    const std::int64_t before = passages.sweeps;
    travels.poses = travel_all(model, layout, spec.environment, detail, passages);
    travels.arrivals = travels.poses;
    judged.work = passages.sweeps - before;
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
  const bool tolerance_wanted = in_detail || std::any_of(spec.objectives.begin(), spec.objectives.end(),
                                                         [](const Objective& o) { return o.name == "tolerance_mm"; });
  if (design.spreads && count > 0) {
    std::vector<bool> wanted(arrivals.size());
    for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] = turns ? serves(arrivals[i]) : is_goal[i];
    const JudgedCase as_drawn{design, layout, travels, metrics, std::move(wanted), turns};
    if (spec.robust && !result.feasible) judged.violation += robust_shortfall(as_drawn, design.spreads->all);
    if (in_detail || result.feasible) {
      const WorstCase worst = worst_case(as_drawn, *design.spreads, {in_detail, tolerance_wanted});
      judged.work += worst.work;
      result.worst_case = worst.metrics;
      result.bites = worst.bites;
      result.robust = result.feasible && worst.lacking == 0;
      if (spec.robust && result.feasible) {
        judged.violation = worst.lacking;
        result.violations = worst.violations;
        result.feasible = result.robust;
      }
    }
  }
  if (in_detail) collect_warnings(travels.poses, layout, spec.environment, result.warnings);

  // Invalid shapes have no tolerance; for the score's sake infeasible designs, and those that are scored at their worst
  // case, need none.
  if (!tolerance_wanted || count == 0 || !layout.invalid.empty()) return judged;
  if (!in_detail && (!result.feasible || (spec.robust && design.spreads))) return judged;
  if (turns) {
    const TurningTolerance found = turning_tolerance(model, layout, spec.environment, travels);
    metrics.tolerance_mm = found.tolerance_mm;
    judged.work += found.projections;
  } else {
    std::vector<PoseDemand> demands;
    for (const PoseTravel& arrival : arrivals)
      demands.push_back({true, arrival.result.outcome == Outcome::Delivered, arrival.nominal_mm});
    const std::int64_t before = passages.sweeps;
    metrics.tolerance_mm = tolerance(model, layout, demands, passages);
    judged.work += passages.sweeps - before;
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
