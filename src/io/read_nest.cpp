#include "io/read_nest.hpp"

#include <algorithm>

#include "io/read_asked.hpp"
#include "io/suggestion.hpp"

namespace formotion {
namespace {

using Json = nlohmann::ordered_json;

constexpr Range kShare{0, 1, false};

void read_table(const Json& value, nest::NestSpec& spec, ReadContext& context) {
  ObjectReader object(value, "/environment/table", context.issues);
  nest::TableSpec table;
  table.amplitude_mm = object.required_number("amplitude_mm", kNotNegative, "how far the table moves either way");
  table.frequency_hz = object.required_number("frequency_hz", kPositive);
  table.restitution = required_uncertain(object, "restitution", kShare, spec.uncertainty, context);
  object.finish();
  spec.environment.table = table;
}

nest::SeatSpec read_seat(const Json& value, const PartSpec& part, ReadContext& context) {
  ObjectReader object(value, "/goal/seat", context.issues);
  nest::SeatSpec seat;
  std::vector<std::string> aspects;
  for (const AspectSpec& aspect : part.aspects) aspects.push_back(aspect.name);
  const auto aspect = object.string("aspect");
  if (!aspect && aspects.size() > 1 && object.valid() && !value.contains("aspect"))
    context.issues.add(object.at("aspect"), "nothing", "one of " + list(aspects));
  if (!aspects.empty()) seat.aspect = aspect.value_or(aspects.front());
  if (aspect && std::find(aspects.begin(), aspects.end(), *aspect) == aspects.end()) {
    context.issues.add(object.at("aspect"), "the unknown aspect '" + *aspect + "'" + did_you_mean(*aspect, aspects),
                       "one of " + list(aspects));
  }
  seat.at_mm = {object.expression("x_mm", context.names), object.expression("y_mm", context.names)};
  seat.orientation_rad = radians(object.required_number("orientation_deg", kTurn_deg));
  seat.within_mm = object.number_or("within_mm", kPositive, seat.within_mm);
  object.finish();
  return seat;
}

}  // namespace

void read_nest_environment(const Json* value, nest::NestSpec& spec, ReadContext& context) {
  if (!value) return;
  const bool is_pallet = spec.purpose == nest::Purpose::Pallet;
  nest::Environment& environment = spec.environment;
  ObjectReader object(*value, "/environment", context.issues);
  environment.gravity_deg =
      read_uncertain(object, "gravity_deg", kTurn_deg, environment.gravity_deg, spec.uncertainty, context);
  environment.friction = read_uncertain(object, "friction", kFriction, environment.friction, spec.uncertainty, context);
  if (is_pallet) {
    environment.tilt_deg = read_uncertain(object, "tilt_deg", {-90, 90, false}, {}, spec.uncertainty, context);
    if (const Json* table = object.find("table")) read_table(*table, spec, context);
  } else {
    environment.restitution =
        read_uncertain(object, "restitution", kShare, environment.restitution, spec.uncertainty, context);
  }
  object.finish();
}

void read_nest_goal(const Json& value, nest::NestSpec& spec, ReadContext& context) {
  ObjectReader object(value, "/goal", context.issues);
  if (const Json* seat = object.require("seat", "a seat {\"aspect\", \"x_mm\", \"y_mm\", \"orientation_deg\"}"))
    spec.goal.seat = read_seat(*seat, spec.part, context);
  if (const Json* starts = object.find("starts"))
    spec.goal.starts = read_starts(*starts, object.at("starts"), context.issues);
  std::vector<std::string> metrics;
  for (const Objective& objective : nest::known_objectives(spec.purpose)) metrics.push_back(objective.name);
  if (const Json* bounds = object.find("require")) spec.bounds = read_bounds(*bounds, metrics, context.issues);
  object.finish();
}

void read_nest_uncertainty(const Json* value, nest::NestSpec& spec, ReadContext& context) {
  if (!value) return;
  std::vector<std::pair<std::string, Range>> keys{
      {"friction", kFriction}, {"gravity_deg", kTurn_deg}, {"restitution", kShare}};
  if (spec.purpose == nest::Purpose::Pallet) keys.emplace_back("tilt_deg", Range{-90, 90, false});
  read_shape_uncertainty(*value, "com_mm", keys, spec.uncertainty, context);
}

nest::DesignSpec read_nest_shapes(const Json& value, const std::string& pointer,
                                  const std::vector<std::string>& ignored, ReadContext& context) {
  nest::DesignSpec design;
  ObjectReader object(value, pointer, context.issues);
  design.nest_mm = read_shapes(object, "nest_mm", context);
  object.ignore(ignored);
  object.finish();
  return design;
}

}  // namespace formotion
