// query of assemblies: configurations are those of the centre of mass, numbers those of the file, answers are checked
// against hand calculation.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "program.hpp"

using namespace formotion::program;
using Json = nlohmann::ordered_json;

namespace {

// A peg of 10 x 30 mm over a hole of 10.2 mm between blocks, with its compliance centre 15 mm below its centre of mass
// (0, 20). The outline runs clockwise and has a needless corner (number 2), the left block runs clockwise and has one
// on its top (number 1), the right one counter-clockwise. Both tops are at y = 0.
const char* const kPeg = R"({
  "formotion": 1, "name": "peg", "kind": "assembly",
  "part": {"outline_mm": [[-5, 5], [-5, 35], [0, 35], [5, 35], [5, 5]], "flips": true},
  "environment": {
    "friction": 0.2,
    "compliance": {"kx_n_per_mm": 5, "ky_n_per_mm": 50, "ktheta_nmm_per_rad": 5000, "center_mm": [0, 5]},
    "approach": {"direction_deg": -90, "distance_mm": 20}
  },
  "design": {"fixed_mm": [[[-20, 0], [-10, 0], [-5.1, 0], [-5.1, -30], [-20, -30]],
                          [[5.1, -30], [20, -30], [20, 0], [5.1, 0]]]},
  "goal": {"depth_mm": 15, "lateral_mm": 0.5, "tilt_deg": 2, "starts": {"x_mm": [-0.05, 0.05]}}
})";

struct Peg : Folder {
  Peg() { write_file(file, kPeg); }
  std::string file = path + "/peg.json";

  std::vector<Json> ask(const std::vector<Json>& questions) const { return ask_all(file, questions); }
};

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("an assembly's clearance is asked of the centre of mass and not of the compliance centre") {
  const Peg peg;
  const auto answers =
      peg.ask({question("clearance", 0, 20, 0), question("clearance", 0, 15, 0), question("clearance", 0, 10, 0),
               question("clearance", 3, 14, 0), question("clearance", 0, 10, 180),
               question("clearance", 0, 20, 0, "down"), question("clearance", 15, 7, 90)});
  // Over the hole the nearest corners are 0.1 mm aside; in it the walls are.
  const std::vector<double> expected{std::hypot(5, 0.1), 0.1, 0.1, -1, 0.1, std::hypot(5, 0.1), 2};
  for (std::size_t i = 0; i < answers.size(); ++i) {
    CAPTURE(i, answers[i].dump());
    CHECK(answers[i].at("clearance_mm").get<double>() == Approx(expected[i]).margin(1e-9));
    CHECK(answers[i].at("free").get<bool>() == (expected[i] >= 0));
  }
}

TEST_CASE("contacts of assemblies have the file's numbers with clockwise loops and needless corners") {
  const Peg peg;
  const auto answers = peg.ask({
      question("contacts", -12, 15, 0),          // flat on the left block's top, left of its needless corner
      question("contacts", 0.1, 10, 0),          // along the right wall of the hole
      question("contacts", -3.1, 25, 45),        // a lower corner in the air
      question("contacts", 21, 15, 180),         // upside down on the right block
      question("contacts", -12, 15, 0, "down"),  // mirrored: the other lower corner first
      question("contacts", 2.9, 15, 180),        // on the block's other corner, beyond the needless one
  });
  CHECK(contact_names(answers[0]) == Names{"VE 0 [0,0]", "VE 4 [0,1]"});
  CHECK(contact_names(answers[1]) == Names{"EV 3 [1,3]", "VE 4 [1,3]"});
  CHECK(contact_names(answers[2]).empty());
  CHECK(contact_names(answers[3]) == Names{"EV 2 [1,2]", "VE 3 [1,2]"});
  CHECK(contact_names(answers[4]) == Names{"VE 0 [0,1]", "VE 4 [0,0]"});
  CHECK(contact_names(answers[5]) == Names{"EV 1 [1,3]", "VE 1 [1,2]"});
}

