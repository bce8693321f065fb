#include <sqlite3.h>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "program.hpp"

using namespace formotion::program;
using Json = nlohmann::ordered_json;

namespace {

// A peg over a hole with chamfers: quick, and easy to get right.
const char* const kPeg = R"({
  "formotion": 1, "name": "peg", "kind": "assembly",
  "part": {"outline_mm": [[-5, 6], [5, 6], [5, 26], [-5, 26]]},
  "environment": {
    "friction": 0.1,
    "compliance": {"kx_n_per_mm": 5, "ky_n_per_mm": 50, "ktheta_nmm_per_rad": 50000, "center_mm": [0, 6]},
    "approach": {"direction_deg": -90, "distance_mm": 18}
  },
  "variables": {"width": {"min": 0.5, "max": 4, "value": 2}},
  "design": {
    "fixed_mm": [
      [[-20, -20], [-5.2, -20], [-5.2, "-width"], ["-5.2 - width", 0], [-20, 0]],
      [[5.2, -20], [20, -20], [20, 0], ["5.2 + width", 0], [5.2, "-width"]]
    ]
  },
  "goal": {"depth_mm": 14, "lateral_mm": 0.3, "tilt_deg": 1, "starts": {"x_mm": [-1, 1]}},
  "search": {"evaluations": 12, "objectives": ["success_fraction", "chamfer_mm"]}
})";

struct Run : Folder {
  Run() {
    write_file(path + "/peg.json", kPeg);
    const Said said = run({"optimize", path + "/peg.json", "--out", out});
    CAPTURE(said.err);
    REQUIRE(said.code == 0);
  }
  std::string out = path + "/run";
};

}  // namespace

TEST_CASE("an assembly's front is verified by five checks whose stamps reach the report") {
  const Run made;
  const std::string before = read_file(made.out + "/pareto.json");
  const Said said = run({"verify", made.out, "--perturbations", "4", "--format", "json"});
  CAPTURE(said.err, said.out);
  CHECK((said.code == 0 || said.code == 3));
  const Json verified = Json::parse(said.out), pareto = Json::parse(before);
  REQUIRE(verified.size() == pareto["designs"].size());
  bool all = true;
  for (std::size_t i = 0; i < verified.size(); ++i) {
    CHECK(verified[i]["id"] == pareto["designs"][i]["id"]);
    REQUIRE(verified[i]["checks"].size() == 5);
    for (const Json& check : verified[i]["checks"]) {
      all = all && check["holds"] == true;
      CHECK(check["count"] > 0);
    }
  }
  CHECK((said.code == 0) == all);
  CHECK(read_file(made.out + "/pareto.json") == before);
  const Json report = Json::parse(run({"report", made.out, "--format", "json"}).out);
  CHECK(report["designs"][0]["stamp"] == verified[0]);
}

TEST_CASE("an assembly whose stored score is not its own fails by name") {
  const Run made;
  const std::string id = Json::parse(read_file(made.out + "/pareto.json"))["designs"][0]["id"];
  sqlite3* store = nullptr;
  REQUIRE(sqlite3_open((made.out + "/run.sqlite").c_str(), &store) == SQLITE_OK);
  const std::string sql = "UPDATE evaluations SET violation = 1e-300 WHERE number = " + id.substr(1);
  CHECK(sqlite3_exec(store, sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK);
  sqlite3_close(store);
  const Said said = run({"verify", made.out, "--design", id, "--perturbations", "0"});
  CAPTURE(said.out, said.err);
  CHECK(said.code == 3);
  CHECK(said.out.find(id + " FAILS: repeatable: violation") == 0);
}
