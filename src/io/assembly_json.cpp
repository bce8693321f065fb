#include "io/assembly_json.hpp"

#include <cmath>
#include <numbers>

#include "io/problem_reader.hpp"

namespace formotion {
namespace {

using Json = nlohmann::ordered_json;
using namespace assembly;

Json number(double value) { return std::isfinite(value) ? Json(value + 0.0) : Json(nullptr); }
Json number(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }

struct NamedScene {
  std::unique_ptr<Scene> scene;
  WrittenNames names;
};

// Degrees without the rounding of the conversion: 90, not 90.00000000000001.
Json degrees(double rad) { return number(std::round(rad * 180 / std::numbers::pi * 1e9) / 1e9); }

Json point(const Point& p) { return {number(p.x()), number(p.y())}; }

// Where the part has come to.
Configuration end_of(const InsertionTask& task, const Insertion& end) {
  const Point& along = task.approach.direction;
  const Point at = task.drawn.position() + end.depth_mm * along + end.lateral_mm * turned_left(along);
  return {at.x(), at.y(), task.drawn.theta_rad + end.tilt_rad};
}

Json contacts_json(const NamedScene& named, const Insertion& end) {
  Json json = Json::array();
  const Scene& scene = *named.scene;
  const Configuration q = end_of(scene.task, end);
  for (const CarriedContact& contact : end.contacts) {
    Json one{{"type", kind_word(contact.pair.kind)}};
    one.update(features_json(named.names.of(scene.part, scene.obstacles, contact.pair, q, contact.point)));
    one["point_mm"] = point(contact.point);
    one["normal"] = point(contact.normal);
    one["mode"] = mode_word(contact.mode);
    one["force_n"] = {number(contact.force.normal), number(contact.force.tangential)};
    json.push_back(std::move(one));
  }
  return json;
}

Json errors_json(const StartResult& start) {
  return {{"x_mm", number(start.x_mm)}, {"y_mm", number(start.y_mm)}, {"theta_deg", degrees(start.theta_rad)}};
}

Json start_json(const StartResult& start, const NamedScene& named) {
  const Insertion& end = start.insertion;
  Json json = errors_json(start);
  json["outcome"] = name(end.outcome);
  json["depth_mm"] = number(end.depth_mm);
  json["lateral_mm"] = number(end.lateral_mm);
  json["tilt_deg"] = degrees(end.tilt_rad);
  json["peak_force_n"] = number(end.peak_axial_n);
  json["work_nmm"] = number(end.work_nmm);
  json["why"] = end.why;
  json["contacts"] = contacts_json(named, end);
  return json;
}

Json region_json(const OutcomeRegion& region, double y_mm) {
  Json json{{"x_mm", {number(region.box.u_min), number(region.box.u_max)}},
            {"y_mm", number(y_mm)},
            {"theta_deg", {degrees(region.box.v_min), degrees(region.box.v_max)}},
            {"shares", Json::object()},
            {"rows", Json::array()}};
  for (int outcome = 0; outcome < kInsertionOutcomes; ++outcome) {
    const double share = share_of(region, outcome);
    if (share > 0) json["shares"][name(static_cast<InsertionOutcome>(outcome))] = number(share);
  }
  for (const RegionRow& row : region.rows) {
    Json intervals = Json::array();
    for (const RegionInterval& interval : row.intervals)
      intervals.push_back(
          {number(interval.from), number(interval.to), name(static_cast<InsertionOutcome>(interval.outcome))});
    json["rows"].push_back({{"theta_deg", degrees(row.v)}, {"intervals", std::move(intervals)}});
  }
  return json;
}

Json never_json(const NeverResult& never) {
  return {{"aspect", never.aspect},
          {"orientation_deg", degrees(never.orientation_rad)},
          {"holds", never.holds},
          {"proved", never.proved},
          {"bound_mm", number(never.bound_mm)},
          {"deepest_mm", number(never.deepest.insertion.deepest_mm)},
          {"starts", never.starts},
          {"at", errors_json(never.deepest)},
          {"outcome", name(never.deepest.insertion.outcome)},
          {"why", never.why}};
}

}  // namespace

const char* mode_word(ContactMode mode) {
  switch (mode) {
    case ContactMode::Break:
      return "break";
    case ContactMode::Stick:
      return "stick";
    case ContactMode::SlideLeft:
      return "slide-left";
    case ContactMode::SlideRight:
      return "slide-right";
  }
  return "break";
}

WrittenNames names_of(const Joint& joint, const std::string& aspect, const Point& about) {
  std::vector<Loop> part = joint.part_mm;
  for (Loop& loop : part) {
    for (Point& p : loop) p = Joint::held(p, about, aspect);
  }
  std::vector<std::vector<Loop>> fixed;
  for (const Loop& loop : joint.fixed_mm) fixed.push_back({loop});
  return {std::move(part), std::move(fixed)};
}

Json metrics_json(const Metrics& m) {
  return {{"success_fraction", number(m.success_fraction)},
          {"capture_mm", number(m.capture_mm)},
          {"capture_deg", number(m.capture_deg)},
          {"peak_force_n", number(m.peak_force_n)},
          {"work_nmm", number(m.work_nmm)},
          {"depth_margin_mm", number(m.depth_margin_mm)},
          {"chamfer_mm", number(m.chamfer_mm)},
          {"peak_lateral_force_n", number(m.peak_lateral_force_n)}};
}

Json values_json(const AssemblyProblem& problem, int topology, std::span<const double> values) {
  Json json = Json::object();
  for (const int index : problem.topologies()[static_cast<std::size_t>(topology)].variables) {
    json[problem.variables()[static_cast<std::size_t>(index)].name] = values[static_cast<std::size_t>(index)] + 0.0;
  }
  return json;
}

Json shapes_json(const DesignSpec& literal) {
  Json json{{"fixed_mm", Json::array()}};
  for (const AffineLoop& shape : literal.fixed_mm) json["fixed_mm"].push_back(loop_json(constant_loop(shape)));
  if (literal.chamfer_mm) json["chamfer_mm"] = number(literal.chamfer_mm->constant);
  return json;
}

Json evaluation_json(const AssemblyProblem& problem, int topology, std::span<const double> values,
                     const AssemblyEvaluation& evaluation) {
  Json json{{"formotion", 1}, {"kind", "assembly"}, {"feasible", evaluation.feasible}};
  json["violations"] = Json::array();
  for (const Violation& v : evaluation.violations)
    json["violations"].push_back({{"what", v.what}, {"where", v.where}, {"by", number(v.by)}});
  json["values"] = values_json(problem, topology, values);
  json["metrics"] = metrics_json(evaluation.metrics);
  // Without uncertainties the worst case is the nominal one.
  json["worst_case"] = nullptr;
  if (evaluation.worst_case || !problem.spec().uncertainty.any()) {
    json["worst_case"] = metrics_json(evaluation.worst_case.value_or(evaluation.metrics));
    json["worst_case"]["bites"] = evaluation.bites ? Json(*evaluation.bites) : Json(nullptr);
  }
  json["starts"] = Json::array();
  if (!evaluation.starts.empty()) {  // else the shapes are not valid
    const Joint joint = problem.joint(topology, values);
    const NamedScene named{problem.scene(topology, values, "up", 0), names_of(joint, "up", joint.centre_mm)};
    for (const StartResult& start : evaluation.starts) json["starts"].push_back(start_json(start, named));
  }
  // The middle one of those over other errors along y.
  const std::size_t middle = evaluation.regions.size() / 2;
  json["region"] = evaluation.regions.empty() ? Json(nullptr)
                                              : region_json(evaluation.regions[middle], evaluation.region_y_mm[middle]);
  json["never"] = Json::array();
  for (const NeverResult& never : evaluation.never) json["never"].push_back(never_json(never));
  json["fails_at_friction"] = number(evaluation.fails_at_friction);
  json["fails_as"] = evaluation.fails_as ? Json(name(*evaluation.fails_as)) : Json(nullptr);
  return json;
}

}  // namespace formotion
