// query: numbers of corners and edges are the file's own, answers are checked against hand calculation.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "program.hpp"

using namespace formotion::program;
using Json = nlohmann::ordered_json;

namespace {

// A plate of 30 x 12 mm, drawn clockwise and with a needless corner (number 3), its hole's corners 5 to 7; the
// obstacles are: 1 a fence drawn clockwise, 2 a pin, 3 a step of 4 mm up and a recess of 2 mm.
const char* const kPlate = R"({
  "formotion": 1, "name": "plate", "kind": "feeder",
  "part": {"outline_mm": [[0,0],[0,12],[30,12],[30,6],[30,0]], "holes_mm": [[[10,5],[14,5],[12,8]]],
           "com_mm": [15, 6], "thickness_mm": 3, "flips": true},
  "environment": {"track_width_mm": 60, "wall_friction": 0.2},
  "design": {"features": [
    {"type": "fence", "at_mm": 200, "polygon_mm": [[10, 20], [0, 40], [20, 40]]},
    {"type": "pin", "at_mm": 300, "x_mm": 2, "y_mm": 9, "diameter_mm": 4},
    {"type": "wall", "at_mm": 400, "profile_mm": [[0, 4], [50, 4], [50, -2], [100, -2]]}
  ]},
  "goal": {"deliver": "one pose"}
})";

struct Problem : Folder {
  Problem() { write_file(file, kPlate); }
  std::string file = path + "/plate.json";

  std::vector<Json> ask_all(const std::vector<Json>& questions) const {
    return formotion::program::ask_all(file, questions);
  }
  Json ask(const Json& question) const { return ask_all({question}).front(); }
};

