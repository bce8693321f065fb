#include "applications/feeder/stages.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>

#include "applications/feeder/carved.hpp"
#include "applications/feeder/judge.hpp"
#include "applications/feeder/pose_travel.hpp"
#include "applications/feeder/tolerance.hpp"
#include "applications/feeder/turning.hpp"

namespace formotion::feeder {
namespace {

constexpr std::size_t kMostStarts = 64;
constexpr int kMostAlike = 6;

StageEnd stage_end(const PoseTravel& travel, bool must_tip) {
  const PoseResult& pose = travel.result;
  StageEnd end;
  end.nominal_mm = travel.nominal_mm;
  switch (pose.outcome) {
    case Outcome::Delivered:
      end.to = travel.exit_pose >= 0 ? travel.exit_pose : kStuckState;
      break;
    case Outcome::Rejected:
      end.to = kLostState;
      break;
    case Outcome::Jammed:
      end.lacking_mm = std::max(1e-3, travel.lacking_mm);
      break;
    case Outcome::Ambiguous:
    case Outcome::Undecided:
      end.lacking_mm = 1;
      break;
  }
  if (must_tip && end.to == kLostState && pose.unsupported_mm && pose.tip_mm && *pose.unsupported_mm < *pose.tip_mm) {
    end.to = kStuckState;
    end.lacking_mm = *pose.tip_mm - *pose.unsupported_mm;
  }
  return end;
}

}  // namespace

std::unique_ptr<FeederStages> FeederStages::of(const FeederSpec& spec, const PartModel& part) {
  if (!spec.goal.configurations.empty() || !spec.goal.facets.empty()) return nullptr;
  StageCatalogue catalogue = stage_catalogue(spec, part);
  if (catalogue.kinds.empty() || part.poses.empty()) return nullptr;
  return std::unique_ptr<FeederStages>(new FeederStages(spec, part, std::move(catalogue)));
}

FeederStages::FeederStages(const FeederSpec& spec, const PartModel& part, StageCatalogue catalogue)
    : spec_(spec), part_(part), catalogue_(std::move(catalogue)) {
  for (const FeatureKind& kind : catalogue_.kinds) kinds_.push_back(kind.stage);
  if (!spec.goal.one_pose) goals_.emplace_back();
  for (std::size_t i = 0; i < part.poses.size(); ++i) {
    const StablePose& pose = part.poses[i].stable;
    states_.push_back({pose_name(part, pose), pose.prior});
    if (spec.goal.one_pose) goals_.push_back({static_cast<int>(i)});
    if (!spec.goal.one_pose && named_by_goal(spec.goal, part, pose)) goals_.front().push_back(static_cast<int>(i));
  }
}

Layout FeederStages::alone(int kind, std::span<const double> values) const {
  return lay_out({catalogue_.kinds[kind].feature}, spec_.environment, spec_.manufacture, part_.diameter_mm, values);
}

std::vector<std::vector<double>> FeederStages::starts(int kind) const {
  std::vector<int> wanted;
  for (const std::vector<int>& goal : goals_) wanted.insert(wanted.end(), goal.begin(), goal.end());
  const FeatureKind& of = catalogue_.kinds[kind];
  // Of the guesses those that keep what is wanted and lose something, not too many that do the same.
  std::vector<std::vector<double>> starts;
  std::map<std::vector<int>, int> alike;
  for (std::vector<double>& values : carved_values(of.feature, of.stage.variables, part_, spec_.environment, wanted)) {
    const StageResult result = pass(kind, values);
    std::vector<int> ends;
    for (const StageEnd& end : result.ends) ends.push_back(end.to);
    const bool keeps = std::any_of(wanted.begin(), wanted.end(), [&](int state) { return ends[state] >= 0; });
    const bool loses = std::find(ends.begin(), ends.end(), kLostState) != ends.end();
    if (!result.valid || !keeps || !loses || ++alike[ends] > kMostAlike) continue;
    starts.push_back(std::move(values));
    if (starts.size() == kMostStarts) break;
  }
  return starts;
}

StageResult FeederStages::pass(int kind, std::span<const double> values) const {
  const Layout layout = alone(kind, values);
  StageResult result;
  result.length_mm = layout.length_mm;
  std::vector<Violation> violations = layout.invalid;
  if (spec_.manufacture.min_web_mm)
    check_webs(layout, *spec_.manufacture.min_web_mm, spec_.environment.track_width_mm, violations);
  for (const Violation& violation : violations) result.violation += violation.by;
  result.valid = violations.empty();
  result.ends.resize(states_.size());
  if (!result.valid) return result;

  if (kinds_[kind].passive) {
    Passages passages(part_);
    const bool must_tip = spec_.goal.require_tip;
    const std::vector<PoseTravel> travels = travel_all(part_, layout, spec_.environment, must_tip, passages);
    for (std::size_t i = 0; i < travels.size(); ++i) result.ends[i] = stage_end(travels[i], must_tip);
    result.work = passages.sweeps;
    return result;
  }
  const TurningEvaluation travels = travel_all_turning(part_, layout, spec_.environment, false);
  const bool voids = !layout.features.front().voids.empty();
  for (std::size_t i = 0; i < states_.size(); ++i) {
    result.ends[i] = stage_end(travels.poses[i], false);
    double& nominal = result.ends[i].nominal_mm;
    const bool margin_counts = voids && result.ends[i].to >= 0;
    nominal = margin_counts ? std::clamp(nominal, 0.0, kMostTurningTolerance_mm) : kMostTurningTolerance_mm;
  }
  result.work = travels.projections;
  return result;
}

StageTolerance FeederStages::tolerance(int kind, std::span<const double> values, const StageResult& result,
                                       const StageDemand& demanded, double at_most_mm) const {
  const Layout layout = alone(kind, values);
  if (!kinds_[kind].passive) {
    const TurningEvaluation travels = travel_all_turning(part_, layout, spec_.environment, false);
    const TurningTolerance found = turning_tolerance(part_, layout, spec_.environment, travels, demanded);
    return {std::min(found.tolerance_mm, at_most_mm), travels.projections + found.projections};
  }
  std::vector<PoseDemand> demands;
  for (std::size_t i = 0; i < states_.size(); ++i)
    demands.push_back({demanded[i], result.ends[i].to >= 0, result.ends[i].nominal_mm});
  Passages passages(part_);
  const double found = feeder::tolerance(part_, layout, demands, passages, at_most_mm);
  return {found, passages.sweeps};
}

std::optional<std::size_t> FeederStages::tolerance_objective() const {
  for (std::size_t k = 0; k < spec_.objectives.size(); ++k) {
    if (spec_.objectives[k].name == "tolerance_mm") return k;
  }
  return std::nullopt;
}

std::vector<double> FeederStages::objectives(const Composition& composition) const {
  std::map<int, double> leaving;
  double pitch = 0, arriving = 0;
  for (std::size_t i = 0; i < states_.size(); ++i) {
    const PoseModel& pose = part_.poses[i];
    arriving += states_[i].prior;
    pitch += states_[i].prior * (pose.x_max - pose.x_min);
    if (composition.ends[i] >= 0) leaving[composition.ends[i]] += states_[i].prior;
  }
  Metrics metrics;
  for (const std::vector<int>& goal : goals_) {
    double served = 0;
    for (const int state : goal) served += leaving.contains(state) ? leaving[state] : 0;
    metrics.efficiency = std::max(metrics.efficiency, served);
  }
  metrics.tolerance_mm = metrics.margin_mm = composition.tolerance_mm;
  metrics.feature_count = static_cast<int>(stages(composition.topology).size());
  const double spacing = spec_.environment.spacing_mm.value_or(part_.diameter_mm);
  metrics.length_mm = composition.length_mm + spacing * std::max(0, metrics.feature_count - 1);
  if (pitch > 0)
    metrics.feed_rate_per_min = 60 * spec_.environment.conveying_speed_mm_s * metrics.efficiency * arriving / pitch;
  std::vector<double> values;
  for (const Objective& o : spec_.objectives) values.push_back(objective(metrics, o.name));
  return values;
}

std::optional<double> FeederStages::displacement_mm(int kind, std::span<const double> half_widths) const {
  return feeder::displacement_mm(catalogue_.kinds[kind].feature, spec_.manufacture, half_widths);
}

bool FeederStages::bears(int kind, std::span<const double> values, int state, bool kept, double error_mm,
                         std::int64_t& work) const {
  if (!kinds_[kind].passive) throw std::logic_error("stages that turn parts bear no single error");
  const Layout layout = alone(kind, values);
  if (error_mm <= 0 || !layout.invalid.empty()) return true;
  const PoseModel& pose = part_.poses[state];
  const double standing = std::min(pose.travelling.plain_margin_mm, blade_clearance(pose, layout));
  if (kept && standing < error_mm) return false;
  if (!kept && error_mm > part_.diameter_mm) return false;
  if (!kept && -standing >= error_mm) return true;
  for (const VoidGroup& group : grouped_in_own_frames(layout, part_.longest_mm)) {
    const std::vector<Interval> held = held_from(group.origin_mm, part_, layout)[state];
    if (bears_error({pose, group.loops, held}, kept, error_mm, work) != kept) return !kept;
  }
  return kept;
}

}  // namespace formotion::feeder
