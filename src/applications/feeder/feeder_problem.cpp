#include "applications/feeder/feeder_problem.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "analysis/constraints/planar_support.hpp"
#include "analysis/geometry/boolean.hpp"
#include "applications/feeder/pose_travel.hpp"
#include "applications/feeder/turning.hpp"
#include "applications/feeder/turning_sets.hpp"
#include "applications/feeder/world.hpp"

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

std::vector<double> starting_values(const std::vector<Variable>& variables) {
  std::vector<double> values;
  for (const Variable& variable : variables) values.push_back(variable.start());
  return values;
}

void collect(const Affine& expression, std::vector<int>& used) {
  for (const auto& [index, coefficient] : expression.terms) {
    if (coefficient != 0) used.push_back(index);
  }
}
void collect(const AffineLoop& loop, std::vector<int>& used) {
  for (const AffinePoint& p : loop) {
    collect(p[0], used);
    collect(p[1], used);
  }
}

// Calls visit on every expression of a feature.
struct Expressions {
  template <class Visit>
  static void each(FeatureSpec& f, const Visit& visit) {
    if (f.at_mm) visit(*f.at_mm);
    std::visit([&](auto& shape) { of(shape, visit); }, f.shape);
  }
  template <class V>
  static void of(Balcony& s, const V& v) {
    v(s.width_mm);
    v(s.length_mm);
  }
  template <class V>
  static void of(Gap& s, const V& v) {
    v(s.length_mm);
  }
  template <class V>
  static void of(Canyon& s, const V& v) {
    v(s.from_mm);
    v(s.to_mm);
    v(s.length_mm);
  }
  template <class V>
  static void of(Slot& s, const V& v) {
    v(s.from_mm);
    v(s.to_mm);
    v(s.length_mm);
  }
  template <class V>
  static void of(Cutout& s, const V& v) {
    loop(s.polygon_mm, v);
  }
  template <class V>
  static void of(DishOut& s, const V& v) {
    v(s.depth_mm);
    v(s.length_mm);
  }
  template <class V>
  static void of(Scallop& s, const V& v) {
    v(s.depth_mm);
    v(s.half_angle_rad);
  }
  template <class V>
  static void of(Drawing&, const V&) {}
  template <class V>
  static void of(Wiper& s, const V& v) {
    v(s.height_mm);
  }
  template <class V>
  static void of(HoldDown& s, const V& v) {
    v(s.height_mm);
    v(s.length_mm);
  }
  template <class V>
  static void of(Fence& s, const V& v) {
    loop(s.polygon_mm, v);
  }
  template <class V>
  static void of(WallProfile& s, const V& v) {
    loop(s.profile_mm, v);
  }
  template <class V>
  static void of(Pin& s, const V& v) {
    v(s.x_mm);
    v(s.y_mm);
    v(s.diameter_mm);
  }
  template <class V>
  static void loop(AffineLoop& points, const V& v) {
    for (AffinePoint& p : points) {
      v(p[0]);
      v(p[1]);
    }
  }
};

