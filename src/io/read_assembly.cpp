#include "io/read_assembly.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "io/suggestion.hpp"

namespace formotion {
namespace {

using Json = nlohmann::ordered_json;
constexpr Range kFriction{0, 10, false};
constexpr Range kTurn{-3600, 3600, false};
constexpr Range kTilt{0, 180, false};

const std::vector<std::string> kMetrics{"success_fraction", "capture_mm",      "capture_deg", "peak_force_n",
                                        "work_nmm",         "depth_margin_mm", "chamfer_mm",  "peak_lateral_force_n"};

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

// A number, an expression or an interval; the interval's middle is the value.
Number read_uncertain(const Json& value, const std::string& pointer, const Range& range,
                                ReadContext& context) {
  if (value.is_array()) {
    const auto interval = read_interval(value, pointer, range, context.issues);
    return interval ? Number{{(interval->first + interval->second) / 2, {}}, interval} : Number{};
  }
  if (value.is_number()) return {{read_number(value, pointer, range, context.issues).value_or(0), {}}, std::nullopt};
  return {read_expression(value, pointer, context.names, context.issues).value_or(Affine{}), std::nullopt};
}

Number required_uncertain(ObjectReader& object, const std::string& key, const Range& range,
                                    assembly::AssemblySpec& spec, ReadContext& context) {
  const Json* value = object.require(key, "a number, an expression or an interval [min, max]");
  if (!value) return {};
  const Number number = read_uncertain(*value, object.at(key), range, context);
  if (number.interval) spec.uncertainty.intervals[key] = *number.interval;
  return number;
}

void read_support(const Json& value, const std::string& pointer, assembly::AssemblySpec& spec, ReadContext& context) {
  assembly::SupportSpec& support = spec.support;
  ObjectReader object(value, pointer, context.issues);
  support.kx = required_uncertain(object, support.damper ? "bx_ns_per_mm" : "kx_n_per_mm", kPositive, spec, context);
  support.ky = required_uncertain(object, support.damper ? "by_ns_per_mm" : "ky_n_per_mm", kPositive, spec, context);
  support.ktheta = required_uncertain(object, support.damper ? "btheta_nmms_per_rad" : "ktheta_nmm_per_rad", kPositive,
                                      spec, context);
  if (const Json* centre = object.find("center_mm")) {
    const std::string at = object.at("center_mm");
    if (centre->is_array() && centre->size() == 2) {
      support.centre_is_centroid = false;
      for (std::size_t i = 0; i < 2; ++i) {
        support.centre_mm[i] =
            read_expression((*centre)[i], at + "/" + std::to_string(i), context.names, context.issues)
                .value_or(Affine{});
      }
    } else {
      context.issues.add(at, described(*centre), "a point [x, y]");
    }
  }
  object.finish();
}

void read_approach(const Json& value, assembly::AssemblySpec& spec, ReadContext& context) {
  assembly::ApproachSpec& approach = spec.approach;
  ObjectReader object(value, "/environment/approach", context.issues);
  approach.direction_rad = radians(object.number_or("direction_deg", {-360, 360, false}, -90));
  approach.distance_mm = object.required_number("distance_mm", kPositive, "how far the carrier moves");
  approach.max_force_n = object.number("max_force_n", kPositive);
  approach.speed_mm_s = object.number_or("speed_mm_s", kPositive, approach.speed_mm_s);
  object.finish();
}

Interval read_error(ObjectReader& object, const std::string& key, const Range& range, IssueList& issues) {
  const Json* value = object.find(key);
  if (!value) return {};
  if (value->is_array()) {
    const auto interval = read_interval(*value, object.at(key), range, issues);
    return interval ? Interval{interval->first, interval->second} : Interval{};
  }
  const double number = read_number(*value, object.at(key), range, issues).value_or(0);
  return {number, number};
}

StartsSpec read_starts(const Json& value, const std::string& pointer, IssueList& issues) {
  StartsSpec starts;
  ObjectReader object(value, pointer, issues);
  starts.x_mm = read_error(object, "x_mm", kAny, issues);
  starts.y_mm = read_error(object, "y_mm", kAny, issues);
  const Interval degrees = read_error(object, "theta_deg", kTurn, issues);
  starts.theta_rad = {radians(degrees.min), radians(degrees.max)};
  object.finish();
  return starts;
}

assembly::NeverSpec read_never(const Json& value, const std::string& pointer, bool flips, ReadContext& context) {
  assembly::NeverSpec never;
  ObjectReader object(value, pointer, context.issues);
  const std::vector<std::string> known =
      flips ? std::vector<std::string>{"up", "down", "any"} : std::vector<std::string>{"up"};
  never.aspect = object.string("aspect").value_or("up");
  if (!flips && (never.aspect == "down" || never.aspect == "any")) {
    context.issues.add(object.at("aspect"), "'" + never.aspect + "' of a part that does not flip",
                       "up, or \"flips\": true of the part");
  } else if (std::find(known.begin(), known.end(), never.aspect) == known.end()) {
    context.issues.add(object.at("aspect"),
                       "the unknown aspect '" + never.aspect + "'" + did_you_mean(never.aspect, known),
                       "one of " + list(known));
  }
  never.orientation_rad = radians(object.required_number("orientation_deg", kTurn));
  if (const Json* starts = object.find("starts"))
    never.starts = read_starts(*starts, object.at("starts"), context.issues);
  object.finish();
  return never;
}

void read_bounds(const Json& value, std::vector<Bound>& bounds, IssueList& issues) {
  ObjectReader object(value, "/goal/require", issues);
  for (const std::string& metric : kMetrics) {
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
}

}  // namespace

assembly::PartSpec read_assembly_part(const Json& value, ReadContext& context) {
  ObjectReader object(value, "/part", context.issues);
  feeder::AspectSpec drawn;
  drawn.height_mm = object.number_or("thickness_mm", kPositive, 0);
  if (value.is_object() && value.contains("layers"))
    context.issues.add("/part/layers", "layers", "one outline: an assembly is planar");
  read_outlines(object, value, drawn, context);
  const bool flips = object.boolean_or("flips", false);
  object.finish();
  return {drawn.outline_mm, drawn.holes_mm, flips};
}

void read_assembly_environment(const Json* value, assembly::AssemblySpec& spec, ReadContext& context) {
  spec.friction.value.constant = 0.2;
  if (!value) {
    context.issues.add("/environment", "nothing", "an object with compliance or damper, and approach");
    return;
  }
  ObjectReader object(*value, "/environment", context.issues);
  if (object.find("friction")) spec.friction = required_uncertain(object, "friction", kFriction, spec, context);
  const Json* spring = object.find("compliance");
  const Json* damper = object.find("damper");
  if (object.valid() && (spring != nullptr) == (damper != nullptr)) {
    context.issues.add("/environment", spring ? "both compliance and damper" : "neither compliance nor damper",
                       "exactly one of compliance and damper");
  }
  spec.support.damper = !spring && damper;
  if (spec.support.damper) {
    context.issues.add(object.at("damper"), "a damper, which this version reads and does not follow yet", "compliance");
  }
  if (spring) read_support(*spring, object.at("compliance"), spec, context);
  if (!spring && damper) read_support(*damper, object.at("damper"), spec, context);
  if (const Json* approach = object.require("approach", "an approach {\"distance_mm\", ...}"))
    read_approach(*approach, spec, context);
  object.finish();
}

void read_assembly_goal(const Json& value, assembly::AssemblySpec& spec, ReadContext& context) {
  assembly::GoalSpec& goal = spec.goal;
  ObjectReader object(value, "/goal", context.issues);
  goal.depth_mm = object.required_number("depth_mm", kPositive, "the depth that is wanted");
  goal.lateral_mm = object.required_number("lateral_mm", kNotNegative, "the offset that is allowed");
  goal.tilt_rad = radians(object.required_number("tilt_deg", kTilt, "the tilt that is allowed"));
  if (const Json* starts = object.find("starts"))
    goal.starts = read_starts(*starts, object.at("starts"), context.issues);
  const Json* never = object.find("never");
  if (never && !never->is_array()) {
    context.issues.add(object.at("never"), described(*never), "an array of poses {\"aspect\", \"orientation_deg\"}");
  } else if (never) {
    for (std::size_t i = 0; i < never->size(); ++i)
      goal.never.push_back(
          read_never((*never)[i], object.at("never") + "/" + std::to_string(i), spec.part.flips, context));
  }
  if (const Json* bounds = object.find("require")) read_bounds(*bounds, spec.bounds, context.issues);
  object.finish();
}

void read_assembly_uncertainty(const Json* value, assembly::AssemblySpec& spec, ReadContext& context) {
  if (!value) return;
  ShapeUncertainty& uncertainty = spec.uncertainty;
  ObjectReader object(*value, "/uncertainty", context.issues);
  uncertainty.outline_mm = object.number_or("outline_mm", kNotNegative, 0);
  uncertainty.feature_mm = object.number_or("feature_mm", kNotNegative, 0);
  uncertainty.centre_mm = object.number_or("center_mm", kNotNegative, 0);
  std::vector<std::string> keys{"friction"};
  for (const char* key : {"kx_n_per_mm", "ky_n_per_mm", "ktheta_nmm_per_rad"})
    if (!spec.support.damper) keys.push_back(key);
  for (const char* key : {"bx_ns_per_mm", "by_ns_per_mm", "btheta_nmms_per_rad"})
    if (spec.support.damper) keys.push_back(key);
  for (const std::string& key : keys) {
    const Json* given = object.find(key);
    if (!given) continue;
    if (uncertainty.intervals.count(key))
      context.issues.add(object.at(key), "an interval that the environment gives, too", "one of them");
    const auto interval =
        read_interval(*given, object.at(key), key == "friction" ? kFriction : kPositive, context.issues);
    if (interval) uncertainty.intervals[key] = *interval;
  }
  object.finish();
}

assembly::DesignSpec read_fixed_shapes(const Json& value, const std::string& pointer,
                                       const std::vector<std::string>& ignored, ReadContext& context) {
  assembly::DesignSpec design;
  ObjectReader object(value, pointer, context.issues);
  const Json* shapes = object.require("fixed_mm", "an array of polygons");
  if (const Json* chamfer = object.find("chamfer_mm"))
    design.chamfer_mm = read_expression(*chamfer, object.at("chamfer_mm"), context.names, context.issues);
  object.ignore(ignored);
  object.finish();
  if (!shapes) return design;
  const std::string at = object.at("fixed_mm");
  if (shapes->is_array() && shapes->empty()) context.issues.add(at, described(*shapes), "at least one polygon");
  design.fixed_mm = read_loops(shapes, at, context);
  for (std::size_t i = 0; i < design.fixed_mm.size(); ++i) {
    const AffineLoop& shape = design.fixed_mm[i];
    if (shape.empty() || !is_literal(shape)) continue;
    if (const auto found = defect(normalised({constant_loop(shape), {}})))
      context.issues.add(at + "/" + std::to_string(i), *found, "a simple polygon with area");
  }
  return design;
}

}  // namespace formotion
