// What the report page shows of one fixture or pallet: the nest, its rests and ways out, the landscape of heights over
// configuration space, the map from placement to rest.
#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "applications/nest/nest_problem.hpp"

namespace formotion {

// The page's problem.nest.
nlohmann::ordered_json asked_json(const nest::NestProblem& problem, std::span<const double> values);
// The page's nest of a design; with_landscape: the heights of its configuration space, some 100 kB.
nlohmann::ordered_json nest_json(const nest::NestProblem& problem, int topology, std::span<const double> values,
                                 const nest::NestEvaluation& evaluation, bool with_landscape);

}  // namespace formotion
