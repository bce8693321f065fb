// What the feeder application says, in the contract's JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "applications/feeder/feeder_problem.hpp"
#include "applications/feeder/uncertainty_limits.hpp"

namespace formotion {

using OrderedJson = nlohmann::ordered_json;

// The answer of `evaluate` (format, kind, feasibility, values, metrics, poses, ...).
OrderedJson evaluation_json(const feeder::FeederProblem& problem, int topology, std::span<const double> values,
                            const feeder::FeederEvaluation& evaluation);

// What `evaluate` says of how uncertain a design's values may be: scale, alone.
OrderedJson limits_json(const feeder::UncertaintyLimits& limits);
OrderedJson metrics_json(const feeder::Metrics& metrics);
OrderedJson violations_json(const std::vector<feeder::Violation>& violations);
OrderedJson pose_json(const feeder::PoseResult& pose);
OrderedJson outcome_map_json(const std::vector<feeder::MapInterval>& map);
// The values of the variables that a topology uses, by name; values are of all the problem's variables.
OrderedJson values_json(const feeder::FeederProblem& problem, int topology, std::span<const double> values);
// A design with literal numbers, as `features` of a design file.
OrderedJson features_json(const feeder::DesignSpec& literal);

}  // namespace formotion
