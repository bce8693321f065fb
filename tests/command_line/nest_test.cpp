#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "program.hpp"

using namespace formotion::program;
using Json = nlohmann::ordered_json;

namespace {

std::string problem(const std::string& kind, const std::string& name) {
  return shipped("../" + kind + "/" + name + ".json");
}

Json evaluated(const std::string& file, const std::vector<std::string>& more = {}) {
  std::vector<std::string> words{"evaluate", file};
  words.insert(words.end(), more.begin(), more.end());
  const Said said = run(words);
  CAPTURE(file, said.err);
  REQUIRE(said.code == 0);
  return Json::parse(said.out);
}

}  // namespace

TEST_CASE("a block let go over a vee comes to rest in it from every start of the box") {
  const Json answer = evaluated(problem("fixture", "block_in_vee"));
  CHECK(answer["kind"] == "fixture");
  CHECK(answer["feasible"] == true);
  CHECK(answer["metrics"]["seated_fraction"].get<double>() == Approx(1).margin(1e-9));
  // Four quarter turns of a square are one pose.
  int seats = 0;
  for (const Json& rest : answer["rests"]) seats += rest["is_seat"] == true;
  CHECK(seats == 1);
  CHECK(answer["seat_holds"] == "certain");
  CHECK(answer["metrics"]["resisted_weights"].get<double>() <= 1 + 1e-9);
}

TEST_CASE("escape heights of a pallet are brackets and its selectivity is their difference") {
  const Json answer = evaluated(problem("pallet", "tee_in_a_slot"));
  CHECK(answer["kind"] == "pallet");
  const Json& metrics = answer["metrics"];
  double goal = 0, wrong = 0;
  for (const Json& rest : answer["rests"]) {
    const double low = rest["escape_height_mm"][0], high = rest["escape_height_mm"][1];
    CHECK(low >= 0);
    CHECK(low <= high);
    (rest["is_seat"] == true ? goal : wrong) = rest["is_seat"] == true ? low : std::max(wrong, high);
  }
  CHECK(metrics["goal_escape_height_mm"].get<double>() == goal);
  CHECK(metrics["worst_wrong_escape_height_mm"].get<double>() == wrong);
  CHECK(metrics["selectivity_mm"].get<double>() == Approx(goal - wrong));
}

TEST_CASE("a search over nests writes the same bytes for every number of threads and its files can be used again") {
  const Folder folder;
  std::string bytes;
  for (const char* threads : {"1", "2"}) {
    const std::string out = folder / threads;
    const Said said = run(
        {"optimize", problem("fixture", "block_in_vee"), "--out", out, "--evaluations", "12", "--threads", threads});
    CAPTURE(said.err);
    REQUIRE(said.code == 0);
    const std::string pareto = read_file(out + "/pareto.json");
    if (bytes.empty()) bytes = pareto;
    CHECK(pareto == bytes);
  }
  const Json front = Json::parse(bytes);
  REQUIRE(!front["designs"].empty());
  const Json& design = front["designs"][0];
  const std::string id = design["id"];
  for (const char* format : {"json", "svg", "dxf", "stl"})
    CHECK(std::filesystem::file_size(folder / ("1/designs/" + id + "." + format)) > 200);
  write_file(folder / "design.json", design.dump());
  const Json again = evaluated(problem("fixture", "block_in_vee"), {"--design", folder / "design.json"});
  CHECK(again["metrics"] == design["metrics"]);
  CHECK(again["nest_mm"] == design["nest_mm"]);
}
