// What the nest application says, in the contract's JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "applications/nest/nest_problem.hpp"

namespace formotion {

// The answer of `evaluate` (format, kind, feasibility, values, metrics, rests, starts, ...).
nlohmann::ordered_json evaluation_json(const nest::NestProblem& problem, int topology, std::span<const double> values,
                                       const nest::NestEvaluation& evaluation);
// Those of its purpose.
nlohmann::ordered_json metrics_json(nest::Purpose purpose, const nest::Metrics& metrics);
// The values of the variables that a topology uses, by name; values are of all the problem's variables.
nlohmann::ordered_json values_json(const nest::NestProblem& problem, int topology, std::span<const double> values);
// A design with literal numbers, as a design file's `nest_mm`.
nlohmann::ordered_json shapes_json(const nest::DesignSpec& literal);

}  // namespace formotion
