#include "io/feeder_json.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "io/problem_reader.hpp"

namespace formotion {
namespace {

using Json = OrderedJson;
using namespace feeder;

Json number(double value) { return std::isfinite(value) ? Json(value + 0.0) : Json(nullptr); }
Json number(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }

// Degrees without the rounding of the conversion: 90, not 90.00000000000001.
double degrees(double rad) { return std::round(rad * 180 / std::numbers::pi * 1e9) / 1e9 + 0.0; }

double value_of(const Affine& literal) { return literal.constant + 0.0; }

Json polygon_json(const AffineLoop& loop) { return loop_json(constant_loop(loop)); }

// Keys and numbers of a literal feature, as in a problem file.
struct FeatureJson {
  Json& f;
  void operator()(const Balcony& s) const { put({{"width_mm", s.width_mm}, {"length_mm", s.length_mm}}); }
  void operator()(const Gap& s) const { put({{"length_mm", s.length_mm}}); }
  void operator()(const Canyon& s) const {
    put({{"from_mm", s.from_mm}, {"to_mm", s.to_mm}, {"length_mm", s.length_mm}});
  }
  void operator()(const Slot& s) const {
    put({{"from_mm", s.from_mm}, {"to_mm", s.to_mm}, {"length_mm", s.length_mm}});
  }
  void operator()(const Cutout& s) const { f["polygon_mm"] = polygon_json(s.polygon_mm); }
  void operator()(const DishOut& s) const { put({{"depth_mm", s.depth_mm}, {"length_mm", s.length_mm}}); }
  void operator()(const Scallop& s) const {
    put({{"depth_mm", s.depth_mm}});
    f["half_angle_deg"] = degrees(s.half_angle_rad.constant);
  }
  void operator()(const Drawing& s) const {
    if (!s.file.empty()) f["file"] = s.file;
    f["voids_mm"] = loops_json(s.voids_mm);
    f["walls_mm"] = loops_json(s.walls_mm);
  }
  void operator()(const Wiper& s) const { put({{"height_mm", s.height_mm}}); }
  void operator()(const HoldDown& s) const { put({{"height_mm", s.height_mm}, {"length_mm", s.length_mm}}); }
  void operator()(const Fence& s) const { f["polygon_mm"] = polygon_json(s.polygon_mm); }
  void operator()(const WallProfile& s) const { f["profile_mm"] = polygon_json(s.profile_mm); }
  void operator()(const Pin& s) const { put({{"x_mm", s.x_mm}, {"y_mm", s.y_mm}, {"diameter_mm", s.diameter_mm}}); }