TEST_CASE("evaluate names contacts by the same numbers as query does") {
  const Peg peg;
  Json problem = Json::parse(kPeg);
  problem["goal"]["starts"] = {{"x_mm", -12}};  // it comes down on the left block
  write_file(peg.file, problem.dump());
  const Json answer = Json::parse(run({"evaluate", peg.file}).out);
  REQUIRE(answer.at("starts").size() == 1);
  const Json& end = answer["starts"][0];
  REQUIRE_FALSE(end.at("contacts").empty());
  for (const Json& contact : end["contacts"]) {
    CAPTURE(contact.dump());
    CHECK(contact.at("type") == "VE");
    const bool is_left = contact.at("point_mm")[0].get<double>() < -12;
    CHECK(contact.at("moving") == (is_left ? 0 : 4));
    CHECK(contact.at("fixed") == Json{0, is_left ? 0 : 1});
  }
}

TEST_CASE("a free part moves as its carrier and a part on a flat top is held by forces that grow with the stiffness") {
  const Peg peg;
  const auto answers =
      peg.ask({question("motion", 0, 30, 0), question("motion", -12, 15, 0), question("motion", 3, 14, 0)});
  REQUIRE(answers[0].at("motions").size() == 1);
  const Json& carried = answers[0]["motions"][0]["twist"];
  CHECK(carried[0].get<double>() == Approx(0).margin(1e-12));
  CHECK(carried[1].get<double>() == Approx(-1));
  CHECK(carried[2].get<double>() == Approx(0).margin(1e-12));
  REQUIRE(answers[1].at("motions").size() == 1);
  const Json& rest = answers[1]["motions"][0];
  CHECK(rest.at("twist") == Json{0.0, 0.0, 0.0});
  std::array<double, 3> sum{};
  for (const Json& wrench : rest.at("wrenches")) {
    for (std::size_t k = 0; k < 3; ++k) sum[k] += wrench[k].get<double>();
  }
  CHECK(sum[0] == Approx(0).margin(1e-9));
  CHECK(sum[1] == Approx(50));
  CHECK(sum[2] == Approx(0).margin(1e-9));
  CHECK(answers[2].at("error").get<std::string>().find("overlaps") != std::string::npos);
}

TEST_CASE("on one corner a part turns about it as springs in a row say") {
  // Its right end lies on a block from a = 3 mm beside the compliance centre on. Without friction the normal force N,
  // per mm of the carrier, has 1 = N (1/ky + a^2/ktheta).
  const Peg peg;
  Json problem = Json::parse(kPeg);
  problem["environment"]["friction"] = 0;
  problem["design"]["fixed_mm"] = Json::parse("[[[3, 0], [20, 0], [20, -30], [3, -30]]]");
  write_file(peg.file, problem.dump());
  const Json answer = peg.ask(std::vector<Json>{question("motion", 0, 15, 0)})[0];
  REQUIRE(answer.at("motions").size() == 1);
  const Json& motion = answer["motions"][0];
  CAPTURE(answer.dump());
  REQUIRE(contact_names(answer) == Names{"EV 4 [0,0]", "VE 4 [0,0]"});
  // The block's corner carries alone: the right end rises.
  const double a = 3, force = 1 / (1.0 / 50 + a * a / 5000);
  double normal = 0;
  for (const Json& wrench : motion.at("wrenches")) normal += wrench[1].get<double>();
  const double turn = motion["twist"][2].get<double>();
  CHECK(turn == Approx(force * a / 5000));
  CHECK(normal == Approx(force));
  // The centre of mass, 15 mm above the compliance centre, goes left as the part turns.
  CHECK(motion["twist"][0].get<double>() == Approx(-15 * turn));
  CHECK(motion["twist"][1].get<double>() == Approx(-1 + force / 50));
}

