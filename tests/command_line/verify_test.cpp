#include <sqlite3.h>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "program.hpp"

using namespace formotion::program;
using Json = nlohmann::ordered_json;

TEST_CASE("the front of a run holds, its stamps reach the report, and pareto.json stays as it was") {
  const Folder folder;
  const std::string out = folder / "run";
  REQUIRE(run({"optimize", shipped("el_bracket.json"), "--evaluations", "1000", "--out", out}).code == 0);
  const std::string before = read_file(out + "/pareto.json");
  const Said said = run({"verify", out, "--perturbations", "4", "--format", "json"});
  CAPTURE(said.err, said.out);
  CHECK(said.code == 0);
  const Json verified = Json::parse(said.out), pareto = Json::parse(before);
  REQUIRE(verified.size() == pareto["designs"].size());
  for (std::size_t i = 0; i < verified.size(); ++i) {
    CHECK(verified[i]["id"] == pareto["designs"][i]["id"]);
    CHECK(verified[i]["holds"] == true);
    CHECK(verified[i]["checks"].size() == 6);
  }
  CHECK(read_file(out + "/pareto.json") == before);
  const Json report = Json::parse(run({"report", out, "--format", "json"}).out);
  CHECK(report["designs"][0]["stamp"]["holds"] == true);
  CHECK(report["designs"][0]["stamp"]["checks"].size() == 6);
}

TEST_CASE("verify of what is not there is bad input") {
  const Folder folder;
  CHECK(run({"verify", folder / "nothing"}).code == 2);
  const std::string out = folder / "run";
  REQUIRE(run({"optimize", shipped("el_bracket.json"), "--evaluations", "500", "--out", out}).code == 0);
  const Said said = run({"verify", out, "--design", "d501"});
  CHECK(said.code == 2);
  CHECK(said.err.find("d501") != std::string::npos);
}

TEST_CASE("a design whose stored score is not its own fails by name, with exit code 3") {
  const Folder folder;
  const std::string out = folder / "run";
  REQUIRE(run({"optimize", shipped("el_bracket.json"), "--evaluations", "1000", "--out", out}).code == 0);
  const std::string id = Json::parse(read_file(out + "/pareto.json"))["designs"][0]["id"];
  sqlite3* store = nullptr;
  REQUIRE(sqlite3_open((out + "/run.sqlite").c_str(), &store) == SQLITE_OK);
  const std::string sql = "UPDATE evaluations SET violation = 1e-300 WHERE number = " + id.substr(1);
  CHECK(sqlite3_exec(store, sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK);
  sqlite3_close(store);
  const Said said = run({"verify", out, "--design", id, "--perturbations", "0"});
  CAPTURE(said.out, said.err);
  CHECK(said.code == 3);
  CHECK(said.out.find(id + " FAILS: repeatable: violation") == 0);
}
