// evaluate, query, validate, and how the program refuses.
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "program.hpp"

using namespace formotion::program;
using Json = nlohmann::ordered_json;

namespace {

// The L-part of the reference values, no tilt.
const char* const kL = R"({
  "formotion": 1, "name": "L", "kind": "feeder",
  "part": {"outline_mm": [[0,0],[0,-30.491329],[-10.4514,-30.491329],[-10.4514,-9.52185],[-40.62175,-9.52185],[-40.62175,0]], "thickness_mm": 3},
  "environment": {"track_width_mm": 60},
  "variables": {"w": {"min": 9, "max": 15, "value": 12}},
  "design": {"features": [{"type": "balcony", "width_mm": "w", "length_mm": 80}]},
  "goal": {"deliver": "one pose"}
})";

struct Problem : Folder {
  Problem() { write_file(file, kL); }
  std::string file = path + "/l.json";
};

std::vector<Json> lines(const std::string& text) {
  std::vector<Json> all;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) all.push_back(Json::parse(line));
  return all;
}

}  // namespace

TEST_CASE("evaluate says what a balcony does to the reference part, at widths on both sides of its window") {
  const Problem problem;
  const auto efficiency = [&](const std::string& w) {
    const Said said = run({"evaluate", problem.file, "--set", "w=" + w});
    REQUIRE(said.code == 0);
    REQUIRE(said.err.empty());
    const Json json = Json::parse(said.out);
    return std::make_pair(json["feasible"].get<bool>(), json["metrics"]["efficiency"].get<double>());
  };
  CHECK(efficiency("10.403").first == false);
  CHECK(efficiency("10.41").first == true);
  CHECK(efficiency("10.41").second == Approx(0.343).margin(1e-3));
  CHECK(efficiency("14.08").first == true);
  CHECK(efficiency("14.09").first == false);
  const Json json = Json::parse(run({"evaluate", problem.file}).out);
  CHECK(json["values"]["w"] == 12);  // the variable's value
  // The deciding hull edge is slanted: less than half of 12 - 10.404.
  CHECK(json["metrics"]["tolerance_mm"].get<double>() == Approx(0.73468).margin(1e-4));
}

TEST_CASE("evaluate draws the track, too") {
  const Problem problem;
  const Said svg = run({"evaluate", problem.file, "--format", "svg"});
  CHECK(svg.code == 0);
  CHECK(svg.out.find("<svg") != std::string::npos);
  CHECK(run({"evaluate", problem.file, "--format", "dxf"}).out.find("VOID") != std::string::npos);
}

TEST_CASE("query answers line by line, in order, and goes on after bad lines") {
  const Problem problem;
  const Said said =
      run({"query", problem.file},
          "{\"id\":1,\"type\":\"support\",\"aspect\":\"up\",\"q\":{\"x_mm\":-200,\"y_mm\":20,\"theta_deg\":0}}\n"
          "{\"id\":\"two\",\"type\":\"support\",\"q\":{\"x_mm\":40,\"y_mm\":20,\"theta_deg\":0}}\n"
          "not json\n"
          "\n"
          "{\"id\":5,\"type\":\"suport\",\"q\":{\"x_mm\":0,\"y_mm\":0,\"theta_deg\":0}}\n"
          "{\"id\":6,\"type\":\"support\",\"aspect\":\"left\",\"q\":{\"x_mm\":0,\"y_mm\":0,\"theta_deg\":0}}\n"
          "{\"id\":7,\"type\":\"support\",\"q\":{\"x_mm\":0,\"y_mm\":0}}\n"
          "{\"id\":8,\"type\":\"clearance\",\"q\":{\"x_mm\":0,\"theta_deg\":0}}\n"
          "[1]\n"
          "{\"id\":10,\"type\":\"support\",\"q\":{\"x_mm\":40,\"y_mm\":500,\"theta_deg\":90}}\n");
  CHECK(said.code == 0);
  CHECK(said.err.empty());
  const std::vector<Json> answers = lines(said.out);
  REQUIRE(answers.size() == 10);
  CHECK(answers[0]["id"] == 1);
  CHECK(answers[0]["supported"] == true);
  CHECK(answers[1]["id"] == "two");
  CHECK(answers[1]["supported"] == false);
  CHECK(answers[1]["margin_mm"].get<double>() < 0);
  for (const int bad : {2, 3, 4, 5, 6, 7, 8}) CHECK(answers[static_cast<std::size_t>(bad)].contains("error"));
  CHECK(answers[2]["id"].is_null());
  CHECK(answers[4]["id"] == 5);
  CHECK(answers[9] == Json{{"id", 10}, {"supported", false}, {"margin_mm", nullptr}});
}

