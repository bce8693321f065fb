#include "io/feeder_json.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "io/problem_file.hpp"

using namespace formotion;

namespace {

const char* const kProblem = R"({
  "formotion": 1, "name": "many features", "kind": "feeder",
  "part": {"outline_mm": [[0,0],[30,0],[30,10],[10,10],[10,20],[0,20]], "thickness_mm": 3, "flips": true},
  "environment": {"track_width_mm": 40, "tilt_deg": 5},
  "variables": {"w": {"min": 6, "max": 20, "value": 9.1}, "a": {"min": 10, "max": 40, "value": 33.3}},
  "design": {"features": [
    {"type": "balcony", "width_mm": "w", "length_mm": 60},
    {"type": "gap", "length_mm": 4},
    {"type": "canyon", "from_mm": 12, "to_mm": "w + 7", "length_mm": 50},
    {"type": "slot", "from_mm": 3, "to_mm": 6, "length_mm": 20, "at_mm": 400},
    {"type": "cutout", "polygon_mm": [[0, 20], ["w", 45], [-3, 45]]},
    {"type": "dish-out", "depth_mm": 5, "length_mm": 33},
    {"type": "scallop", "depth_mm": 7, "half_angle_deg": "a"},
    {"type": "drawing", "voids_mm": [[[0,30],[9,30],[9,45],[0,45]]], "walls_mm": []},
    {"type": "wiper", "height_mm": 4},
    {"type": "hold-down", "height_mm": 3.5, "length_mm": 20},
    {"type": "fence", "polygon_mm": [[0, -1], ["w + 30", 4], [3, "w"]]},
    {"type": "wall", "profile_mm": [[0, 0], [9, "w/3"], [12, -2.5], [15, 0]]},
    {"type": "pin", "x_mm": "w/2", "y_mm": 17.25, "diameter_mm": 4}
  ]},
  "goal": {"deliver": "one pose"}
})";

OrderedJson evaluated_json(const feeder::FeederProblem& problem, int topology, const std::vector<double>& values) {
  return evaluation_json(problem, topology, values, problem.evaluate(topology, values));
}

}  // namespace

TEST_CASE("a design written out and read back scores the same, for every type of feature") {
  ProblemFile file = parse_problem(kProblem, "p.json");
  const feeder::FeederProblem problem(file.feeder);
  const std::vector<double> values{9.1, 33.3};
  const OrderedJson before = evaluated_json(problem, 0, values);

  const std::string path = (std::filesystem::temp_directory_path() / "formotion_design.json").string();
  std::ofstream(path) << OrderedJson{{"features", features_json(problem.literal_design(0, values))},
                                     {"values", values_json(problem, 0, values)}}
                             .dump();
  std::vector<std::pair<std::string, double>> given;
  apply_design_file(file, path, given);
  std::filesystem::remove(path);
  CHECK(given == std::vector<std::pair<std::string, double>>{{"w", 9.1}, {"a", 33.3}});
  const OrderedJson after = evaluated_json(feeder::FeederProblem(file.feeder), 0, values);
  CHECK(after["metrics"] == before["metrics"]);
  CHECK(after["poses"] == before["poses"]);
}

TEST_CASE("an evaluation has the contract's keys, without uncertainty the worst case is the nominal one") {
  ProblemFile file = parse_problem(kProblem, "p.json");
  const feeder::FeederProblem problem(file.feeder);
  const OrderedJson json = evaluated_json(problem, 0, std::vector<double>{9, 30});
  CHECK(json["formotion"] == 1);
  CHECK(json["kind"] == "feeder");
  for (const char* key : {"feasible", "violations", "values", "metrics", "worst_case", "poses"})
    CHECK(json.contains(key));
  for (const char* key : {"efficiency", "purity", "jam_probability", "tolerance_mm", "margin_mm", "length_mm",
                          "feature_count", "feed_rate_per_min"}) {
    CHECK(json["metrics"].contains(key));
    CHECK(json["worst_case"][key] == json["metrics"][key]);
  }
  CHECK(json["worst_case"]["bites"].is_null());
  REQUIRE(json["poses"].size() == 8);
  for (const auto& pose : json["poses"]) {
    for (const char* key : {"aspect", "orientation_deg", "prior", "outcome", "exit_orientation_deg", "margin_mm",
                            "unsupported_mm", "tip_mm", "decided_by"}) {
      CHECK(pose.contains(key));
    }
  }
  CHECK(json["poses"][1]["orientation_deg"] == 90);
  CHECK(json["values"]["w"] == 9);

  file.feeder.uncertainty.feature_mm = 0.1;
  const OrderedJson worst =
      evaluated_json(feeder::FeederProblem(file.feeder), 0, std::vector<double>{9, 30})["worst_case"];
  for (const char* key : {"efficiency", "purity", "jam_probability", "tolerance_mm", "margin_mm", "length_mm",
                          "feature_count", "feed_rate_per_min", "bites", "feasible"})
    CHECK(worst.contains(key));
}

TEST_CASE("obstacles are written with their numbers, as a problem file has them") {
  const feeder::FeederProblem problem(parse_problem(kProblem, "p.json").feeder);
  const OrderedJson features = features_json(problem.literal_design(0, std::vector<double>{9, 30}));
  CHECK(features[10] == OrderedJson::parse(R"({"type": "fence", "polygon_mm": [[0.0,-1.0],[39.0,4.0],[3.0,9.0]]})"));
  CHECK(features[11] ==
        OrderedJson::parse(R"({"type": "wall", "profile_mm": [[0.0,0.0],[9.0,3.0],[12.0,-2.5],[15.0,0.0]]})"));
  CHECK(features[12] == OrderedJson::parse(R"({"type": "pin", "x_mm": 4.5, "y_mm": 17.25, "diameter_mm": 4.0})"));
}

TEST_CASE("where parts come in without a pull to the wall is read, and left open where it is not said") {
  std::string text = kProblem;
  CHECK_FALSE(parse_problem(text, "p.json").feeder.environment.start_y_mm.has_value());
  text.replace(text.find("\"tilt_deg\": 5"), 13, "\"start_y_mm\": 12.5");
  CHECK(parse_problem(text, "p.json").feeder.environment.start_y_mm == 12.5);
}
