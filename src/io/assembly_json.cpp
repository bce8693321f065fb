#include "io/assembly_json.hpp"

#include "io/json_values.hpp"
#include "io/problem_reader.hpp"

namespace formotion {
namespace {

using Json = nlohmann::ordered_json;
using namespace assembly;

struct NamedScene {
  std::unique_ptr<Scene> scene;
  WrittenNames names;
};

Json point(const Point& p) { return {number_json(p.x()), number_json(p.y())}; }

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
    one["force_n"] = {number_json(contact.force.normal), number_json(contact.force.tangential)};
    json.push_back(std::move(one));
  }
  return json;
}

Json errors_json(const StartResult& start) {
  return {{"x_mm", number_json(start.x_mm)},
          {"y_mm", number_json(start.y_mm)},
          {"theta_deg", degrees_json(start.theta_rad)}};
}

Json start_json(const StartResult& start, const NamedScene& named) {
  const Insertion& end = start.insertion;
  Json json = errors_json(start);
  json["outcome"] = name(end.outcome);
  json["depth_mm"] = number_json(end.depth_mm);
  json["lateral_mm"] = number_json(end.lateral_mm);
  json["tilt_deg"] = degrees_json(end.tilt_rad);
  json["peak_force_n"] = number_json(end.peak_axial_n);
  json["work_nmm"] = number_json(end.work_nmm);
  json["why"] = end.why;
  json["contacts"] = contacts_json(named, end);
  return json;
}

Json never_json(const NeverResult& never) {
  return {{"aspect", never.aspect},
          {"orientation_deg", degrees_json(never.orientation_rad)},
          {"holds", never.holds},
          {"proved", never.proved},
          {"bound_mm", number_json(never.bound_mm)},
          {"deepest_mm", number_json(never.deepest.insertion.deepest_mm)},
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
  return {{"success_fraction", number_json(m.success_fraction)},
          {"capture_mm", number_json(m.capture_mm)},
          {"capture_deg", number_json(m.capture_deg)},
          {"peak_force_n", number_json(m.peak_force_n)},
          {"work_nmm", number_json(m.work_nmm)},
          {"depth_margin_mm", number_json(m.depth_margin_mm)},
          {"chamfer_mm", number_json(m.chamfer_mm)},
          {"peak_lateral_force_n", number_json(m.peak_lateral_force_n)}};
}

Json values_json(const AssemblyProblem& problem, int topology, std::span<const double> values) {
  return used_values_json(problem, topology, values);
}

Json shapes_json(const DesignSpec& literal) {
  Json json{{"fixed_mm", Json::array()}};
  for (const AffineLoop& shape : literal.fixed_mm) json["fixed_mm"].push_back(loop_json(constant_loop(shape)));
  if (literal.chamfer_mm) json["chamfer_mm"] = number_json(literal.chamfer_mm->constant);
  return json;
}

Json evaluation_json(const AssemblyProblem& problem, int topology, std::span<const double> values,
                     const AssemblyEvaluation& evaluation) {
  Json json{{"formotion", 1}, {"kind", "assembly"}, {"feasible", evaluation.feasible}};
  json["violations"] = Json::array();
  for (const Violation& v : evaluation.violations)
    json["violations"].push_back({{"what", v.what}, {"where", v.where}, {"by", number_json(v.by)}});
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
  json["region"] = region_json(evaluation.regions, evaluation.region_y_mm, kInsertionOutcomes,
                               [](int outcome) { return name(static_cast<InsertionOutcome>(outcome)); });
  json["never"] = Json::array();
  for (const NeverResult& never : evaluation.never) json["never"].push_back(never_json(never));
  json["fails_at_friction"] = number_json(evaluation.fails_at_friction);
  json["fails_as"] = evaluation.fails_as ? Json(name(*evaluation.fails_as)) : Json(nullptr);
  return json;
}

}  // namespace formotion