std::vector<Topology> topologies_of(const FeederSpec& spec) {
  std::vector<int> of_part;
  for (const AspectSpec& aspect : spec.part.aspects) {
    collect(aspect.outline_mm, of_part);
    for (const AffineLoop& hole : aspect.holes_mm) collect(hole, of_part);
    for (const LayerSpec& layer : aspect.layers) {
      collect(layer.outline_mm, of_part);
      for (const AffineLoop& hole : layer.holes_mm) collect(hole, of_part);
    }
  }
  std::vector<Topology> topologies;
  for (DesignSpec design : spec.designs) {
    Topology topology;
    topology.variables = of_part;
    for (FeatureSpec& feature : design) {
      Expressions::each(feature, [&](Affine& expression) { collect(expression, topology.variables); });
      topology.label += (topology.label.empty() ? "" : " + ") + type_name(feature);
    }
    std::sort(topology.variables.begin(), topology.variables.end());
    topology.variables.erase(std::unique(topology.variables.begin(), topology.variables.end()),
                             topology.variables.end());
    topologies.push_back(std::move(topology));
  }
  return topologies;
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

double objective(const Metrics& metrics, const std::string& name) {
  if (name == "efficiency") return metrics.efficiency;
  if (name == "tolerance_mm") return metrics.tolerance_mm.value_or(0);
  if (name == "margin_mm") return metrics.margin_mm.value_or(0);
  if (name == "feed_rate_per_min") return metrics.feed_rate_per_min.value_or(0);
  if (name == "length_mm") return metrics.length_mm;
  if (name == "feature_count") return metrics.feature_count;
  throw std::logic_error("feeder has no objective " + name);
}

// A literal feature's numbers with the contract's names, angles in degrees.
struct Dimensions {
  using List = std::vector<std::pair<std::string, double>>;
  static double v(const Affine& a) { return a({}); }
  List operator()(const Balcony& f) const { return {{"width_mm", v(f.width_mm)}, {"length_mm", v(f.length_mm)}}; }
  List operator()(const Gap& f) const { return {{"length_mm", v(f.length_mm)}}; }
  List operator()(const Canyon& f) const { return band(f); }
  List operator()(const Slot& f) const { return band(f); }
  List operator()(const Cutout& f) const { return corners(f.polygon_mm); }
  List operator()(const DishOut& f) const { return {{"depth_mm", v(f.depth_mm)}, {"length_mm", v(f.length_mm)}}; }
  List operator()(const Scallop& f) const {
    return {{"depth_mm", v(f.depth_mm)}, {"half_angle_deg", v(f.half_angle_rad) * 180 / std::numbers::pi}};
  }
  List operator()(const Drawing&) const { return {}; }
  List operator()(const Wiper& f) const { return {{"height_mm", v(f.height_mm)}}; }
  List operator()(const HoldDown& f) const { return {{"height_mm", v(f.height_mm)}, {"length_mm", v(f.length_mm)}}; }
  List operator()(const Fence& f) const { return corners(f.polygon_mm); }
  List operator()(const WallProfile& f) const { return corners(f.profile_mm); }
  List operator()(const Pin& f) const {
    return {{"x_mm", v(f.x_mm)}, {"y_mm", v(f.y_mm)}, {"diameter_mm", v(f.diameter_mm)}};
  }
  static List corners(const AffineLoop& loop) {
    List list;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      list.emplace_back("x" + std::to_string(i) + "_mm", v(loop[i][0]));
      list.emplace_back("y" + std::to_string(i) + "_mm", v(loop[i][1]));
    }
    return list;
  }
  template <class Band>
  static List band(const Band& f) {
    return {{"from_mm", v(f.from_mm)}, {"to_mm", v(f.to_mm)}, {"length_mm", v(f.length_mm)}};
  }
};

}  // namespace

const char* name(Outcome outcome) {
  switch (outcome) {
    case Outcome::Delivered:
      return "delivered";
    case Outcome::Rejected:
      return "rejected";
    case Outcome::Jammed:
      return "jammed";
    case Outcome::Ambiguous:
      return "ambiguous";
    case Outcome::Undecided:
      return "undecided";
  }
  return "undecided";
}

struct FeederProblem::Model {
  FeederSpec spec;
  std::vector<Topology> topologies;
  std::optional<PartModel> part;  // of a part whose shape does not depend on variables
  std::vector<Violation> part_defects;

  struct Judged {
    FeederEvaluation evaluation;
    double violation = 0;
    std::int64_t work = 0;
  };
  template <class Use>
  auto with_part(std::span<const double> values, const Use& use) const {
    return part ? use(*part) : use(part_model(spec.part, spec.environment, values));
  }
  Judged judge(int topology, std::span<const double> values, bool in_detail) const;
};

