#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "io/patched.hpp"
#include "io/problem_file.hpp"

using namespace formotion;
using Json = nlohmann::ordered_json;

namespace {

const char* const kGood = R"({
  "formotion": 1, "name": "peg", "kind": "assembly",
  "part": {"outline_mm": [[-5,0],[5,0],[5,30],[-5,30]], "flips": true},
  "environment": {
    "friction": [0.1, 0.3],
    "compliance": {"kx_n_per_mm": 2, "ky_n_per_mm": 8, "ktheta_nmm_per_rad": "100*c", "center_mm": [0, "c"]},
    "approach": {"distance_mm": 25, "max_force_n": 50}},
  "variables": {"c": {"min": 0, "max": 20}, "w": {"min": 0, "max": 4, "value": 2}},
  "design": {"fixed_mm": [[[-40,-30],[-5.1,-30],[-5.1,"-2-w"],["-7-w",-2],[-40,-2]], [[5.1,-30],[40,-30],[40,-2],[5.1,-2]]],
             "chamfer_mm": "w"},
  "goal": {"depth_mm": 20, "lateral_mm": 0.5, "tilt_deg": 2, "starts": {"x_mm": [-2, 2], "theta_deg": [-3, 3]},
           "never": [{"aspect": "down", "orientation_deg": 180}], "require": {"success_fraction": {"min": 1}}},
  "uncertainty": {"center_mm": 0.5, "kx_n_per_mm": [1, 3]}
})";

std::string patched(const std::string& pointer, const std::string& value) {
  return formotion::patched(kGood, pointer, value);
}

}  // namespace

TEST_CASE("a good assembly is read as it stands") {
  const ProblemFile file = parse_problem(kGood, "p.json");
  CHECK(file.kind == "assembly");
  REQUIRE(file.assembly);
  const assembly::AssemblySpec& spec = *file.assembly;
  const std::vector<double> values{10, 2};
  CHECK(spec.part.flips);
  CHECK(spec.friction.value.constant == Approx(0.2));
  CHECK(spec.uncertainty.intervals.at("friction") == std::pair(0.1, 0.3));
  CHECK(spec.uncertainty.intervals.at("kx_n_per_mm") == std::pair(1.0, 3.0));
  CHECK(spec.uncertainty.centre_mm == 0.5);
  CHECK_FALSE(spec.support.damper);
  CHECK_FALSE(spec.support.centre_is_centroid);
  CHECK(spec.support.ktheta.value(values) == 1000);
  CHECK(spec.support.centre_mm[1](values) == 10);
  CHECK(spec.approach.direction_rad == Approx(-std::numbers::pi / 2));
  CHECK(spec.approach.max_force_n == 50.0);
  REQUIRE(spec.designs.size() == 1);
  REQUIRE(spec.designs[0].fixed_mm.size() == 2);
  CHECK(spec.designs[0].fixed_mm[0][2][1](values) == -4);
  REQUIRE(spec.designs[0].chamfer_mm);
  CHECK((*spec.designs[0].chamfer_mm)(values) == 2);
  CHECK(spec.goal.starts.x_mm.min == -2);
  CHECK(spec.goal.starts.y_mm.is_single());
  CHECK(spec.goal.starts.theta_rad.max == Approx(3 * std::numbers::pi / 180));
  REQUIRE(spec.goal.never.size() == 1);
  CHECK(spec.goal.never[0].aspect == "down");
  REQUIRE(spec.bounds.size() == 1);
  CHECK(spec.bounds[0].min == 1.0);
  REQUIRE(spec.objectives.size() == 3);
  CHECK(spec.objectives[0].name == "success_fraction");
}

TEST_CASE("the canonical assembly is a problem, and its own canonical form") {
  const ProblemFile file = parse_problem(kGood, "p.json");
  CHECK(parse_problem(file.canonical, "q.json").canonical == file.canonical);
}

