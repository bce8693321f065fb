#include <cmath>
#include <numbers>

#include "io/problem_reader.hpp"

namespace formotion {
namespace {

using Json = nlohmann::ordered_json;
constexpr Range kAngle{-360, 360, false};
constexpr Range kFriction{0, 10, false};

// Environment numbers that may be uncertain.
const std::vector<std::pair<std::string, Range>> kIntervals{
    {"wall_friction", kFriction},        {"drive_deg", kAngle},
    {"tilt_deg", {-60, 60, false}},      {"settling_friction", kFriction},
    {"conveying_speed_mm_s", kPositive},
};

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

}  // namespace

feeder::Environment read_environment(const Json* value, ReadContext& context) {
  feeder::Environment environment;
  if (!value) {
    context.issues.add("/environment", "nothing", "an object with track_width_mm");
    return environment;
  }
  ObjectReader object(*value, "/environment", context.issues);
  environment.track_width_mm = object.required_number("track_width_mm", kPositive, "the track's width");
  environment.wall_friction = object.number_or("wall_friction", kFriction, environment.wall_friction);
  environment.drive_rad = radians(object.number_or("drive_deg", kAngle, -30));
  environment.conveying_speed_mm_s =
      object.number_or("conveying_speed_mm_s", kPositive, environment.conveying_speed_mm_s);
  environment.tilt_rad = radians(object.number_or("tilt_deg", {-60, 60, false}, 0));
  environment.spacing_mm = object.number("spacing_mm", kNotNegative);
  environment.settling_friction = object.number_or("settling_friction", kFriction, 0);
  if (const Json* mobility = object.find("mobility")) {
    ObjectReader inner(*mobility, object.at("mobility"), context.issues);
    environment.radius_of_gyration_mm = inner.number("radius_of_gyration_mm", kPositive);
    inner.finish();
  }
  environment.start_y_mm = object.number("start_y_mm", kPositive);
  object.finish();
  return environment;
}

feeder::Goal read_goal(const Json& value, const feeder::PartSpec& part, ReadContext& context) {
  feeder::Goal goal;
  ObjectReader object(value, "/goal", context.issues);
  goal.require_tip = object.boolean_or("require_tip", false);
  goal.within_rad = radians(object.number_or("within_deg", {0, 45, false}, 0.01));
  const Json* deliver = object.require("deliver", "a pose {\"aspect\", \"orientation_deg\"} or \"one pose\"");
  read_constraint_goals(object, part, goal, context);
  object.finish();
  if (!deliver) return goal;
  if (deliver->is_string()) {
    goal.one_pose = true;
    if (deliver->get<std::string>() != "one pose")
      context.issues.add("/goal/deliver", described(*deliver), "a pose or \"one pose\"");
    return goal;
  }
  ObjectReader pose(*deliver, "/goal/deliver", context.issues);
  std::vector<std::string> names;
  std::string list = "any";
  for (const feeder::AspectSpec& aspect : part.aspects) {
    names.push_back(aspect.name);
    list += ", " + aspect.name;
  }
  const bool one_aspect = names.size() == 1;
  if (!one_aspect) pose.require("aspect", "one of " + list);
  const auto aspect = pose.string("aspect");
  goal.aspect = aspect.value_or(one_aspect ? names.front() : "any");
  if (aspect && *aspect != "any" && !names.empty() && std::find(names.begin(), names.end(), *aspect) == names.end()) {
    context.issues.add(pose.at("aspect"), "the unknown aspect '" + *aspect + "'", "one of " + list);
  }
  goal.orientation_rad = radians(pose.required_number("orientation_deg", {-3600, 3600, false}));
  pose.finish();
  return goal;
}

feeder::Manufacture read_manufacture(const Json* value, ReadContext& context) {
  feeder::Manufacture manufacture;
  if (!value) return manufacture;
  ObjectReader object(*value, "/manufacture", context.issues);
  manufacture.cutter_radius_mm = object.number("cutter_radius_mm", kNotNegative);
  manufacture.min_web_mm = object.number("min_web_mm", kNotNegative);
  manufacture.plate_mm = object.number("plate_mm", kPositive);
  object.finish();
  return manufacture;
}

feeder::Uncertainty read_uncertainty(const Json* value, ReadContext& context) {
  feeder::Uncertainty uncertainty;
  if (!value) return uncertainty;
  ObjectReader object(*value, "/uncertainty", context.issues);
  uncertainty.outline_mm = object.number_or("outline_mm", kNotNegative, 0);
  uncertainty.com_mm = object.number_or("com_mm", kNotNegative, 0);
  uncertainty.feature_mm = object.number_or("feature_mm", kNotNegative, 0);
  for (const auto& [key, range] : kIntervals) {
    const Json* interval = object.find(key);
    if (!interval) continue;
    if (!interval->is_array() || interval->size() != 2) {
      context.issues.add(object.at(key), described(*interval), "an interval [min, max]");
      continue;
    }
    const auto low = read_number((*interval)[0], object.at(key) + "/0", range, context.issues);
    const auto high = read_number((*interval)[1], object.at(key) + "/1", range, context.issues);
    if (!low || !high) continue;
    if (*low > *high)
      context.issues.add(object.at(key), interval->dump(), "an interval [min, max] with min not above max");
    uncertainty.intervals[key] = {*low, *high};
  }
  object.finish();
  return uncertainty;
}

}  // namespace formotion
