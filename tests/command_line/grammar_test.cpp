// Every shipped problem with a grammar in place of its designs, as a user would run it.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "program.hpp"

using namespace formotion::program;
using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

namespace {

bool turns_parts(const Json& document) {
  const std::string text = document.dump();
  return text.find("\"fence\"") != std::string::npos || text.find("\"wall\"") != std::string::npos ||
         text.find("\"pin\"") != std::string::npos;
}

// Paths of the shipped feeder problems, sorted.
std::vector<std::string> shipped_problems() {
  std::vector<std::string> paths;
  for (const auto& entry : fs::directory_iterator(fs::path(shipped("el_bracket.json")).parent_path())) {
    if (entry.path().extension() == ".json") paths.push_back(entry.path().string());
  }
  std::sort(paths.begin(), paths.end());
  REQUIRE(paths.size() >= 12);
  return paths;
}

// The problem with the grammar; variables are kept where the part uses them.
Json with_grammar(Json document, const std::string& path, const Json& grammar) {
  for (const char* key : {"design", "topologies", "search"}) document.erase(key);
  document["grammar"] = grammar;
  document["goal"] = {{"deliver", document["goal"]["deliver"]}};
  Json& part = document["part"];
  if (part.contains("file")) part["file"] = (fs::path(path).parent_path() / part["file"].get<std::string>()).string();
  std::string used;  // the expressions of its outlines
  const Json places = part.flatten();
  for (const auto& [place, value] : places.items()) {
    if (value.is_string() && place.find("_mm/") != std::string::npos) used += value.get<std::string>() + " ";
  }
  const Json variables = document.value("variables", Json::object());
  document.erase("variables");
  for (const auto& [name, bounds] : variables.items()) {
    if (used.find(name) != std::string::npos) document["variables"][name] = bounds;
  }
  return document;
}

// Optimizes with the grammar and checks what a user can see of it.
void run_with(const Json& document, const std::string& evaluations) {
  const Folder folder;
  const std::string problem = folder / "problem.json", out = folder / "run";
  write_file(problem, document.dump());
  const Said good = run({"validate", problem});
  CAPTURE(document["name"], good.out, good.err);
  REQUIRE(good.code == 0);
  CHECK(good.out.find(" topologies, ") != std::string::npos);
  CHECK(good.out.find("grammar: ") != std::string::npos);
  CHECK(good.out.find(" pruned") != std::string::npos);

  const Said said = run({"optimize", problem, "--evaluations", evaluations, "--threads", "1", "--out", out});
  CAPTURE(said.err);
  REQUIRE((said.code == 0 || said.code == 3));
  CHECK(fs::exists(out + "/report.html"));
  const Json designs = Json::parse(read_file(out + "/pareto.json"))["designs"];
  REQUIRE_FALSE(designs.empty());
  for (const Json& design : designs) {
    CHECK(design["feasible"] == (said.code == 0));
    CHECK(design["features"].size() <= document["grammar"]["max_features"].get<std::size_t>());
    std::set<std::string> types;
    for (const Json& type : document["grammar"]["features"]) types.insert(type.get<std::string>());
    std::string label;
    for (const Json& feature : design["features"]) {
      const std::string type = feature["type"];
      CHECK(types.count(type) == 1);
      label += (label.empty() ? "" : " + ") + type;
      if (type == "cutout") label += "(" + std::to_string(feature["polygon_mm"].size()) + ")";
    }
    CHECK(design["label"] == label);
    for (const auto& [name, value] : design["values"].items()) {
      if (document.contains("variables") && document["variables"].contains(name)) continue;
      CHECK(name.size() > 3);
      CHECK(name[0] == 'f');
      CHECK(name[2] == '.');
    }
  }
  // A feasible entry is a design file of the problem, and says the same again; others may have impossible shapes.
  const std::string id = designs[0]["id"];
  if (said.code == 0) {
    const Said again = run({"evaluate", problem, "--design", out + "/designs/" + id + ".json"});
    REQUIRE(again.code == 0);
    CHECK(Json::parse(again.out)["metrics"] == designs[0]["metrics"]);
  }
  CHECK(run({"export", out, "--design", id, "--format", "svg"}).code == 0);
  CHECK(run({"report", out, "--format", "json"}).code == 0);
}

}  // namespace

TEST_CASE("every shipped problem of features that hold or drop runs with a grammar") {
  int runs = 0;
  for (const std::string& path : shipped_problems()) {
    const Json document = Json::parse(read_file(path));
    if (turns_parts(document)) continue;
    Json grammar{{"features", {"balcony", "gap", "slot", "cutout"}}, {"max_features", 2}};
    if (document["part"].contains("aspects")) grammar["features"].push_back("wiper");
    run_with(with_grammar(document, path, grammar), "150");
    ++runs;
  }
  CHECK(runs >= 7);
}

TEST_CASE("every shipped problem of features that turn parts runs with a grammar") {
  int runs = 0;
  for (const std::string& path : shipped_problems()) {
    const Json document = Json::parse(read_file(path));
    if (!turns_parts(document)) continue;
    run_with(with_grammar(document, path, {{"features", {"fence", "pin", "balcony"}}, {"max_features", 2}}), "60");
    ++runs;
  }
  CHECK(runs >= 4);
}

TEST_CASE("topologies of a grammar are chosen by number and their variables by name") {
  const std::string problem = shipped("el_bracket_grammar.json");
  const Said fallback = run({"evaluate", problem});
  REQUIRE(fallback.code == 0);
  const Json first = Json::parse(fallback.out);
  CHECK(first["topology"] == 0);
  CHECK(first["features"][0]["type"] == "cutout");  // what comes before cannot reach the goal
  CHECK(first["values"].contains("f0.x0_mm"));
  const Said set = run({"evaluate", problem, "--topology", "4", "--set", "f0.width_mm=9"});
  REQUIRE(set.code == 0);
  const Json chosen = Json::parse(set.out);
  CHECK(chosen["features"][0]["type"] == "balcony");
  CHECK(chosen["features"][0]["width_mm"] == 9);
  CHECK(chosen["features"][1]["type"] == "cutout");
  CHECK(run({"query", problem, "--topology", "4"},
            "{\"type\":\"support\",\"aspect\":\"up\",\"q\":{\"x_mm\":-200,\"y_mm\":20,\"theta_deg\":0}}\n")
            .out.find("\"supported\":true") != std::string::npos);
  CHECK(run({"evaluate", problem, "--topology", "100000"}).code == 2);
  CHECK(run({"evaluate", problem, "--set", "f0.widht_mm=9"}).err.find("did you mean 'f0.width_mm'") !=
        std::string::npos);
}
