// Numbers of answers: null for what is not finite or missing, degrees without the rounding of the conversion.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "analysis/contact/configuration.hpp"
#include "applications/shared/starts.hpp"
#include "problem/problem.hpp"

namespace formotion {

inline nlohmann::ordered_json number_json(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value + 0.0) : nlohmann::ordered_json(nullptr);
}
inline nlohmann::ordered_json number_json(const std::optional<double>& value) {
  return value ? number_json(*value) : nlohmann::ordered_json(nullptr);
}
// 90, not 90.00000000000001.
inline nlohmann::ordered_json degrees_json(double rad) {
  return number_json(std::round(rad * 180 / std::numbers::pi * 1e9) / 1e9);
}

// The values of the variables that a topology uses, by name; values are of all the problem's variables.
nlohmann::ordered_json used_values_json(const Problem& problem, int topology, std::span<const double> values);
// The middle one of those over other errors along y; null if there is none. name: of an outcome's number.
nlohmann::ordered_json region_json(const std::vector<OutcomeRegion>& regions, const std::vector<double>& y_mm,
                                   int outcomes, const char* (*name)(int));

}  // namespace formotion