TEST_CASE("bad input is exit code 2, one line an error, nothing on stdout, nothing written") {
  const Problem problem;
  Json bad = Json::parse(kL);
  bad["part"]["thickness_mm"] = -1;
  bad["environment"]["track_widht_mm"] = 3;
  write_file(problem / "bad.json", bad.dump());
  for (const std::string command : {"validate", "evaluate", "optimize", "query"}) {
    std::vector<std::string> arguments{command, problem / "bad.json"};
    if (command == "optimize") arguments.insert(arguments.end(), {"--out", problem / "run"});
    const Said said = run(arguments);
    CAPTURE(command, said.err);
    CHECK(said.code == 2);
    CHECK(said.out.empty());
    std::istringstream stream(said.err);
    int count = 0;
    for (std::string line; std::getline(stream, line); ++count)
      CHECK(line.rfind("error: " + problem / "bad.json: /", 0) == 0);
    CHECK(count == 2);
    CHECK_FALSE(std::filesystem::exists(problem / "run"));
  }
}

TEST_CASE("usage errors are exit code 2 and a line, help and version are 0") {
  const Problem problem;
  const std::vector<std::vector<std::string>> wrong{{},
                                                    {"optimise", problem.file},
                                                    {"evaluate"},
                                                    {"evaluate", problem.file, "--set"},
                                                    {"evaluate", problem.file, "--set", "w"},
                                                    {"evaluate", problem.file, "--set", "w=abc"},
                                                    {"evaluate", problem.file, "--set", "v=1"},
                                                    {"evaluate", problem.file, "--topology", "3"},
                                                    {"evaluate", problem.file, "--design", problem / "none.json"},
                                                    {"optimize", problem.file, "--evaluations", "0"},
                                                    {"optimize", problem.file, "--evaluations", "many"},
                                                    {"optimize", problem.file, "--engine", "magic"},
                                                    {"optimize", problem / "none.json"},
                                                    {"status", problem / "no_run"},
                                                    {"resume", problem / "no_run"},
                                                    {"report", problem / "no_run"},
                                                    {"report", problem.path, "--format", "pdf"}};
  for (const auto& arguments : wrong) {
    const Said said = run(arguments);
    CAPTURE(said.err);
    CHECK(said.code == 2);
    CHECK(said.out.empty());
    CHECK(said.err.rfind("error: ", 0) == 0);
    CHECK(std::count(said.err.begin(), said.err.end(), '\n') == 1);
  }
  CHECK(run({"--help"}).code == 0);
  CHECK(run({"optimize", "--help"}).code == 0);
  const Said version = run({"--version"});
  CHECK(version.code == 0);
  CHECK(version.out.rfind("formotion ", 0) == 0);
}

TEST_CASE("a design that is not in the run is named, with those that are") {
  const Folder folder;
  REQUIRE(run({"optimize", shipped("el_bracket.json"), "--evaluations", "1500", "--out", folder / "run"}).code == 0);
  const Said said = run({"export", folder / "run", "--design", "d99999", "--format", "svg"});
  CHECK(said.code == 2);
  CHECK(said.err.find("d99999") != std::string::npos);
  CHECK(said.err.find("an id of the front: d") != std::string::npos);
}
