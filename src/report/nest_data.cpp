#include "report/nest_data.hpp"

#include <cmath>
#include <memory>
#include <numbers>

#include "io/json_values.hpp"
#include "io/nest_json.hpp"
#include "io/problem_reader.hpp"
#include "report/nest_landscape.hpp"
#include "report/run_data.hpp"

namespace formotion {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostPasses = 24;  // rests of an aspect beyond which passes are left out
constexpr double kPassGap_mm = 0.2;
constexpr long kPassCells = 300000;  // for one bracket

Json polygon_json(const Polygon& polygon) {
  return {{"outer", loop_json(polygon.outer)}, {"holes", loops_json(polygon.holes)}};
}

Json coarse(double value) { return std::isfinite(value) ? Json(std::round(value * 100) / 100 + 0.0) : Json(nullptr); }

Json interval_json(const ErrorInterval& i) { return {fine(i.min), fine(i.max)}; }

double gravity_deg(const nest::NestSpec& spec, std::span<const double> values) {
  return spec.environment.gravity_deg.value(values) + spec.environment.tilt_deg.value(values);
}

Json seat_json(const nest::NestProblem& problem, std::span<const double> values) {
  const Configuration seat = problem.seat(values);
  return {{"aspect", problem.spec().goal.seat.aspect},
          {"x_mm", fine(seat.x_mm)},
          {"y_mm", fine(seat.y_mm)},
          {"orientation_deg", degrees_json(seat.theta_rad)}};
}

// Heights over the seat.
Json landscape_json(const nest::Scene& scene, const std::vector<nest::NestRest>& rests,
                    const std::vector<std::size_t>& numbers, double zero_mm) {
  const Landscape land = landscape_of(scene, rests);
  Json json{{"aspect", scene.shape.name}, {"across_mm", {fine(land.from_mm), fine(land.to_mm)}},
            {"theta_deg", {0, 360}},      {"heights_mm", Json::array()},
            {"basin", Json::array()},     {"hidden", Json::array()}};
  for (const int rest : land.hidden) json["hidden"].push_back(numbers[static_cast<std::size_t>(rest)]);
  for (std::size_t row = 0; row < land.height.size(); ++row) {
    Json heights = Json::array(), basins = Json::array();
    for (std::size_t column = 0; column < land.height[row].size(); ++column) {
      const std::optional<double>& height = land.height[row][column];
      heights.push_back(height ? coarse(*height - zero_mm) : Json(nullptr));
      const int basin = land.basin[row][column];
      basins.push_back(basin == kNoRest ? -1 : static_cast<int>(numbers[static_cast<std::size_t>(basin)]));
    }
    json["heights_mm"].push_back(std::move(heights));
    json["basin"].push_back(std::move(basins));
  }
  return json;
}

void add_passes(Json& json, const nest::Scene& scene, const std::vector<nest::NestRest>& rests,
                const std::vector<std::size_t>& numbers, double zero_mm) {
  EscapeOptions options;
  options.gap_mm = kPassGap_mm;
  options.most_cells = kPassCells;
  const auto number = [&](int rest) {
    return rest == kNoRest ? -1 : static_cast<int>(numbers[static_cast<std::size_t>(rest)]);
  };
  for (const NamedPass& pass : passes_of(scene, rests, options)) {
    Json one{{"aspect", scene.shape.name},
             {"first", number(pass.first)},
             {"second", number(pass.second)},
             {"lower_mm", coarse(pass.lower_mm - zero_mm)},
             {"upper_mm", pass.upper_mm ? coarse(*pass.upper_mm - zero_mm) : Json(nullptr)}};
    if (pass.at) {
      one["x_mm"] = coarse(pass.at->x_mm);
      one["y_mm"] = coarse(pass.at->y_mm);
      one["orientation_deg"] = coarse(pass.at->theta_rad * 180 / std::numbers::pi);
    }
    json.push_back(std::move(one));
  }
}

}  // namespace

Json asked_json(const nest::NestProblem& problem, std::span<const double> values) {
  const nest::NestSpec& spec = problem.spec();
  const StartsSpec& starts = spec.goal.starts;
  constexpr double kDegrees = 180 / std::numbers::pi;
  Json json{{"purpose", spec.purpose == nest::Purpose::Pallet ? "pallet" : "fixture"}};
  json["gravity_deg"] = fine(spec.environment.gravity_deg.value(values));
  json["tilt_deg"] = fine(spec.environment.tilt_deg.value(values));
  json["friction"] = fine(spec.environment.friction.value(values));
  json["seat"] = seat_json(problem, values);
  json["seat"]["within_mm"] = fine(spec.goal.seat.within_mm);
  json["starts"] = {{"x_mm", interval_json(starts.x_mm)},
                    {"y_mm", interval_json(starts.y_mm)},
                    {"theta_deg", {fine(starts.theta_rad.min * kDegrees), fine(starts.theta_rad.max * kDegrees)}}};
  json["table"] = nullptr;
  if (const auto& table = spec.environment.table) {
    json["table"] = {{"amplitude_mm", fine(table->amplitude_mm)},
                     {"frequency_hz", fine(table->frequency_hz)},
                     {"restitution", fine(table->restitution.value(values))}};
  }
  return json;
}

Json nest_json(const nest::NestProblem& problem, int topology, std::span<const double> values,
               const nest::NestEvaluation& evaluation, bool with_landscape) {
  Json json = evaluation_json(problem, topology, values, evaluation);
  for (const char* key : {"formotion", "kind", "feasible", "violations", "values", "metrics", "worst_case"})
    json.erase(key);
  json["gravity_deg"] = gravity_deg(problem.spec(), values);
  json["seat"] = seat_json(problem, values);
  json["aspects"] = Json::array();
  json["landscape"] = nullptr;
  json["passes"] = nullptr;
  const bool is_shown = with_landscape && problem.defects(topology, values).empty();
  std::size_t first = 0;  // rests are numbered as the evaluation's JSON lists them: by aspect
  for (const AspectShape& shape : aspect_shapes(problem.spec().part, values)) {
    json["aspects"].push_back(
        {{"name", shape.name}, {"symmetry", rotational_order(shape)}, {"outline", polygon_json(shape.footprint)}});
    std::vector<nest::NestRest> rests;
    std::vector<std::size_t> numbers;
    for (const nest::NestRest& rest : evaluation.rests) {
      if (rest.aspect != shape.name) continue;
      rests.push_back(rest);
      numbers.push_back(first++);
    }
    if (!is_shown) continue;
    const std::unique_ptr<nest::Scene> scene = problem.scene(topology, values, shape.name);
    const double zero_mm = scene->gravity.height_mm(problem.seat(values));
    json["landscape"].push_back(landscape_json(*scene, rests, numbers, zero_mm));
    if (rests.size() <= kMostPasses) add_passes(json["passes"], *scene, rests, numbers, zero_mm);
  }
  round_all(json);
  return json;
}

}  // namespace formotion
