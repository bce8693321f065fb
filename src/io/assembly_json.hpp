// What the assembly application says, in the contract's JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "applications/assembly/assembly_problem.hpp"
#include "io/written_names.hpp"

namespace formotion {

// The answer of `evaluate` (format, kind, feasibility, values, metrics, starts, region, never, ...).
nlohmann::ordered_json evaluation_json(const assembly::AssemblyProblem& problem, int topology,
                                       std::span<const double> values, const assembly::AssemblyEvaluation& evaluation);

nlohmann::ordered_json metrics_json(const assembly::Metrics& metrics);
// The values of the variables that a topology uses, by name; values are of all the problem's variables.
nlohmann::ordered_json values_json(const assembly::AssemblyProblem& problem, int topology,
                                   std::span<const double> values);
// A design with literal numbers, as a design file's `fixed_mm` (and `chamfer_mm`).
nlohmann::ordered_json shapes_json(const assembly::DesignSpec& literal);

// What the features of a joint are called, of a moving shape that is relative to `about` (a point of the drawn part).
WrittenNames names_of(const assembly::Joint& joint, const std::string& aspect, const Point& about);
const char* mode_word(ContactMode mode);  // "stick", "slide-left", ...

}  // namespace formotion
