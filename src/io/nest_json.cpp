#include "io/nest_json.hpp"

#include "io/json_values.hpp"
#include "io/problem_reader.hpp"

namespace formotion {
namespace {

using Json = nlohmann::ordered_json;
using namespace nest;

constexpr int kMostOfASet = 40;  // configurations listed of a set of equilibria

Json pose_json(const Configuration& q) {
  return {{"x_mm", number_json(q.x_mm)}, {"y_mm", number_json(q.y_mm)}, {"orientation_deg", degrees_json(q.theta_rad)}};
}

Json poses_json(const std::vector<Configuration>& poses) {
  Json json = Json::array();
  for (const Configuration& q : poses) json.push_back(pose_json(q));
  return json;
}

Json rest_json(const NestRest& rest, const Configuration& seat, int symmetry, bool is_pallet) {
  Json json{{"aspect", rest.aspect}};
  // The seat's numbers as they were given.
  json.update(pose_json(rest.is_seat ? reduced(seat, symmetry) : rest.at));
  json["is_seat"] = rest.is_seat;
  json["height_mm"] = number_json(rest.height_mm);
  if (is_pallet) {
    json["escape_height_mm"] = {number_json(rest.escape_low_mm), number_json(rest.escape_high_mm)};
    json["why"] = rest.why;
    json["way_out"] = poses_json(rest.way_out);
  }
  json["set"] = poses_json(rest.set);
  json["drop_share"] = number_json(rest.drop_share);
  return json;
}

Json wrong_json(const WrongSet& wrong) {
  Json json{{"aspect", wrong.aspect}};
  json.update(pose_json(wrong.set.certain));
  json["verdict"] = name(wrong.set.verdict);
  json["size_mm"] = number_json(wrong.set.size_mm);
  const std::vector<Configuration>& samples = wrong.set.samples;
  const std::size_t step = samples.size() / kMostOfASet + 1;
  json["samples"] = Json::array();
  for (std::size_t i = 0; i < samples.size(); i += step) json["samples"].push_back(pose_json(samples[i]));
  return json;
}

Json window_json(const ShakingWindow& window) {
  return {{"throws_mm", number_json(window.throws_mm)},
          {"keeps_up_to_amplitude_mm", number_json(window.keeps_up_to_mm)},
          {"loses_from_amplitude_mm", number_json(window.loses_from_mm)},
          {"drops_per_part", number_json(window.filling.drops_per_part)},
          {"right_share", number_json(window.filling.right_share)}};
}

}  // namespace

Json metrics_json(Purpose purpose, const Metrics& m) {
  if (purpose == Purpose::Fixture) {
    return {{"seated_fraction", number_json(m.seated_fraction)},
            {"wrong_equilibria", m.wrong_equilibria ? Json(*m.wrong_equilibria) : Json(nullptr)},
            {"repeatability_mm", number_json(m.repeatability_mm)},
            {"resisted_weights", number_json(m.resisted_weights)},
            {"resisted_moment_mm", number_json(m.resisted_moment_mm)}};
  }
  return {{"goal_escape_height_mm", number_json(m.goal_escape_height_mm)},
          {"worst_wrong_escape_height_mm", number_json(m.worst_wrong_escape_height_mm)},
          {"selectivity_mm", number_json(m.selectivity_mm)},
          {"capture_fraction", number_json(m.capture_fraction)}};
}

Json values_json(const NestProblem& problem, int topology, std::span<const double> values) {
  return used_values_json(problem, topology, values);
}

Json shapes_json(const DesignSpec& literal) {
  Json json{{"nest_mm", Json::array()}};
  for (const AffineLoop& shape : literal.nest_mm) json["nest_mm"].push_back(loop_json(constant_loop(shape)));
  return json;
}

Json evaluation_json(const NestProblem& problem, int topology, std::span<const double> values,
                     const NestEvaluation& evaluation) {
  const NestSpec& spec = problem.spec();
  const bool is_pallet = spec.purpose == Purpose::Pallet;
  Json json{{"formotion", 1}, {"kind", is_pallet ? "pallet" : "fixture"}, {"feasible", evaluation.feasible}};
  json["violations"] = Json::array();
  for (const Violation& v : evaluation.violations)
    json["violations"].push_back({{"what", v.what}, {"where", v.where}, {"by", number_json(v.by)}});
  json["values"] = values_json(problem, topology, values);
  json["metrics"] = metrics_json(spec.purpose, evaluation.metrics);
  // Without uncertainties the worst case is the nominal one.
  json["worst_case"] = nullptr;
  if (evaluation.worst_case || !spec.uncertainty.any()) {
    json["worst_case"] = metrics_json(spec.purpose, evaluation.worst_case.value_or(evaluation.metrics));
    json["worst_case"]["bites"] = evaluation.bites ? Json(*evaluation.bites) : Json(nullptr);
  }
  const Configuration seat = problem.seat(values);
  json["rests"] = Json::array();
  for (const AspectShape& shape : aspect_shapes(spec.part, values)) {
    for (const NestRest& rest : evaluation.rests) {
      if (rest.aspect == shape.name) json["rests"].push_back(rest_json(rest, seat, rotational_order(shape), is_pallet));
    }
  }
  json["starts"] = Json::array();
  for (const StartResult& start : evaluation.starts) {
    Json one{{"x_mm", number_json(start.x_mm)},
             {"y_mm", number_json(start.y_mm)},
             {"theta_deg", degrees_json(start.theta_rad)},
             {"outcome", name(start.outcome)}};
    one["end"] = pose_json(start.end);
    one["sure"] = start.is_sure;
    one["pushed"] = name(start.pushed);
    json["starts"].push_back(std::move(one));
  }
  json["region"] = region_json(evaluation.regions, evaluation.region_y_mm, kNestOutcomes,
                               [](int outcome) { return name(static_cast<NestOutcome>(outcome)); });
  json["sure_fraction"] = number_json(evaluation.sure_fraction);
  json["certain_fraction"] = number_json(evaluation.certain_fraction);
  if (is_pallet) {
    json["window"] = evaluation.window ? window_json(*evaluation.window) : Json(nullptr);
    return json;
  }
  json["seat_holds"] = name(evaluation.seat_holds);
  json["wrong"] = Json::array();
  for (const WrongSet& wrong : evaluation.wrong) json["wrong"].push_back(wrong_json(wrong));
  return json;
}

}  // namespace formotion
