#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "program.hpp"

using namespace formotion::program;
using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

namespace {

const std::string kEl = shipped("el_bracket.json");

std::vector<std::string> optimize(const std::string& out, const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"optimize", kEl, "--evaluations", "3000", "--out", out};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

}  // namespace

TEST_CASE("a run ends with all its files, and its designs say the same everywhere") {
  const Folder folder;
  const std::string out = folder / "run";
  const Said said = run(optimize(out));
  CAPTURE(said.err);
  REQUIRE(said.code == 0);
  CHECK(said.out.empty());
  for (const char* file : {"run.sqlite", "problem.json", "pareto.json", "report.html"})
    CHECK(fs::exists(out + "/" + file));

  const Json pareto = Json::parse(read_file(out + "/pareto.json"));
  CHECK(pareto["formotion"] == 1);
  CHECK(pareto["problem"] == "el bracket");
  CHECK(pareto["objectives"] == Json({"efficiency", "tolerance_mm", "length_mm"}));
  REQUIRE_FALSE(pareto["designs"].empty());
  for (const Json& design : pareto["designs"]) {
    const std::string id = design["id"];
    CHECK(design["metrics"]["purity"] == 1.0);
    CHECK(design["metrics"]["jam_probability"] == 0.0);
    // The entry is a design file: evaluated, it scores what it says.
    write_file(folder / "design.json", design.dump());
    const Json evaluated = Json::parse(run({"evaluate", kEl, "--design", folder / "design.json"}).out);
    CHECK(evaluated["feasible"] == true);
    CHECK(evaluated["metrics"] == design["metrics"]);
    CHECK(Json::parse(read_file(out + "/designs/" + id + ".json")) == design);
    for (const std::string format : {"json", "svg", "dxf", "stl"}) {
      CHECK(run({"export", out, "--design", id, "--format", format}).out ==
            read_file(out + "/designs/" + id + "." + format));
    }
  }
  // The problem as run is a problem again.
  CHECK(run({"validate", out + "/problem.json"}).code == 0);

  const Json status = Json::parse(run({"status", out, "--format", "json"}).out);
  CHECK(status["phase"] == "complete");
  CHECK(status["evaluations"] == 3000);
  const Said csv = run({"report", out, "--format", "csv"});
  CHECK(static_cast<std::size_t>(std::count(csv.out.begin(), csv.out.end(), '\n')) == pareto["designs"].size() + 1);
  CHECK(Json::parse(run({"report", out, "--format", "json"}).out).is_object());
}

TEST_CASE("the same bytes for one, two and eight threads, other bytes for another seed") {
  const Folder folder;
  REQUIRE(run(optimize(folder / "1", {"--threads", "1"})).code == 0);
  REQUIRE(run(optimize(folder / "2", {"--threads", "2"})).code == 0);
  REQUIRE(run(optimize(folder / "8", {"--threads", "8"})).code == 0);
  REQUIRE(run(optimize(folder / "s", {"--seed", "2"})).code == 0);
  const std::string one = read_file(folder / "1/pareto.json");
  CHECK(one == read_file(folder / "2/pareto.json"));
  CHECK(one == read_file(folder / "8/pareto.json"));
  CHECK(one != read_file(folder / "s/pareto.json"));
}

TEST_CASE("Ctrl-C stops cleanly and says how to go on, the run then ends as if it had never stopped") {
  const Folder folder;
  const std::vector<std::string> long_run{"optimize", kEl, "--evaluations", "12000", "--threads", "1", "--out"};
  const auto with_out = [&](const std::string& out) {
    std::vector<std::string> arguments = long_run;
    arguments.push_back(out);
    return arguments;
  };
  REQUIRE(run(with_out(folder / "whole")).code == 0);

  const std::string out = folder / "stopped";
  Said said = run_and_signal(with_out(out), SIGINT, 400);
  CAPTURE(said.err);
  REQUIRE(said.code == 4);
  CHECK(said.err.find("formotion resume " + out) != std::string::npos);
  CHECK(Json::parse(run({"status", out, "--format", "json"}).out)["phase"] == "stopped");
  // Killed on the way, too.
  for (int i = 0; i < 4; ++i) {
    said = run_and_signal({"resume", out}, SIGKILL, 150 + 130 * i);
    REQUIRE((said.code == -SIGKILL || said.code == 0));
  }
  REQUIRE(run({"resume", out}).code == 0);
  CHECK(read_file(out + "/pareto.json") == read_file(folder / "whole/pareto.json"));
  CHECK(run({"resume", out}).code == 0);  // nothing left to do
  CHECK(read_file(out + "/pareto.json") == read_file(folder / "whole/pareto.json"));
}

TEST_CASE("a folder with a run is not touched without --overwrite") {
  const Folder folder;
  const std::string out = folder / "run";
  REQUIRE(run(optimize(out)).code == 0);
  const std::string before = read_file(out + "/pareto.json");
  const Said again = run(optimize(out, {"--seed", "5"}));
  CHECK(again.code == 2);
  CHECK(again.err.find("--overwrite") != std::string::npos);
  CHECK(read_file(out + "/pareto.json") == before);
  CHECK(run(optimize(out, {"--seed", "5", "--overwrite"})).code == 0);
  CHECK(read_file(out + "/pareto.json") != before);
}

TEST_CASE("no feasible design: exit code 3, and everything is written all the same, with what is wrong") {
  const Folder folder;
  Json problem = Json::parse(read_file(kEl));
  problem["goal"]["deliver"] = {{"aspect", "up"}, {"orientation_deg", 0}};
  problem["topologies"] =
      Json::array({{{"features", Json::array({{{"type", "balcony"}, {"width_mm", "w"}, {"length_mm", 60}}})}}});
  problem["variables"] = {{"w", {{"min", 6}, {"max", 20}}}};
  write_file(folder / "hopeless.json", problem.dump());
  const Said said = run({"optimize", folder / "hopeless.json", "--evaluations", "300", "--out", folder / "run"});
  CAPTURE(said.err);
  CHECK(said.code == 3);
  const Json pareto = Json::parse(read_file(folder / "run/pareto.json"));
  REQUIRE_FALSE(pareto["designs"].empty());
  CHECK(pareto["designs"][0]["feasible"] == false);
  CHECK_FALSE(pareto["designs"][0]["violations"].empty());
  CHECK(fs::exists(folder / "run/report.html"));
}

TEST_CASE("progress for machines is JSON, a line each, and stdout stays empty") {
  const Folder folder;
  const Said said = run(optimize(folder / "run", {"--log-format", "json"}));
  CHECK(said.out.empty());
  std::istringstream lines(said.err);
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) CHECK(Json::parse(line).is_object());
  CHECK(count > 3);
}