TEST_CASE("each kind of bad assembly is one issue, at its place, in words") {
  const std::vector<Bad> all{
      {"/part/outline_mm", "[[0,0],[10,10],[10,0],[0,10]]", "/part/outline_mm", "simple polygon"},
      {"/part/flips", "false", "/goal/never/0/aspect", "does not flip"},
      {"/environment/frictoin", "0.2", "/environment/frictoin", "did you mean 'friction'"},
      {"/environment/compliance/kx_n_per_mm", "0", "/environment/compliance/kx_n_per_mm", "above 0"},
      {"/environment/compliance/kx_n_per_mm", "[3, 1]", "/environment/compliance/kx_n_per_mm", "min not above max"},
      {"/environment/compliance/center_mm", "[0]", "/environment/compliance/center_mm", "a point"},
      {"/environment/damper", "{}", "/environment", "exactly one of compliance and damper"},
      {"/environment/approach/distance_mm", "~", "/environment/approach/distance_mm", "how far"},
      {"/design", "~", "", "exactly one of design and topologies"},
      {"/design/fixed_mm/1", "[[0,0],[10,10],[10,0],[0,10]]", "/design/fixed_mm/1", "simple polygon"},
      {"/design/fixed_mm/1/0/0", "\"v + 1\"", "/design/fixed_mm/1/0/0", "v"},
      {"/grammar", "{\"features\": []}", "/grammar", "grammars are of tracks"},
      {"/goal/depth_mm", "~", "/goal/depth_mm", "the depth"},
      {"/goal/never/0/aspect", "\"dwon\"", "/goal/never/0/aspect", "did you mean 'down'"},
      {"/goal/require", "{\"capture\": {\"min\": 1}}", "/goal/require/capture", "unknown key"},
      {"/goal/require/success_fraction", "{}", "/goal/require/success_fraction", "neither min nor max"},
      {"/uncertainty/friction", "[0, 1]", "/uncertainty/friction", "one of them"},
      {"/uncertainty/bx_ns_per_mm", "[1, 2]", "/uncertainty/bx_ns_per_mm", "unknown key"},
      {"/variables/z", "{\"min\": 0, \"max\": 1}", "/variables/z", "nothing uses"},
      {"/search", "{\"objectives\": [\"efficiency\"]}", "/search/objectives/0", "unknown objective"},
  };
  for (const Bad& bad : all) {
    INFO(bad.pointer << " = " << bad.value);
    const std::vector<InputIssue> issues = issues_of(patched(bad.pointer, bad.value));
    REQUIRE_FALSE(issues.empty());
    for (const InputIssue& issue : issues) INFO(to_line(issue));
    CHECK(issues.size() == (bad.pointer == "/design" ? 2u : 1u));  // without a design nothing uses w
    CHECK(issues[0].where == bad.where);
    CHECK(to_line(issues[0]).find(bad.words) != std::string::npos);
  }
}

TEST_CASE("all errors of an assembly come at once") {
  Json document = Json::parse(kGood);
  document["environment"]["approach"].erase("distance_mm");
  document["goal"]["tilt_deg"] = "steep";
  document["part"]["outline_mm"] = Json::array();
  CHECK(issues_of(document.dump()).size() == 3);
}

TEST_CASE("a damper is read with its speed") {
  const ProblemFile file = parse_problem(formotion::patched(patched("/uncertainty", "~"), "/environment", R"({
    "damper": {"bx_ns_per_mm": [1, 3], "by_ns_per_mm": [1, 3], "btheta_nmms_per_rad": 400, "center_mm": [1, "c"]},
    "approach": {"distance_mm": 9, "speed_mm_s": 5}})"),
                                         "p.json");
  REQUIRE(file.assembly);
  const assembly::AssemblySpec& spec = *file.assembly;
  const std::vector<double> values{10, 2};
  CHECK(spec.support.damper);
  CHECK(spec.support.kx.value(values) == 2);
  CHECK(spec.support.ky.value(values) == 2);
  CHECK(spec.support.ktheta.value(values) == 400);
  CHECK(spec.support.centre_mm[0](values) == 1);
  CHECK(spec.approach.speed_mm_s == 5);
  CHECK(spec.uncertainty.intervals.at("bx_ns_per_mm") == std::pair(1.0, 3.0));
  CHECK(spec.uncertainty.intervals.count("by_ns_per_mm") == 0);  // goes with bx
}

TEST_CASE("a damper of different bx and by is refused in words") {
  for (const char* by : {"2", "[0.5, 1.5]"}) {
    const std::string damped = patched("/environment", std::string(R"({
      "damper": {"bx_ns_per_mm": 1, "by_ns_per_mm": )") + by +
                                                           R"(, "btheta_nmms_per_rad": 1},
      "approach": {"distance_mm": 9}})");
    const std::vector<InputIssue> issues = issues_of(damped);
    const auto said = std::find_if(issues.begin(), issues.end(),
                                   [](const InputIssue& issue) { return issue.where == "/environment/damper"; });
    REQUIRE(said != issues.end());
    CHECK(said->found == "bx and by that differ");
    CHECK(said->expected == "the same value for both");
  }
}