TEST_CASE("project follows a start to the contract's outcomes and tells the path of the centre of mass") {
  const Peg peg;
  const auto answers = peg.ask({question("project", 0, 20, 0), question("project", -12, 20, 0),
                                question("project", 3, 14, 0), question("project", 0, 4.5, 0)});
  const Json& in = answers[0];
  CHECK(in.at("outcome") == "assembled");
  CHECK(in.at("path").front().at("y_mm").get<double>() == Approx(20));
  CHECK(in.at("path").front().at("event") == "start");
  CHECK(in.at("path").back().at("event") == "reaches the goal");
  CHECK(in.at("path").back().at("y_mm").get<double>() == Approx(5).margin(1e-5));
  CHECK(in.at("path").back().at("depth_mm").get<double>() == Approx(15).margin(1e-5));
  // On the block both corners stick or none has a reason to slide: it stops at depth 5 with the spring's whole force.
  const Json& on = answers[1];
  CHECK(on.at("outcome") != "assembled");
  CHECK(on.at("path").back().at("y_mm").get<double>() == Approx(15).margin(1e-6));
  CHECK(on.at("path").back().at("event") == "ends here");
  CHECK(on.at("depth_mm").get<double>() == Approx(5).margin(1e-6));
  CHECK(on.at("peak_force_n").get<double>() == Approx(50 * 15.0).margin(1e-2));
  CHECK(answers[2].at("outcome") == "blocked");
  CHECK(answers[2].at("path").size() == 1);
  CHECK(answers[2].at("path")[0].at("event") == "overlaps");
  CHECK(answers[3].at("outcome") == "assembled");  // deep enough where it starts
}

TEST_CASE("a given centre of mass moves what questions mean and nothing else") {
  const Peg peg;
  const Json before = peg.ask({question("clearance", 3, 14, 0), question("clearance", 15, 7, 90, "down")});
  Json problem = Json::parse(kPeg);
  problem["part"]["com_mm"] = {1, 12};  // 1 mm right of where it was and 8 mm lower
  write_file(peg.file, problem.dump());
  // Down the part is mirrored, and by 90 degrees turned: (-1, -8) is then at (8, -1).
  const auto after = peg.ask({question("clearance", 4, 6, 0), question("clearance", 15 + 8, 7 - 1, 90, "down")});
  CHECK(after[0]["clearance_mm"].get<double>() == Approx(before[0]["clearance_mm"].get<double>()));
  CHECK(after[1]["clearance_mm"].get<double>() == Approx(before[1]["clearance_mm"].get<double>()));
  const Json path = peg.ask(std::vector<Json>{question("project", 1, 12, 0)})[0];
  CHECK(path.at("outcome") == "assembled");
  CHECK(path.at("path").back().at("y_mm").get<double>() == Approx(12 - 15).margin(1e-5));
}

TEST_CASE("facets of assemblies name features of the file and touch where they say") {
  const Peg peg;
  const Json all{{"id", 1}, {"type", "facets"}, {"aspect", "up"}};
  const Json answer = peg.ask(std::vector<Json>{all})[0];
  const Json& facets = answer.at("facets");
  REQUIRE(facets.size() > 8);
  std::vector<Json> questions;
  for (const Json& facet : facets) {
    const int moving = facet.at("moving").get<int>(), component = facet.at("fixed")[0].get<int>();
    CHECK(moving >= 0);
    CHECK(moving < 5);
    CHECK(component >= 0);
    CHECK(component < 2);
    CHECK(facet.at("fixed")[1].get<int>() >= 0);
    if (facet.at("type") == "VE") CHECK(moving != 2);  // no corner
    // The ends of its boundary are contacts of these two, unless something else is in the way.
    if (facet.at("boundary").empty()) continue;
    Json q = question("contacts", 0, 0, 0);
    q["q"] = facet["boundary"][0]["from"];
    questions.push_back(q);
  }
  for (const Json& found : peg.ask(questions)) CHECK_FALSE(found.at("contacts").empty());
}

TEST_CASE("what assemblies cannot be asked is an error line and the stream goes on") {
  const Peg peg;
  const Json sweep{{"id", 2}, {"type", "sweep"}}, nowhere{{"id", 4}, {"type", "clearance"}};
  const auto answers = peg.ask({question("support", 0, 20, 0), sweep, question("clearance", 0, 20, 0, "sideways"),
                                nowhere, question("clearance", 0, 20, 0)});
  for (std::size_t i = 0; i < 4; ++i) {
    CAPTURE(answers[i].dump());
    CHECK(answers[i].contains("error"));
  }
  CHECK(answers[0].at("id") == 1);
  CHECK(answers[4].at("free") == true);
}
