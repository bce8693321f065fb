// What problems of several kinds ask in the same words (applications/shared/asked.hpp), out of JSON.
#pragma once

#include <string>
#include <vector>

#include "applications/shared/asked.hpp"
#include "io/problem_reader.hpp"

namespace formotion {

inline constexpr Range kFriction{0, 10, false};
inline constexpr Range kTurn_deg{-3600, 3600, false};

double radians(double degrees);
std::string list(const std::vector<std::string>& words);  // "up, down"

std::optional<std::pair<double, double>> read_interval(const nlohmann::ordered_json& value, const std::string& pointer,
                                                       const Range& range, IssueList& issues);
// A number, an expression or an interval, whose middle is the value. An interval counts as uncertain under its key.
Number read_uncertain(ObjectReader& object, const std::string& key, const Range& range, const Number& otherwise,
                      ShapeUncertainty& uncertainty, ReadContext& context);
Number required_uncertain(ObjectReader& object, const std::string& key, const Range& range,
                          ShapeUncertainty& uncertainty, ReadContext& context);

StartsSpec read_starts(const nlohmann::ordered_json& value, const std::string& pointer, IssueList& issues);
// The goal's `require`.
std::vector<Bound> read_bounds(const nlohmann::ordered_json& value, const std::vector<std::string>& metrics,
                               IssueList& issues);
// Half-widths, of the reference point under centre_key, and intervals of the environment's keys.
void read_shape_uncertainty(const nlohmann::ordered_json& value, const std::string& centre_key,
                            const std::vector<std::pair<std::string, Range>>& keys, ShapeUncertainty& uncertainty,
                            ReadContext& context);
// The polygons under a key of a design.
std::vector<AffineLoop> read_shapes(ObjectReader& object, const std::string& key, ReadContext& context);

}  // namespace formotion
