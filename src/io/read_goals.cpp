// Goals on motion constraints: configurations and facets.
#include <cmath>
#include <map>
#include <numbers>

#include "io/problem_reader.hpp"
#include "io/suggestion.hpp"

namespace formotion {
namespace {

using Json = nlohmann::ordered_json;
constexpr Range kTurn{-3600, 3600, false};
constexpr double kMostFeatures = 1e6;

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

std::string list(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

// The place of a required word among those that are known; 0 where it is none.
int read_word(ObjectReader& object, const std::string& key, const std::vector<std::string>& known,
              ReadContext& context) {
  object.require(key, "one of " + list(known));
  const auto word = object.string(key);
  if (!word) return 0;
  const auto found = std::find(known.begin(), known.end(), *word);
  if (found != known.end()) return static_cast<int>(found - known.begin());
  context.issues.add(object.at(key), "'" + *word + "'" + did_you_mean(*word, known), "one of " + list(known));
  return 0;
}

int read_aspect(ObjectReader& object, const feeder::PartSpec& part, ReadContext& context) {
  std::vector<std::string> names;
  for (const feeder::AspectSpec& aspect : part.aspects) names.push_back(aspect.name);
  if (names.empty() || (names.size() == 1 && !object.find("aspect"))) return 0;
  return read_word(object, "aspect", names, context);
}

int read_index(const Json& value, const std::string& pointer, ReadContext& context) {
  const auto number = read_number(value, pointer, {0, kMostFeatures, false}, context.issues);
  if (number && *number != std::floor(*number)) context.issues.add(pointer, described(value), "a whole number");
  return static_cast<int>(number.value_or(0));
}

feeder::ConfigurationGoal read_configuration_goal(const Json& value, const std::string& pointer,
                                                  const feeder::PartSpec& part, ReadContext& context) {
  feeder::ConfigurationGoal goal;
  ObjectReader object(value, pointer, context.issues);
  goal.aspect = read_aspect(object, part, context);
  if (const Json* q = object.require("q", "a configuration {\"x_mm\", \"y_mm\", \"theta_deg\"}")) {
    ObjectReader at(*q, object.at("q"), context.issues);
    goal.q.x_mm = at.required_number("x_mm", kAny);
    goal.q.y_mm = at.required_number("y_mm", kAny);
    goal.q.theta_rad = radians(at.required_number("theta_deg", kTurn));
    at.finish();
  }
  goal.must =
      static_cast<feeder::Must>(read_word(object, "must", {"free", "blocked", "supported", "unsupported"}, context));
  goal.by_mm = object.number_or("by_mm", kNotNegative, 0);
  object.finish();
  return goal;
}

feeder::FacetGoal read_facet_goal(const Json& value, const std::string& pointer, const feeder::PartSpec& part,
                                  ReadContext& context) {
  feeder::FacetGoal goal;
  ObjectReader object(value, pointer, context.issues);
  goal.aspect = read_aspect(object, part, context);
  goal.edge_moves = read_word(object, "type", {"VE", "EV"}, context) == 1;
  if (const Json* moving = object.require("moving", "the number of a corner or an edge of the part"))
    goal.moving = read_index(*moving, object.at("moving"), context);
  if (const Json* fixed = object.require("fixed", "[component, number]")) {
    if (fixed->is_array() && fixed->size() == 2) {
      goal.component = read_index((*fixed)[0], object.at("fixed/0"), context);
      goal.fixed = read_index((*fixed)[1], object.at("fixed/1"), context);
    } else {
      context.issues.add(object.at("fixed"), described(*fixed), "[component, number]");
    }
  }
  goal.theta_rad = radians(object.required_number("theta_deg", kTurn));
  goal.outward_mm = object.required_number("outward_mm", kAny);
  object.finish();
  return goal;
}

template <class Read>
void read_each(const Json* value, const std::string& pointer, const std::string& what, ReadContext& context,
               const Read& read) {
  if (!value) return;
  if (!value->is_array()) return context.issues.add(pointer, described(*value), "an array of " + what);
  for (std::size_t i = 0; i < value->size(); ++i) read((*value)[i], pointer + "/" + std::to_string(i));
}

}  // namespace

void read_constraint_goals(ObjectReader& object, const feeder::PartSpec& part, feeder::Goal& goal,
                           ReadContext& context) {
  read_each(object.find("configurations"), object.at("configurations"), "configurations", context,
            [&](const Json& value, const std::string& at) {
              goal.configurations.push_back(read_configuration_goal(value, at, part, context));
            });
  read_each(object.find("facets"), object.at("facets"), "facets", context,
            [&](const Json& value, const std::string& at) {
              goal.facets.push_back(read_facet_goal(value, at, part, context));
            });
}

}  // namespace formotion
