// verify of fixtures and pallets.
#include <sqlite3.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "program.hpp"

using namespace formotion::program;
using Json = nlohmann::ordered_json;

namespace {

Json block_in_vee() { return Json::parse(read_file(shipped("../fixture/block_in_vee.json"))); }

// A few designs of a problem.
struct Run : Folder {
  explicit Run(const Json& problem) {
    write_file(path + "/problem.json", problem.dump());
    const Said said = run({"optimize", path + "/problem.json", "--out", out, "--evaluations", "4"});
    CAPTURE(said.err);
    REQUIRE(said.code == 0);
  }
  std::string out = path + "/run";

  std::string first() const { return Json::parse(read_file(out + "/pareto.json"))["designs"][0]["id"]; }
  void change_store(const std::string& sql) const {
    sqlite3* store = nullptr;
    REQUIRE(sqlite3_open((out + "/run.sqlite").c_str(), &store) == SQLITE_OK);
    CHECK(sqlite3_exec(store, sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK);
    sqlite3_close(store);
  }
};

// The checks' units, which name them.
std::vector<std::string> checked(const Run& made, const std::vector<std::string>& more) {
  const std::string before = read_file(made.out + "/pareto.json");
  std::vector<std::string> words{"verify", made.out, "--format", "json"};
  words.insert(words.end(), more.begin(), more.end());
  const Said said = run(words);
  CAPTURE(said.err, said.out);
  CHECK(said.code == 0);
  const Json verified = Json::parse(said.out), pareto = Json::parse(before);
  REQUIRE(verified.size() == pareto["designs"].size());
  std::vector<std::string> names;
  for (std::size_t i = 0; i < verified.size(); ++i) {
    CHECK(verified[i]["id"] == pareto["designs"][i]["id"]);
    for (const Json& check : verified[i]["checks"]) {
      CHECK(check["holds"] == true);
      CHECK(check["count"] > 0);
      if (i == 0) names.push_back(check["name"]);
    }
  }
  CHECK(read_file(made.out + "/pareto.json") == before);
  const Json report = Json::parse(run({"report", made.out, "--format", "json"}).out);
  CHECK(report["designs"][0]["stamp"] == verified[0]);
  return names;
}

}  // namespace

TEST_CASE("a fixture's front is verified and its stamps reach the report") {
  const Run made(block_in_vee());
  CHECK(checked(made, {"--perturbations", "2"}) ==
        std::vector<std::string>{"repeatable", "drawn", "finer", "perturbed"});
}

TEST_CASE("a pallet's front is shaken in simulation besides") {
  const Run made(Json::parse(read_file(shipped("../pallet/ell_in_a_pocket.json"))));
  CHECK(checked(made, {"--perturbations", "1"}) ==
        std::vector<std::string>{"repeatable", "drawn", "finer", "perturbed", "shaken"});
}

TEST_CASE("a pallet on whose rims wrong parts stay though the table could throw them off fails by name") {
  Json problem = block_in_vee();
  problem["kind"] = "pallet";
  problem["environment"]["table"] = {{"amplitude_mm", 0.3}, {"frequency_hz", 30}, {"restitution", 0.2}};
  const Run made(problem);
  const Said said = run({"verify", made.out, "--design", made.first(), "--perturbations", "0"});
  CAPTURE(said.out, said.err);
  CHECK(said.code == 3);
  CHECK(said.out.find("shaken") != std::string::npos);
  CHECK(said.out.find("keeps its wrong part in all of 8 simulated runs in 30 s") != std::string::npos);
}

TEST_CASE("a fixture whose stored score is not its own fails by name and one that is not in the run is refused") {
  const Run made(block_in_vee());
  made.change_store("UPDATE evaluations SET violation = 1e-300 WHERE number = " + made.first().substr(1));
  const Said said = run({"verify", made.out, "--design", made.first(), "--perturbations", "0"});
  CAPTURE(said.out, said.err);
  CHECK(said.code == 3);
  CHECK(said.out.find(made.first() + " FAILS: repeatable: violation") == 0);
  const Said unknown = run({"verify", made.out, "--design", "d99999"});
  CHECK(unknown.code == 2);
  CHECK(unknown.err.find("d99999") != std::string::npos);
  CHECK(run({"verify", made / "nothing"}).code == 2);
}
