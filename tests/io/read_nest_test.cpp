#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <numbers>

#include "io/patched.hpp"
#include "io/problem_file.hpp"

using namespace formotion;
using Json = nlohmann::ordered_json;

namespace {

const char* const kGood = R"({
  "formotion": 1, "name": "pocket", "kind": "pallet",
  "part": {"outline_mm": [[0,0],[16,0],[16,5],[0,9]], "flips": true},
  "environment": {"gravity_deg": -90, "friction": [0.1, 0.3], "tilt_deg": 5,
                  "table": {"amplitude_mm": 0.5, "frequency_hz": 30, "restitution": [0.2, 0.4]}},
  "variables": {"d": {"min": 2, "max": 12, "value": 9}},
  "design": {"nest_mm": [[[-30,-20],[30,-20],[30,0],[9,0],[9,"-d"],[-9,"-d"],[-9,0],[-30,0]]]},
  "goal": {"seat": {"aspect": "up", "x_mm": 0, "y_mm": "4-d", "orientation_deg": 0},
           "starts": {"x_mm": [-2, 2], "theta_deg": [-30, 30]}, "require": {"selectivity_mm": {"min": 1}}},
  "uncertainty": {"com_mm": 0.5}
})";

std::string patched(const std::string& pointer, const std::string& value) {
  return formotion::patched(kGood, pointer, value);
}

}  // namespace

TEST_CASE("a good pallet is read as it stands") {
  const ProblemFile file = parse_problem(kGood, "p.json");
  REQUIRE(file.nest);
  const nest::NestSpec& spec = *file.nest;
  CHECK(file.kind == "pallet");
  CHECK(spec.purpose == nest::Purpose::Pallet);
  CHECK(spec.part.aspects.size() == 2);
  CHECK(spec.environment.friction.value.constant == Approx(0.2));
  CHECK(spec.environment.tilt_deg.value.constant == 5);
  REQUIRE(spec.environment.table);
  CHECK(spec.environment.table->frequency_hz == 30);
  CHECK(spec.uncertainty.intervals.at("restitution") == std::pair(0.2, 0.4));
  CHECK(spec.uncertainty.centre_mm == 0.5);
  const std::vector<double> values{9};
  CHECK(spec.goal.seat.at_mm[1](values) == -5);
  CHECK(spec.goal.starts.theta_rad.max == Approx(std::numbers::pi / 6));
  CHECK(spec.bounds.size() == 1);
  REQUIRE(spec.objectives.size() == 2);
  CHECK(spec.objectives[0].name == "selectivity_mm");
  CHECK(spec.objectives[1].name == "capture_fraction");
}

TEST_CASE("a fixture takes its own objectives and its defaults") {
  Json document = Json::parse(kGood);
  document["kind"] = "fixture";
  document.erase("environment");
  document.erase("uncertainty");
  document["goal"].erase("require");
  document["goal"].erase("starts");
  const ProblemFile file = parse_problem(document.dump(), "p.json");
  REQUIRE(file.nest);
  CHECK(file.nest->environment.gravity_deg.value.constant == -90);
  CHECK(file.nest->environment.friction.value.constant == 0.2);
  CHECK(file.nest->goal.starts.x_mm.is_single());
  REQUIRE(file.nest->objectives.size() == 2);
  CHECK(file.nest->objectives[0].name == "seated_fraction");
  CHECK(file.nest->objectives[1].name == "repeatability_mm");
}

TEST_CASE("every slip in a nest is said with its place") {
  const std::vector<Bad> bad{
      {"/goal/seat/aspect", "\"upp\"", "/goal/seat/aspect", "did you mean"},
      {"/goal/seat", "~", "/goal/seat", "a seat"},
      {"/goal/seat/aspect", "~", "/goal/seat/aspect", "one of up, down"},
      {"/design/nest_mm/0", "[[0,0],[1,0]]", "/design/nest_mm/0", "three corners"},
      {"/design/nest_mm/0", "[[0,0],[1,1],[1,0],[0,1]]", "/design/nest_mm/0", "a simple polygon"},
      {"/environment/table/restitution", "1.5", "/environment/table/restitution", "1"},
      {"/environment/tilt", "3", "/environment/tilt", "did you mean"},
      {"/search", R"({"objectives": ["selectivity"]})", "/search/objectives/0", "selectivity_mm"},
      {"/grammar", "{}", "/grammar", "grammars are of tracks"},
      {"/variables/e", R"({"min": 0, "max": 1})", "/variables/e", "nothing uses"},
      {"/part/layers", R"([{"from_mm":0,"to_mm":1,"outline_mm":[[0,0],[1,0],[0,1]]}])", "/part", "planar"}};
  for (const Bad& one : bad) {
    CAPTURE(one.pointer, one.value);
    const std::vector<InputIssue> issues = issues_of(patched(one.pointer, one.value));
    REQUIRE(!issues.empty());
    bool said = false;
    for (const InputIssue& issue : issues) {
      const std::string line = issue.found + ", expected " + issue.expected;
      said = said || (issue.where == one.where && line.find(one.words) != std::string::npos);
    }
    CHECK(said);
  }
}