// One design, judged. Details (unsupported travel, sentences) cost more than the score needs.
FeederProblem::Model::Judged FeederProblem::Model::judge(int topology, std::span<const double> values,
                                                         bool in_detail) const {
  return with_part(values, [&](const PartModel& model) {
    Judged judged;
    FeederEvaluation& result = judged.evaluation;
    const Layout layout =
        lay_out(spec.designs[topology], spec.environment, spec.manufacture, model.diameter_mm, values);
    result.metrics.length_mm = layout.length_mm;
    result.metrics.feature_count = static_cast<int>(layout.features.size());
    result.violations = layout.invalid;
    const std::vector<Violation> defects = part ? part_defects : defects_of(model);
    result.violations.insert(result.violations.end(), defects.begin(), defects.end());
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
      return arrival.exit_class >= 0 && named_by_goal(spec.goal, model, arrival.aspect,
                                                      *arrival.result.exit_orientation_rad, spec.goal.within_rad);
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
  });
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

FeederProblem::FeederProblem(FeederSpec spec) : model_(std::make_unique<Model>()) {
  model_->topologies = topologies_of(spec);
  if (is_literal(spec.part)) {
    model_->part = part_model(spec.part, spec.environment, {});
    model_->part_defects = defects_of(*model_->part);
  }
  model_->spec = std::move(spec);
}
FeederProblem::~FeederProblem() = default;

std::span<const Variable> FeederProblem::variables() const { return model_->spec.variables; }
std::span<const Topology> FeederProblem::topologies() const { return model_->topologies; }
std::span<const Objective> FeederProblem::objectives() const { return model_->spec.objectives; }
const FeederSpec& FeederProblem::spec() const { return model_->spec; }

std::vector<double> FeederProblem::all_values(const Candidate& candidate) const {
  std::vector<double> values = starting_values(model_->spec.variables);
  const std::vector<int>& used = model_->topologies[candidate.topology].variables;
  for (std::size_t i = 0; i < used.size(); ++i) values[used[i]] = candidate.values[i];
  return values;
}

Score FeederProblem::score(const Candidate& candidate) const {
  const Model::Judged judged = model_->judge(candidate.topology, all_values(candidate), false);
  Score score;
  score.feasible = judged.evaluation.feasible;
  score.violation = judged.violation;
  score.work = judged.work;
  for (const Objective& o : model_->spec.objectives)
    score.objectives.push_back(objective(judged.evaluation.metrics, o.name));
  if (!model_->spec.uncertainty.any()) score.worst_case = score.objectives;
  return score;
}

FeederEvaluation FeederProblem::evaluate(int topology, std::span<const double> values) const {
  return model_->judge(topology, values, true).evaluation;
}

std::vector<PlacedFeature> FeederProblem::place(int topology, std::span<const double> values) const {
  const FeederSpec& spec = model_->spec;
  const double diameter = model_->with_part(values, [](const PartModel& part) { return part.diameter_mm; });
  const Layout layout = lay_out(spec.designs[topology], spec.environment, spec.manufacture, diameter, values);
  DesignSpec literal = literal_design(topology, values);
  std::vector<PlacedFeature> placed;
  for (std::size_t i = 0; i < layout.features.size(); ++i) {
    const LaidFeature& laid = layout.features[i];
    PlacedFeature feature{laid.type, laid.start_mm, laid.end_mm, {}, std::visit(Dimensions{}, literal[i].shape)};
    feature.obstacles = laid.obstacles;
    feature.wall_face_mm = laid.wall_face_mm;
    if (!laid.voids.empty()) {
      feature.voids_mm =
          intersection(laid.voids, {rectangle(laid.x_min - 1, 0, laid.x_max + 1, spec.environment.track_width_mm)});
    }
    placed.push_back(std::move(feature));
  }
  return placed;
}

std::vector<AspectShape> FeederProblem::shapes(std::span<const double> values) const {
  return model_->with_part(values, [](const PartModel& part) { return part.shapes; });
}

std::vector<StablePose> FeederProblem::stable_poses(std::span<const double> values) const {
  return model_->with_part(values, [](const PartModel& part) {
    std::vector<StablePose> poses;
    for (const PoseModel& pose : part.poses) poses.push_back(pose.stable);
    return poses;
  });
}

SupportAnswer FeederProblem::support(int topology, std::span<const double> values, const std::string& aspect,
                                     const Configuration& q) const {
  const FeederSpec& spec = model_->spec;
  return model_->with_part(values, [&](const PartModel& part) {
    const auto shape =
        std::find_if(part.shapes.begin(), part.shapes.end(), [&](const AspectShape& s) { return s.name == aspect; });
    if (shape == part.shapes.end()) throw std::logic_error("no aspect " + aspect);
    const Layout layout = lay_out(spec.designs[topology], spec.environment, spec.manufacture, part.diameter_mm, values);
    Track track{spec.environment.track_width_mm, {}};
    std::vector<Loop> voids;
    for (const LaidFeature& feature : layout.features)
      voids.insert(voids.end(), feature.voids.begin(), feature.voids.end());
    for (const VoidGroup& group : grouped(layout, 0)) {
      for (const Loop& loop : group.loops) {
        if (signed_area(loop) > 0) {
          track.voids.push_back({loop, {}});
        } else {  // a hole lies in the void that contains it
          for (Polygon& polygon : track.voids) {
            if (locate(polygon.outer, loop.front(), 0) == Side::Inside) polygon.holes.push_back(loop);
          }
        }
      }
    }
    const Polygon placed_part = placed(shape->footprint, q.theta_rad, {q.x_mm, q.y_mm});
    const Point supported(q.x_mm, q.y_mm - wall_shift(shape->com_height_mm, spec.environment));
    const std::optional<double> margin = support_margin(placed_part, track, supported);
    return SupportAnswer{margin && *margin >= kLost_mm, margin};
  });
}

World FeederProblem::world(int topology, std::span<const double> values, const std::string& aspect) const {
  const FeederSpec& spec = model_->spec;
  return model_->with_part(values, [&](const PartModel& part) {
    const auto shape =
        std::find_if(part.shapes.begin(), part.shapes.end(), [&](const AspectShape& s) { return s.name == aspect; });
    if (shape == part.shapes.end()) throw std::logic_error("no aspect " + aspect);
    const Layout layout = lay_out(spec.designs[topology], spec.environment, spec.manufacture, part.diameter_mm, values);
    return *world_of(*shape, layout, spec.environment, part.diameter_mm);  // what is not shrunk does not vanish
  });
}

DesignSpec FeederProblem::literal_design(int topology, std::span<const double> values) const {
  DesignSpec design = model_->spec.designs[topology];
  for (FeatureSpec& feature : design) {
    Expressions::each(feature, [&](Affine& expression) { expression = {expression(values), {}}; });
  }
  return design;
}

}  // namespace formotion::feeder
