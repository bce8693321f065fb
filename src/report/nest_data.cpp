#include "report/nest_data.hpp"

#include "io/json_values.hpp"
#include "io/nest_json.hpp"
#include "io/problem_reader.hpp"
#include "report/run_data.hpp"

namespace formotion {
namespace {

using Json = nlohmann::ordered_json;

Json polygon_json(const Polygon& polygon) {
  return {{"outer", loop_json(polygon.outer)}, {"holes", loops_json(polygon.holes)}};
}

}  // namespace

Json asked_json(const nest::NestProblem& problem, std::span<const double> values) {
  const nest::NestSpec& spec = problem.spec();
  const Configuration seat = problem.seat(values);
  Json json{{"purpose", spec.purpose == nest::Purpose::Pallet ? "pallet" : "fixture"}};
  json["gravity_deg"] = fine(spec.environment.gravity_deg.value(values) + spec.environment.tilt_deg.value(values));
  json["friction"] = fine(spec.environment.friction.value(values));
  json["seat"] = {{"aspect", spec.goal.seat.aspect},
                  {"x_mm", fine(seat.x_mm)},
                  {"y_mm", fine(seat.y_mm)},
                  {"orientation_deg", degrees_json(seat.theta_rad)},
                  {"within_mm", fine(spec.goal.seat.within_mm)}};
  json["table"] = nullptr;
  if (const auto& table = spec.environment.table) {
    json["table"] = {{"amplitude_mm", fine(table->amplitude_mm)},
                     {"frequency_hz", fine(table->frequency_hz)},
                     {"restitution", fine(table->restitution.value(values))}};
  }
  return json;
}

Json nest_json(const nest::NestProblem& problem, int topology, std::span<const double> values,
               const nest::NestEvaluation& evaluation, bool) {
  Json json = evaluation_json(problem, topology, values, evaluation);
  for (const char* key : {"formotion", "kind", "feasible", "violations", "values", "metrics", "worst_case"})
    json.erase(key);
  json["aspects"] = Json::array();
  for (const AspectShape& shape : aspect_shapes(problem.spec().part, values))
    json["aspects"].push_back({{"name", shape.name}, {"outline", polygon_json(shape.footprint)}});
  round_all(json);
  return json;
}

}  // namespace formotion