Json within(Json question, double tolerance) {
  question["tolerance_mm"] = tolerance;
  return question;
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("clearance is the distance, 0 in contact, and minus the way out of an overlap") {
  const Problem problem;
  const std::vector<Json> answers = problem.ask_all(
      {question("clearance", 0, 9.5, 0), question("clearance", 0, 6, 0), question("clearance", 0, 5.25, 0),
       question("clearance", 282, 9, 0), question("clearance", 280, 22, 0), question("clearance", 425, 6, 0),
       question("clearance", 475, 4.5, 0), question("clearance", 210, 17, 0)});
  const std::vector<double> expected{3.5, 0, -0.75, 3, std::hypot(7, 7) - 2, -4, 0.5, -3};
  for (std::size_t i = 0; i < answers.size(); ++i) {
    CAPTURE(i, answers[i].dump());
    CHECK(answers[i].at("clearance_mm").get<double>() == Approx(expected[i]).margin(1e-9));
    CHECK(answers[i].at("free").get<bool>() == (expected[i] >= 0));
  }
}

TEST_CASE("contacts have the numbers of the file, however the outlines run") {
  const Problem problem;
  const std::vector<Json> answers = problem.ask_all({
      question("contacts", 0, 6, 0),     // flat on the wall
      question("contacts", 0, 6, 180),   // on the other long edge
      question("contacts", 285, 12, 0),  // the pin under the needless corner: the edge below it
      question("contacts", 285, 6, 0),   // and above it, while it lies on the wall
      question("contacts", 210, 14, 0),  // the fence's tip on the long edge
      question("contacts", 285, 6, 0, "down"), question("contacts", 430, 10, 0),  // on the step
      question("contacts", 455, 10, 0),                                           // over the step's end
      question("contacts", 465, 4, 0),                                            // in the recess, at the step
      question("contacts", 485, 4, 0),  // in the recess, at its end, which is the wall's own
      question("contacts", 385, 6, 0),  // before the step
      question("contacts", 0, 200, 0),  // nowhere
  });
  const std::vector<Names> expected{
      {"VE 0 [0,0]", "VE 4 [0,0]"},
      {"VE 1 [0,0]", "VE 2 [0,0]"},
      {"EV 3 [2,0]"},
      {"EV 2 [2,0]", "VE 0 [0,0]", "VE 4 [0,0]"},
      {"EV 1 [1,0]"},
      {"EV 0 [2,0]", "VE 0 [0,0]", "VE 4 [0,0]"},
      {"VE 0 [3,0]", "VE 4 [3,0]"},
      {"EV 4 [3,1]", "VE 0 [3,0]"},
      {"EV 0 [3,1]", "VE 0 [3,1]", "VE 0 [3,2]", "VE 4 [3,2]"},
      {"EV 3 [0,4]", "VE 0 [3,2]", "VE 4 [0,3]", "VE 4 [3,2]"},
      {"EV 3 [3,0]", "VE 0 [0,0]", "VE 4 [0,0]", "VE 4 [3,5]"},
      {},
  };
  for (std::size_t i = 0; i < answers.size(); ++i) {
    CAPTURE(i, answers[i].dump());
    CHECK(contact_names(answers[i]) == expected[i]);
  }
  const Json& pin = answers[2].at("contacts")[0];
  CHECK(pin.at("point_mm")[0].get<double>() == Approx(300));
  CHECK(pin.at("point_mm")[1].get<double>() == Approx(9));
  CHECK(pin.at("normal")[0].get<double>() == Approx(-1));
}

TEST_CASE("a larger tolerance finds contacts that are not there yet") {
  const Problem problem;
  CHECK(contact_names(problem.ask(question("contacts", 0, 6.01, 0))).empty());
  CHECK(contact_names(problem.ask(within(question("contacts", 0, 6.01, 0), 0.02))) ==
        Names{"VE 0 [0,0]", "VE 4 [0,0]"});
}

TEST_CASE("along the wall a part slides with what friction leaves of the drive, against a pin it rests") {
  const Problem problem;
  const Json sliding = problem.ask(question("motion", 0, 6, 0));
  CHECK(contact_names(sliding) == Names{"VE 0 [0,0]", "VE 4 [0,0]"});
  REQUIRE(sliding.at("motions").size() == 1);
  const Json& motion = sliding["motions"][0];
  CHECK(motion.at("twist")[0].get<double>() == Approx(std::cos(M_PI / 6) - 0.2 * 0.5));
  CHECK(motion.at("twist")[1].get<double>() == Approx(0).margin(1e-12));
  CHECK(motion.at("twist")[2].get<double>() == Approx(0).margin(1e-12));
  CHECK(motion.at("modes") == Json{"sliding-right", "sliding-right"});
  // The forces carry the drive's push to the wall, and balance about the centre of mass.
  std::array<double, 3> sum{};
  for (const Json& wrench : motion.at("wrenches")) {
    for (std::size_t k = 0; k < 3; ++k) sum[k] += wrench[k].get<double>();
  }
  CHECK(sum[0] == Approx(-0.1));
  CHECK(sum[1] == Approx(0.5));
  CHECK(sum[2] == Approx(0).margin(1e-9));

  // Flush with the wall at a step: nothing can move it.
  const Json rests = problem.ask(question("motion", 385, 6, 0));
  REQUIRE(rests.at("motions").size() == 1);
  for (std::size_t k = 0; k < 3; ++k) CHECK(rests["motions"][0]["twist"][k].get<double>() == 0);
  CHECK(rests["motions"][0]["modes"].size() == rests["contacts"].size());
  // In the air it goes where the drive points.
  const Json free = problem.ask(question("motion", 0, 50, 30));
  CHECK(free.at("contacts").empty());
  CHECK(free.at("motions")[0].at("twist")[0].get<double>() == Approx(std::cos(M_PI / 6)));
  CHECK(free.at("motions")[0].at("twist")[1].get<double>() == Approx(-0.5));
}

TEST_CASE("a projection goes from the start to where the part stays, or for ever") {
  const Problem problem;
  const Json jams = problem.ask(question("project", 350, 6, 0));
  CHECK(jams.at("outcome") == "jammed");
  const Json& path = jams.at("path");
  CHECK(path.front() == Json{{"x_mm", 350.0}, {"y_mm", 6.0}, {"theta_deg", 0.0}, {"event", "start"}});
  CHECK(path.back().at("x_mm").get<double>() == Approx(385).margin(1e-6));
  CHECK(path.back().at("y_mm").get<double>() == Approx(6).margin(1e-6));
  const Json passes = problem.ask(question("project", 600, 20, 3));
  CHECK(passes.at("outcome") == "delivered");
  CHECK(passes.at("path").back().at("y_mm").get<double>() == Approx(6).margin(1e-6));
  CHECK(passes.at("path").back().at("theta_deg").get<double>() == Approx(0).margin(1e-6));
}

TEST_CASE("facets name each pair of features that can touch, with their orientations and neighbours") {
  const Problem problem;
  const Json answer = problem.ask(Json{{"id", 9}, {"type", "facets"}, {"aspect", "up"}});
  const Json& facets = answer.at("facets");
  int pin_edges = 0, pin_corners = 0;
  std::vector<int> on_face;
  for (std::size_t i = 0; i < facets.size(); ++i) {
    const Json& facet = facets[i];
    const double width = facet.at("theta_deg")[1].get<double>() - facet["theta_deg"][0].get<double>();
    CHECK(width > 0);
    if (facet.at("fixed")[0] == 2) (facet.at("type") == "EV" ? pin_edges : pin_corners)++;
    if (facet.at("fixed") == Json{0, 0} && facet.at("type") == "VE") {
      on_face.push_back(facet.at("moving").get<int>());
      CHECK(width == Approx(90));
    }
    for (const Json& curve : facet.at("boundary")) {
      for (const Json& neighbour : curve.at("neighbours")) {
        const auto k = neighbour.get<std::size_t>();
        REQUIRE(k < facets.size());
        CHECK(k != i);
      }
    }
  }
  CHECK(pin_edges == 4 + 3);  // the outline's edges (the needless corner is none) and the hole's
  CHECK(pin_corners == 4);    // the hole's corners are not convex
  std::sort(on_face.begin(), on_face.end());
  CHECK(on_face == std::vector<int>{0, 1, 2, 4});
}

TEST_CASE("questions that make no sense are errors in words, and the others are answered") {
  const Problem problem;
  Json facets{{"id", "f"}, {"type", "facets"}, {"aspect", "up"}, {"q", {{"x_mm", 0}, {"y_mm", 0}, {"theta_deg", 0}}}};
  Json unnamed = question("clearance", 0, 9, 0);
  unnamed.erase("aspect");
  const std::vector<Json> answers =
      problem.ask_all({question("motion", 0, 5, 0), question("project", 0, 5, 0), question("clearence", 0, 9, 0),
                       within(question("clearance", 0, 9, 0), 0.1), within(question("contacts", 0, 9, 0), -1), facets,
                       unnamed, question("clearance", 0, 9, 0)});
  const std::vector<std::string> words{"overlaps what is fixed by ", "overlaps what is fixed by ",
                                       "did you mean 'clearance'?",  "unknown key 'tolerance_mm'",
                                       "expected a number above 0",  "unknown key 'q'",
                                       "expected one of up, down"};
  for (std::size_t i = 0; i < words.size(); ++i) {
    CAPTURE(i, answers[i].dump());
    REQUIRE(answers[i].contains("error"));
    CHECK(answers[i]["error"].get<std::string>().find(words[i]) != std::string::npos);
  }
  CHECK(answers.back().at("clearance_mm") == 3.0);
}

TEST_CASE("a sweep is what a motion leaves of a region") {
  const Problem problem;
  const Json path{{{"x_mm", -50}, {"y_mm", 6}, {"theta_deg", 0}}, {{"x_mm", 50}, {"y_mm", 6}, {"theta_deg", 0}}};
  const Json region{{-10, 0}, {10, 0}, {10, 20}, {-10, 20}};
  const Json sweep{{"id", 1}, {"type", "sweep"}, {"aspect", "up"}, {"path", path}, {"region_mm", region}};
  const Json answer = problem.ask(sweep);
  REQUIRE(answer.at("pieces").size() == 1);
  double lowest = 20;
  for (const Json& p : answer.at("polygon_mm")) lowest = std::min(lowest, p[1].get<double>());
  CHECK(lowest >= 12);
  CHECK(lowest <= 12 + answer.at("precision_mm").get<double>());
  Json bad = sweep;
  bad.erase("path");
  CHECK(problem.ask(bad).at("error").get<std::string>().find("/path") != std::string::npos);
  bad = sweep;
  bad["region_mm"] = {{0, 0}, {10, 10}, {10, 0}, {0, 10}};
  CHECK(problem.ask(bad).at("error").get<std::string>().find("/region_mm") != std::string::npos);
}
