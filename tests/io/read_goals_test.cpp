// Goals on configurations and facets as problem files have them.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <numbers>

#include "io/feeder_json.hpp"
#include "io/problem_file.hpp"

using namespace formotion;
using Json = nlohmann::ordered_json;

namespace {

Json problem(const Json& goal) {
  Json document = Json::parse(R"({
    "formotion": 1, "name": "el", "kind": "feeder",
    "part": {"outline_mm": [[0,0],[30,0],[30,10],[10,10],[10,20],[0,20]], "thickness_mm": 3, "flips": true},
    "environment": {"track_width_mm": 40},
    "variables": {"h": {"min": 2, "max": 20, "value": 12}},
    "design": {"features": [{"type": "fence", "polygon_mm": [[0, -2], [30, -2], [30, "h"]]}]},
    "goal": {"deliver": "one pose"}
  })");
  document["goal"].update(goal);
  return document;
}

std::vector<InputIssue> issues_of(const Json& goal) {
  try {
    parse_problem(problem(goal).dump(), "p.json");
  } catch (const InputError& error) { return error.issues; }
  return {};
}

const Json kConfiguration =
    Json::parse(R"({"aspect": "down", "q": {"x_mm": 5, "y_mm": 7.5, "theta_deg": 90}, "must": "blocked", "by_mm": 2})");
const Json kFacet =
    Json::parse(R"({"aspect": "up", "type": "EV", "moving": 0, "fixed": [1, 2], "theta_deg": 0, "outward_mm": 3})");

Json with(Json goal, const std::string& key, const Json& value) {
  goal[key] = value;
  return goal;
}

}  // namespace

TEST_CASE("goals on configurations and facets are read as they stand") {
  const ProblemFile file =
      parse_problem(problem({{"configurations", {kConfiguration}}, {"facets", {kFacet}}}).dump(), "p.json");
  const feeder::Goal& goal = file.feeder.goal;
  REQUIRE(goal.configurations.size() == 1);
  CHECK(goal.configurations[0].aspect == 1);
  CHECK(goal.configurations[0].must == feeder::Must::Blocked);
  CHECK(goal.configurations[0].q.theta_rad == Approx(std::numbers::pi / 2));
  CHECK(goal.configurations[0].by_mm == 2);
  REQUIRE(goal.facets.size() == 1);
  CHECK(goal.facets[0].edge_moves);
  CHECK(goal.facets[0].component == 1);
  CHECK(goal.facets[0].fixed == 2);
  // The middle of the bottom edge on the ramp's tip, (30, 12); the centre of mass is 2.5 mm before it and 7.5 above.
  CHECK(goal.facets[0].reference.x_mm == Approx(27.5));
  CHECK(goal.facets[0].reference.y_mm == Approx(19.5));
}

TEST_CASE("each kind of bad goal is one issue at its place") {
  struct Bad {
    std::string list;
    Json goal;
    std::string where, words;
  };
  const std::vector<Bad> all{
      {"configurations", with(kConfiguration, "must", "free!"), "/goal/configurations/0/must", "one of free"},
      {"configurations", with(kConfiguration, "aspect", "upp"), "/goal/configurations/0/aspect", "did you mean 'up'"},
      {"configurations", with(kConfiguration, "by_mm", -1), "/goal/configurations/0/by_mm", "-1"},
      {"configurations", with(kConfiguration, "q", 3), "/goal/configurations/0/q", "object"},
      {"facets", with(kFacet, "type", "VV"), "/goal/facets/0/type", "one of VE, EV"},
      {"facets", with(kFacet, "fixed", 1), "/goal/facets/0/fixed", "[component, number]"},
      {"facets", with(kFacet, "fixed", {2, 0}), "/goal/facets/0", "not there"},
      {"facets", with(kFacet, "fixed", {1, 3}), "/goal/facets/0", "not there"},
      {"facets", with(kFacet, "moving", 6), "/goal/facets/0", "not there"},
      {"facets", with(kFacet, "moving", 0.5), "/goal/facets/0/moving", "whole number"},
      {"facets", with(kFacet, "theta_deg", 180), "/goal/facets/0", "cannot touch"},
  };
  for (const Bad& bad : all) {
    CAPTURE(bad.list, bad.goal.dump());
    const std::vector<InputIssue> issues = issues_of({{bad.list, {bad.goal}}});
    REQUIRE(issues.size() == 1);
    CHECK(issues[0].where == bad.where);
    CHECK((issues[0].found + " " + issues[0].expected).find(bad.words) != std::string::npos);
  }
}

TEST_CASE("an evaluation lists its goals only where the problem has some") {
  const auto evaluated = [](const Json& goal) {
    const feeder::FeederProblem made(parse_problem(problem(goal).dump(), "p.json").feeder);
    const std::vector<double> values{14};
    return evaluation_json(made, 0, values, made.evaluate(0, values));
  };
  CHECK_FALSE(evaluated(Json::object()).contains("goals"));
  const Json goals = evaluated({{"facets", {kFacet}}})["goals"];
  REQUIRE(goals.size() == 1);
  CHECK(goals[0]["must"] == "outward");
  CHECK(goals[0]["asked_mm"] == 3);
  CHECK(goals[0]["got_mm"].get<double>() == Approx(2));
}
