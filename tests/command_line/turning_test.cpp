// The shipped problems in which parts turn, as drawn.
#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "program.hpp"

using namespace formotion::program;
using Json = nlohmann::ordered_json;

namespace {

Json evaluated(const std::string& name, const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"evaluate", shipped(name + ".json")};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Said said = run(arguments);
  REQUIRE(said.code == 0);
  REQUIRE(said.err.empty());
  return Json::parse(said.out);
}

double efficiency(const Json& evaluation) { return evaluation.at("metrics").at("efficiency").get<double>(); }

}  // namespace

TEST_CASE("two ramps and a pin turn every pose of the L-part into one") {
  const Json json = evaluated("ramps_and_pin");
  CHECK(json.at("feasible") == true);
  CHECK(efficiency(json) == Approx(1));
  for (const Json& pose : json.at("poses")) CHECK(pose.at("exit_orientation_deg") == 180.0);
  CHECK(json.at("metrics").at("tolerance_mm").get<double>() > 0.5);
}

TEST_CASE("a ramp in front of a balcony delivers more than any track that only holds or drops") {
  const Json turned = evaluated("el_held_or_turned", {"--topology", "2"});
  CHECK(turned.at("feasible") == true);
  double most = 0, sum = 0;  // a passive track delivers one pose at most
  for (const Json& pose : turned.at("poses")) {
    most = std::max(most, pose.at("prior").get<double>());
    if (pose.at("outcome") == "delivered") sum += pose.at("prior").get<double>();
  }
  CHECK(most < 0.36);
  CHECK(efficiency(turned) == Approx(sum));
  CHECK(efficiency(turned) > 0.56);
  for (const std::string topology : {"0", "1"}) {
    CHECK(efficiency(evaluated("el_held_or_turned", {"--topology", topology})) <= most + 1e-9);
  }
}

TEST_CASE("a wall with a ramp and a recess turns two poses of the tee into its goal") {
  const Json json = evaluated("tee_over_a_recess");
  CHECK(json.at("feasible") == true);
  CHECK(efficiency(json) == Approx(0.727).margin(1e-3));
  for (const Json& pose : json.at("poses")) {
    if (pose.at("outcome") == "delivered") CHECK(pose.at("exit_orientation_deg") == 0.0);
  }
  CHECK(json.at("poses").back().at("outcome") == "rejected");
}

TEST_CASE("a belt with two fences brings every start into one orientation, and its map covers the full turn") {
  const Json one = evaluated("belt_with_fences");
  CHECK(one.at("feasible") == true);
  CHECK(efficiency(one) == 1);
  REQUIRE(one.at("outcome_map").size() == 1);
  CHECK(one["outcome_map"][0].at("from_deg") == 0);
  CHECK(one["outcome_map"][0].at("to_deg") == 360);

  // With the first fence alone, parts leave in two.
  Json problem = Json::parse(read_file(shipped("belt_with_fences.json")));
  problem["design"]["features"].erase(1);
  problem["variables"].erase("run2");
  problem["variables"].erase("drop2");
  const Folder folder;
  write_file(folder / "one_fence.json", problem.dump());
  const Said said = run({"evaluate", folder / "one_fence.json"});
  REQUIRE(said.code == 0);
  const Json map = Json::parse(said.out).at("outcome_map");
  REQUIRE(map.size() >= 2);
  double sum = 0;
  for (std::size_t i = 0; i < map.size(); ++i) {
    CHECK(map[i].at("to_deg") == map[(i + 1) % map.size()].at("from_deg"));
    const double width = map[i]["to_deg"].get<double>() - map[i]["from_deg"].get<double>();
    sum += width > 0 ? width : width + 360;
  }
  CHECK(sum == Approx(360));
}

TEST_CASE(
    "uncertain friction and drive are projected: what they change counts as a jam, and the one that bites is named") {
  Json problem = Json::parse(read_file(shipped("ramps_and_pin.json")));
  const Folder folder;
  const auto worst = [&](double low, double high) {
    problem["uncertainty"] = {{"wall_friction", {low, high}}, {"drive_deg", {-30.1, -29.9}}};
    write_file(folder / "uncertain.json", problem.dump());
    const Said said = run({"evaluate", folder / "uncertain.json"});
    REQUIRE(said.code == 0);
    return Json::parse(said.out).at("worst_case");
  };
  const Json calm = worst(0.199, 0.201), wild = worst(0.1, 0.3);
  CHECK(calm.at("efficiency") == 1);
  CHECK(calm.at("bites") == nullptr);
  CHECK(wild.at("efficiency").get<double>() < 1);
  CHECK(wild.at("jam_probability").get<double>() > 0);
  CHECK(wild.at("bites") == "wall_friction");
}

TEST_CASE("tracks with obstacles are drawn, and their drawings are tracks again") {
  const Said dxf = run({"evaluate", shipped("ramps_and_pin.json"), "--format", "dxf"});
  CHECK(dxf.code == 0);
  const Folder folder;
  write_file(folder / "track.dxf", dxf.out);
  Json problem = Json::parse(read_file(shipped("ramps_and_pin.json")));
  problem.erase("variables");
  problem["design"] = {{"features", {{{"type", "drawing"}, {"file", "track.dxf"}}}}};
  write_file(folder / "again.json", problem.dump());
  const Said again = run({"evaluate", folder / "again.json"});
  REQUIRE(again.code == 0);
  const Json json = Json::parse(again.out);
  CHECK(json.at("feasible") == true);
  CHECK(efficiency(json) == Approx(1));
  CHECK(json.at("features")[0].at("walls_mm").size() == 3);
  CHECK(run({"evaluate", shipped("tee_over_a_recess.json"), "--format", "svg"}).out.find("stands on the track") !=
        std::string::npos);
}
