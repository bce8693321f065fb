#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "applications/feeder/expressions.hpp"
#include "io/problem_file.hpp"

using namespace formotion;
using Json = nlohmann::ordered_json;

namespace {

Json good() {
  return Json::parse(R"({
    "formotion": 1, "name": "el", "kind": "feeder",
    "part": {"outline_mm": [[0,0],[30,0],[30,10],[10,10],[10,20],[0,20]], "thickness_mm": 3, "flips": true},
    "environment": {"track_width_mm": 40},
    "grammar": {"features": ["balcony", "cutout"], "max_features": 2},
    "goal": {"deliver": "one pose"}
  })");
}

std::vector<InputIssue> issues_of(const Json& document) {
  try {
    parse_problem(document.dump(), "p.json");
  } catch (const InputError& error) { return error.issues; }
  return {};
}

bool says(const std::vector<InputIssue>& issues, const std::string& where, const std::string& words) {
  for (const InputIssue& issue : issues) {
    if (issue.where == where && to_line(issue).find(words) != std::string::npos) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("a grammar is read in place of designs and stays as it was written") {
  const ProblemFile file = parse_problem(good().dump(), "p.json");
  REQUIRE(file.feeder.grammar);
  CHECK(file.feeder.grammar->sequences == 5 + 25);
  CHECK(file.feeder.grammar->pruned.size() == 1);
  CHECK(file.feeder.designs.size() == 28);  // without balconies alone
  CHECK(Json::parse(file.canonical)["grammar"] == good()["grammar"]);
  CHECK_FALSE(Json::parse(file.canonical).contains("variables"));
  // The problem as run is the same problem again.
  const ProblemFile again = parse_problem(file.canonical, "p.json");
  REQUIRE(again.feeder.variables.size() == file.feeder.variables.size());
  for (std::size_t i = 0; i < again.feeder.variables.size(); ++i) {
    CHECK(again.feeder.variables[i].name == file.feeder.variables[i].name);
    CHECK(again.feeder.variables[i].min == file.feeder.variables[i].min);
    CHECK(again.feeder.variables[i].max == file.feeder.variables[i].max);
    CHECK(again.feeder.variables[i].value == file.feeder.variables[i].value);
  }
  CHECK(topologies_of(again.feeder).back().label == topologies_of(file.feeder).back().label);
}

TEST_CASE("everything wrong with a grammar is said at once") {
  Json bad = good();
  bad["grammar"] =
      Json::parse(R"({"features": ["balcny", "gap", "gap", "cutout4", "cutout", "drawing", 3], "max_feature": 2})");
  const auto issues = issues_of(bad);
  CHECK(says(issues, "/grammar/features/0", "did you mean 'balcony'"));
  CHECK(says(issues, "/grammar/features/2", "'gap' again"));
  CHECK(says(issues, "/grammar/features/4", "'cutout' again"));
  CHECK(says(issues, "/grammar/features/5", "a drawing"));
  CHECK(says(issues, "/grammar/features/6", "3"));
  CHECK(says(issues, "/grammar/max_feature", "did you mean 'max_features'"));
  CHECK(says(issues, "/grammar/max_features", "a whole number from 1"));
  for (const char* number : {"0", "-1", "1.5", "13", "\"2\"", "null", "[2]"}) {
    Json wrong = good();
    wrong["grammar"]["max_features"] = Json::parse(number);
    CAPTURE(number);
    CHECK(says(issues_of(wrong), "/grammar/max_features", "a whole number from 1 to 12"));
  }
  for (const char* features : {"[]", "{}", "\"balcony\"", "null"}) {
    Json wrong = good();
    wrong["grammar"]["features"] = Json::parse(features);
    CHECK(says(issues_of(wrong), "/grammar/features", "an array"));
  }
  for (const char* grammar : {"[]", "3", "null"}) {
    Json wrong = good();
    wrong["grammar"] = Json::parse(grammar);
    CHECK_FALSE(issues_of(wrong).empty());
  }
}

TEST_CASE("a design and a grammar together are an error and so is a variable that no topology has") {
  Json both = good();
  both["design"] = Json::parse(R"({"features": [{"type": "gap", "length_mm": 3}]})");
  CHECK(says(issues_of(both), "", "more than one"));
  Json misspelt = good();
  misspelt["variables"] = Json::parse(R"({"f0.widht_mm": {"min": 1, "max": 2}, "f2.width_mm": {"min": 1, "max": 2}})");
  const auto issues = issues_of(misspelt);
  CHECK(says(issues, "/variables/f0.widht_mm", "did you mean 'f0.width_mm'"));
  CHECK(says(issues, "/variables/f2.width_mm", "did you mean"));
}

TEST_CASE("a grammar that cannot reach the goal is an error that says what would help") {
  Json hopeless = good();
  hopeless["grammar"]["features"] = {"balcony", "gap"};
  const auto issues = issues_of(hopeless);
  CHECK(says(issues, "/grammar/features", "mirror images"));
  CHECK(says(issues, "/grammar/features", "one more feature: cutout"));
}

TEST_CASE("the part of a grammar may have variables and then nothing is pruned") {
  Json open = good();
  open["part"]["outline_mm"][1][0] = "long";
  open["part"]["outline_mm"][2][0] = "long";
  open["variables"] = Json::parse(R"({"long": {"min": 25, "max": 35}})");
  const ProblemFile file = parse_problem(open.dump(), "p.json");
  CHECK(file.feeder.designs.size() == 30);
  CHECK(file.feeder.grammar->pruned.empty());
}