  void put(const std::vector<std::pair<const char*, Affine>>& numbers) const {
    for (const auto& [key, value] : numbers) f[key] = value_of(value);
  }
};

}  // namespace

Json metrics_json(const Metrics& m) {
  return {{"efficiency", number(m.efficiency)},
          {"purity", number(m.purity)},
          {"jam_probability", number(m.jam_probability)},
          {"tolerance_mm", number(m.tolerance_mm)},
          {"margin_mm", number(m.margin_mm)},
          {"length_mm", number(m.length_mm)},
          {"feature_count", m.feature_count},
          {"feed_rate_per_min", number(m.feed_rate_per_min)}};
}

Json pose_json(const PoseResult& pose) {
  Json json{{"aspect", pose.aspect},
            {"orientation_deg", degrees(pose.orientation_rad)},
            {"prior", number(pose.prior)},
            {"outcome", name(pose.outcome)}};
  json["exit_orientation_deg"] = pose.exit_orientation_rad ? Json(degrees(*pose.exit_orientation_rad)) : Json(nullptr);
  json["margin_mm"] = number(pose.margin_mm);
  json["unsupported_mm"] = number(pose.unsupported_mm);
  json["tip_mm"] = number(pose.tip_mm);
  json["decided_by"] = pose.decided_by
                           ? Json{{"feature", pose.decided_by->feature}, {"x_mm", number(pose.decided_by->x_mm)}}
                           : Json(nullptr);
  json["may_catch"] = pose.may_catch;
  json["marginal"] = pose.marginal;
  json["reason"] = pose.reason;
  return json;
}

Json values_json(const FeederProblem& problem, int topology, std::span<const double> values) {
  Json json = Json::object();
  for (const int index : problem.topologies()[static_cast<std::size_t>(topology)].variables) {
    json[problem.variables()[static_cast<std::size_t>(index)].name] = values[static_cast<std::size_t>(index)] + 0.0;
  }
  return json;
}

Json features_json(const DesignSpec& literal) {
  Json features = Json::array();
  for (const FeatureSpec& feature : literal) {
    Json json{{"type", type_name(feature)}};
    std::visit(FeatureJson{json}, feature.shape);
    if (feature.at_mm) json["at_mm"] = value_of(*feature.at_mm);
    features.push_back(std::move(json));
  }
  return features;
}

Json violations_json(const std::vector<Violation>& violations) {
  Json json = Json::array();
  for (const Violation& v : violations) json.push_back({{"what", v.what}, {"where", v.where}, {"by", number(v.by)}});
  return json;
}

Json goals_json(const std::vector<GoalAnswer>& goals) {
  Json json = Json::array();
  for (const GoalAnswer& goal : goals) {
    json.push_back({{"must", goal.must},
                    {"where", goal.where},
                    {"asked_mm", number(goal.asked_mm)},
                    {"got_mm", number(goal.got_mm)}});
  }
  return json;
}

// Neighbours share their ends bit for bit: equal numbers are written equal.
Json outcome_map_json(const std::vector<MapInterval>& map) {
  Json json = Json::array();
  for (const MapInterval& interval : map) {
    json.push_back({{"aspect", interval.aspect},
                    {"from_deg", degrees(interval.from_rad)},
                    {"to_deg", degrees(interval.to_rad)},
                    {"outcome", name(interval.outcome)}});
    json.back()["exit_orientation_deg"] =
        interval.exit_orientation_rad ? Json(degrees(*interval.exit_orientation_rad)) : Json(nullptr);
    json.back()["thin"] = interval.thin;
  }
  return json;
}

Json limits_json(const UncertaintyLimits& limits) {
  Json json{{"scale", number(limits.scale)}, {"alone", Json::object()}};
  for (const AloneLimit& limit : limits.alone) {
    json["alone"][limit.name] =
        limit.interval ? Json{number(limit.interval->first), number(limit.interval->second)} : number(limit.half_width);
  }
  return json;
}

Json evaluation_json(const FeederProblem& problem, int topology, std::span<const double> values,
                     const FeederEvaluation& evaluation) {
  Json json{{"formotion", 1}, {"kind", "feeder"}, {"feasible", evaluation.feasible}};
  json["violations"] = violations_json(evaluation.violations);
  json["warnings"] = evaluation.warnings;
  json["values"] = values_json(problem, topology, values);
  json["metrics"] = metrics_json(evaluation.metrics);
  // Without uncertainties the worst case is the nominal one.
  json["worst_case"] = nullptr;
  if (!problem.spec().uncertainty.any()) {
    json["worst_case"] = json["metrics"];
    json["worst_case"]["bites"] = nullptr;
    json["worst_case"]["feasible"] = evaluation.feasible;
  }
  if (evaluation.worst_case) {
    json["worst_case"] = metrics_json(*evaluation.worst_case);
    json["worst_case"]["bites"] = evaluation.bites ? Json(*evaluation.bites) : Json(nullptr);
    json["worst_case"]["feasible"] = evaluation.robust;
  }
  if (!evaluation.goals.empty()) json["goals"] = goals_json(evaluation.goals);
  json["goal_pose"] = evaluation.goal_pose >= 0 ? Json(evaluation.goal_pose) : Json(nullptr);
  json["poses"] = Json::array();
  for (const PoseResult& pose : evaluation.poses) json["poses"].push_back(pose_json(pose));
  if (!evaluation.outcome_map.empty()) json["outcome_map"] = outcome_map_json(evaluation.outcome_map);
  return json;
}

}  // namespace formotion
