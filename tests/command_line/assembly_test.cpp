#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "program.hpp"

using namespace formotion::program;
using Json = nlohmann::ordered_json;

namespace {

std::string assembly(const std::string& name) { return shipped("../assembly/" + name + ".json"); }

Json evaluated(const std::string& name) {
  const Said said = run({"evaluate", assembly(name)});
  CAPTURE(name, said.err);
  REQUIRE(said.code == 0);
  return Json::parse(said.out);
}

Json front_of(const std::string& name, const std::string& out, const std::string& evaluations,
              const std::string& threads = "2") {
  const Said said = run({"optimize", assembly(name), "--out", out, "--evaluations", evaluations, "--threads", threads});
  CAPTURE(name, said.err);
  REQUIRE(said.code == 0);
  return Json::parse(read_file(out + "/pareto.json"));
}

}  // namespace

TEST_CASE("every shipped assembly goes together as drawn") {
  for (const char* name : {"straight_chamfer_least_work", "curved_chamfer", "keyed_connector", "peg_and_chamfer",
                           "compliance_centre", "bracket_in_slot", "damped_peg"}) {
    CAPTURE(name);
    const Json answer = evaluated(name);
    CHECK(answer["kind"] == "assembly");
    CHECK(answer["feasible"] == true);
    CHECK(answer["metrics"]["success_fraction"] > 0.6);
    CHECK(answer["metrics"]["success_fraction"] <= 1.0);
  }
}

TEST_CASE("the search finds the straight chamfer of least work at 45 degrees less half the friction angle") {
  const Folder folder;
  const Json front = front_of("straight_chamfer_least_work", folder / "run", "200");
  REQUIRE(front["designs"].size() == 1);
  const Json& design = front["designs"][0];
  const double friction = 0.2, width = 2.2;
  const double best_depth = width / (std::sqrt(1 + friction * friction) - friction);
  CHECK(design["values"]["depth"].get<double>() == Approx(best_depth).margin(0.01));
  CHECK(design["metrics"]["work_nmm"].get<double>() == Approx(13.81).margin(0.002));
}

TEST_CASE("a curved chamfer of one width and depth needs one to five percent less work than the straight one") {
  const Folder folder;
  const double straight = evaluated("curved_chamfer")["metrics"]["work_nmm"];
  const Json front = front_of("curved_chamfer", folder / "run", "400");
  const double curved = front["designs"][0]["metrics"]["work_nmm"];
  CHECK(curved < 0.99 * straight);
  CHECK(curved > 0.945 * straight);  // the ideal curve, mechanics of a chamfer: 26.66 of 28.17 N mm
}

TEST_CASE("the connector's wrong ways are proved by free space alone") {
  const Json answer = evaluated("keyed_connector");
  REQUIRE(answer["never"].size() == 3);
  for (const Json& never : answer["never"]) {
    CHECK(never["holds"] == true);
    CHECK(never["proved"] == true);
    CHECK(never["bound_mm"] >= never["deepest_mm"]);
    CHECK(never["bound_mm"] < 16);
  }
  CHECK(answer["metrics"]["depth_margin_mm"] > 4);
}

TEST_CASE("runs of assemblies give the same bytes on every number of threads and designs that say the same") {
  const Folder folder;
  const Json front = front_of("bracket_in_slot", folder / "one", "40", "1");
  front_of("bracket_in_slot", folder / "two", "40", "2");
  CHECK(read_file(folder / "one/pareto.json") == read_file(folder / "two/pareto.json"));
  REQUIRE_FALSE(front["designs"].empty());
  const Json& design = front["designs"][0];
  write_file(folder / "design.json", design.dump());
  const Json again =
      Json::parse(run({"evaluate", assembly("bracket_in_slot"), "--design", folder / "design.json"}).out);
  CHECK(again["metrics"] == design["metrics"]);
  CHECK(again["fixed_mm"] == design["fixed_mm"]);
  const std::string id = design["id"];
  for (const std::string format : {"json", "svg", "dxf", "stl"}) {
    CHECK(run({"export", folder / "one", "--design", id, "--format", format}).out ==
          read_file(folder / "one/designs/" + id + "." + format));
  }
}
