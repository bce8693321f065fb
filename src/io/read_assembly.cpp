#include "io/read_assembly.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "io/read_asked.hpp"
#include "io/suggestion.hpp"

namespace formotion {
namespace {

using Json = nlohmann::ordered_json;
constexpr Range kTilt{0, 180, false};

const std::vector<std::string> kMetrics{"success_fraction", "capture_mm",      "capture_deg", "peak_force_n",
                                        "work_nmm",         "depth_margin_mm", "chamfer_mm",  "peak_lateral_force_n"};

void read_support(const Json& value, const std::string& pointer, assembly::AssemblySpec& spec, ReadContext& context) {
  assembly::SupportSpec& support = spec.support;
  ObjectReader object(value, pointer, context.issues);
  support.kx =
      required_uncertain(object, support.damper ? "bx_ns_per_mm" : "kx_n_per_mm", kPositive, spec.uncertainty, context);
  support.ky =
      required_uncertain(object, support.damper ? "by_ns_per_mm" : "ky_n_per_mm", kPositive, spec.uncertainty, context);
  support.ktheta = required_uncertain(object, support.damper ? "btheta_nmms_per_rad" : "ktheta_nmm_per_rad", kPositive,
                                      spec.uncertainty, context);
  // Along both axes alike: the motion that is followed is that of one translational damping (damped_insertion.hpp).
  if (support.damper && object.valid()) {
    const auto same = [](const Number& a, const Number& b) {
      return a.value.constant == b.value.constant && a.value.terms == b.value.terms && a.interval == b.interval;
    };
    if (!same(support.kx, support.ky)) context.issues.add(pointer, "bx and by that differ", "the same value for both");
    spec.uncertainty.intervals.erase("by_ns_per_mm");  // goes with bx
  }
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
  never.orientation_rad = radians(object.required_number("orientation_deg", kTurn_deg));
  if (const Json* starts = object.find("starts"))
    never.starts = read_starts(*starts, object.at("starts"), context.issues);
  object.finish();
  return never;
}

}  // namespace

assembly::PartSpec read_assembly_part(const Json& value, ReadContext& context) {
  ObjectReader object(value, "/part", context.issues);
  feeder::AspectSpec drawn;
  const std::optional<double> thickness = object.number("thickness_mm", kPositive);
  drawn.height_mm = thickness.value_or(0);
  if (value.is_object() && value.contains("layers"))
    context.issues.add("/part/layers", "layers", "one outline: an assembly is planar");
  read_outlines(object, value, drawn, context);
  const bool flips = object.boolean_or("flips", false);
  object.finish();
  return {drawn.outline_mm, drawn.holes_mm, flips, drawn.com_mm, thickness};
}

void read_assembly_environment(const Json* value, assembly::AssemblySpec& spec, ReadContext& context) {
  const Number usual{{0.2, {}}, {}};
  spec.friction = usual;
  if (!value) {
    context.issues.add("/environment", "nothing", "an object with compliance or damper, and approach");
    return;
  }
  ObjectReader object(*value, "/environment", context.issues);
  spec.friction = read_uncertain(object, "friction", kFriction, usual, spec.uncertainty, context);
  const Json* spring = object.find("compliance");
  const Json* damper = object.find("damper");
  if (object.valid() && (spring != nullptr) == (damper != nullptr)) {
    context.issues.add("/environment", spring ? "both compliance and damper" : "neither compliance nor damper",
                       "exactly one of compliance and damper");
  }
  spec.support.damper = !spring && damper;
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
  if (const Json* bounds = object.find("require")) spec.bounds = read_bounds(*bounds, kMetrics, context.issues);
  object.finish();
}

void read_assembly_uncertainty(const Json* value, assembly::AssemblySpec& spec, ReadContext& context) {
  if (!value) return;
  std::vector<std::pair<std::string, Range>> keys{{"friction", kFriction}};
  for (const char* key : {"kx_n_per_mm", "ky_n_per_mm", "ktheta_nmm_per_rad"})
    if (!spec.support.damper) keys.emplace_back(key, kPositive);
  for (const char* key : {"bx_ns_per_mm", "btheta_nmms_per_rad"})  // bx: of both
    if (spec.support.damper) keys.emplace_back(key, kPositive);
  read_shape_uncertainty(*value, "center_mm", keys, spec.uncertainty, context);
}

assembly::DesignSpec read_fixed_shapes(const Json& value, const std::string& pointer,
                                       const std::vector<std::string>& ignored, ReadContext& context) {
  assembly::DesignSpec design;
  ObjectReader object(value, pointer, context.issues);
  design.fixed_mm = read_shapes(object, "fixed_mm", context);
  if (const Json* chamfer = object.find("chamfer_mm"))
    design.chamfer_mm = read_expression(*chamfer, object.at("chamfer_mm"), context.names, context.issues);
  object.ignore(ignored);
  object.finish();
  return design;
}

}  // namespace formotion
