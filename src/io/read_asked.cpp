#include "io/read_asked.hpp"

#include <numbers>

namespace formotion {
namespace {

using Json = nlohmann::ordered_json;

ErrorInterval read_error(ObjectReader& object, const std::string& key, const Range& range, IssueList& issues) {
  const Json* value = object.find(key);
  if (!value) return {};
  if (value->is_array()) {
    const auto interval = read_interval(*value, object.at(key), range, issues);
    return interval ? ErrorInterval{interval->first, interval->second} : ErrorInterval{};
  }
  const double number = read_number(*value, object.at(key), range, issues).value_or(0);
  return {number, number};
}

}  // namespace

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

std::string list(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::optional<std::pair<double, double>> read_interval(const Json& value, const std::string& pointer,
                                                       const Range& range, IssueList& issues) {
  if (!value.is_array() || value.size() != 2) {
    issues.add(pointer, described(value), "an interval [min, max]");
    return std::nullopt;
  }
  const auto low = read_number(value[0], pointer + "/0", range, issues);
  const auto high = read_number(value[1], pointer + "/1", range, issues);
  if (!low || !high) return std::nullopt;
  if (*low > *high) {
    issues.add(pointer, value.dump(), "an interval [min, max] with min not above max");
    return std::nullopt;
  }
  return std::pair(*low, *high);
}

Number read_uncertain(ObjectReader& object, const std::string& key, const Range& range, const Number& otherwise,
                      ShapeUncertainty& uncertainty, ReadContext& context) {
  const Json* value = object.find(key);
  if (!value) return otherwise;
  const std::string pointer = object.at(key);
  if (value->is_array()) {
    const auto interval = read_interval(*value, pointer, range, context.issues);
    if (!interval) return otherwise;
    uncertainty.intervals[key] = *interval;
    return {{(interval->first + interval->second) / 2, {}}, interval};
  }
  if (value->is_number()) return {{read_number(*value, pointer, range, context.issues).value_or(0), {}}, std::nullopt};
  return {read_expression(*value, pointer, context.names, context.issues).value_or(Affine{}), std::nullopt};
}

Number required_uncertain(ObjectReader& object, const std::string& key, const Range& range,
                          ShapeUncertainty& uncertainty, ReadContext& context) {
  object.require(key, "a number, an expression or an interval [min, max]");
  return read_uncertain(object, key, range, {}, uncertainty, context);
}

StartsSpec read_starts(const Json& value, const std::string& pointer, IssueList& issues) {
  StartsSpec starts;
  ObjectReader object(value, pointer, issues);
  starts.x_mm = read_error(object, "x_mm", kAny, issues);
  starts.y_mm = read_error(object, "y_mm", kAny, issues);
  const ErrorInterval degrees = read_error(object, "theta_deg", kTurn_deg, issues);
  starts.theta_rad = {radians(degrees.min), radians(degrees.max)};
  object.finish();
  return starts;
}

std::vector<Bound> read_bounds(const Json& value, const std::vector<std::string>& metrics, IssueList& issues) {
  std::vector<Bound> bounds;
  ObjectReader object(value, "/goal/require", issues);
  for (const std::string& metric : metrics) {
    const Json* given = object.find(metric);
    if (!given) continue;
    ObjectReader limits(*given, object.at(metric), issues);
    const Bound bound{metric, limits.number("min", kAny), limits.number("max", kAny)};
    limits.finish();
    if (limits.valid() && !bound.min && !bound.max)
      issues.add(object.at(metric), "neither min nor max", "at least one of them");
    if (bound.min && bound.max && *bound.min > *bound.max)
      issues.add(object.at(metric), given->dump(), "min not above max");
    bounds.push_back(bound);
  }
  object.finish();
  return bounds;
}

void read_shape_uncertainty(const Json& value, const std::string& centre_key,
                            const std::vector<std::pair<std::string, Range>>& keys, ShapeUncertainty& uncertainty,
                            ReadContext& context) {
  ObjectReader object(value, "/uncertainty", context.issues);
  uncertainty.outline_mm = object.number_or("outline_mm", kNotNegative, 0);
  uncertainty.feature_mm = object.number_or("feature_mm", kNotNegative, 0);
  uncertainty.centre_mm = object.number_or(centre_key, kNotNegative, 0);
  for (const auto& [key, range] : keys) {
    const Json* given = object.find(key);
    if (!given) continue;
    if (uncertainty.intervals.count(key))
      context.issues.add(object.at(key), "an interval that the environment gives, too", "one of them");
    if (const auto interval = read_interval(*given, object.at(key), range, context.issues))
      uncertainty.intervals[key] = *interval;
  }
  object.finish();
}

std::vector<AffineLoop> read_shapes(ObjectReader& object, const std::string& key, ReadContext& context) {
  const Json* shapes = object.require(key, "an array of polygons");
  if (!shapes) return {};
  const std::string at = object.at(key);
  if (shapes->is_array() && shapes->empty()) context.issues.add(at, described(*shapes), "at least one polygon");
  std::vector<AffineLoop> loops = read_loops(shapes, at, context);
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (loops[i].empty() || !is_literal(loops[i])) continue;
    if (const auto found = defect(normalised({constant_loop(loops[i]), {}})))
      context.issues.add(at + "/" + std::to_string(i), *found, "a simple polygon with area");
  }
  return loops;
}

}  // namespace formotion
