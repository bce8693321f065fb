// query of fixtures and pallets: answers against hand calculation, and against what evaluate says of the same places.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "program.hpp"

using namespace formotion::program;
using Json = nlohmann::ordered_json;
using Names = std::vector<std::string>;

namespace {

std::string nest(const std::string& name) { return shipped("../" + name + ".json"); }

// A square of 20 in a vee of 90 degrees whose rims are at y = 30, 5 wide, from x = 30 on. The seat is on a corner.
const std::string kVee = nest("fixture/block_in_vee");
const double kSeat_mm = std::sqrt(200.0);

Json evaluated(const std::string& file) {
  const Said said = run({"evaluate", file});
  CAPTURE(file, said.err);
  REQUIRE(said.code == 0);
  return Json::parse(said.out);
}

// Of a place that evaluate names.
Json let_go(const Json& place) {
  return question("project", place.at("x_mm"), place.at("y_mm"), place.at("orientation_deg"),
                  place.value("aspect", "up"));
}

void check_same_place(const Json& ended, const Json& said, double margin) {
  CAPTURE(ended.dump(), said.dump());
  CHECK(ended.at("x_mm").get<double>() == Approx(said.at("x_mm").get<double>()).margin(margin));
  CHECK(ended.at("y_mm").get<double>() == Approx(said.at("y_mm").get<double>()).margin(margin));
  const double turn = ended.at("theta_deg").get<double>() - said.at("orientation_deg").get<double>();
  CHECK(std::remainder(turn, 360) == Approx(0).margin(margin));
}

}  // namespace

TEST_CASE("the clearance of a block over its vee is that of its sides from the slopes") {
  const auto answers = ask_all(kVee, {question("clearance", 0, 20, 45), question("clearance", 0, kSeat_mm, 45),
                                      question("clearance", 0, kSeat_mm - 1, 45), question("clearance", 32, 45, 0),
                                      question("clearance", 200, 45, 90)});
  const std::vector<double> expected{(20 - kSeat_mm) / std::sqrt(2), 0, -1, 5, std::hypot(155, 5)};
  for (std::size_t i = 0; i < answers.size(); ++i) {
    CAPTURE(i, answers[i].dump());
    CHECK(answers[i].at("clearance_mm").get<double>() == Approx(expected[i]).margin(1e-9));
    CHECK(answers[i].at("free").get<bool>() == (expected[i] >= 0));
  }
}

TEST_CASE("contacts in a nest have the numbers of the file") {
  const auto answers = ask_all(kVee, {question("contacts", 0, kSeat_mm, 45), question("contacts", 32, 40, 0),
                                      question("contacts", 45, 20, 0), question("contacts", 0, 30, 10)});
  CHECK(contact_names(answers[0]) == Names{"VE 0 [0,3]", "VE 0 [0,4]", "VE 1 [0,3]", "VE 3 [0,4]"});
  CHECK(contact_names(answers[1]) == Names{"EV 0 [0,2]", "EV 0 [0,3]"});
  CHECK(contact_names(answers[2]) == Names{"VE 0 [0,1]", "VE 3 [0,1]"});
  CHECK(contact_names(answers[3]).empty());
}

TEST_CASE("a block in its seat stays and its contacts carry the weight") {
  const auto answers = ask_all(
      kVee, {question("motion", 0, kSeat_mm, 45), question("motion", 0, 30, 10), question("motion", 0, 10, 45)});
  REQUIRE(answers[0].at("motions").size() == 1);
  const Json& rest = answers[0]["motions"][0];
  CHECK(rest.at("twist") == Json{0.0, 0.0, 0.0});
  std::array<double, 3> sum{};
  for (const Json& wrench : rest.at("wrenches")) {
    for (std::size_t k = 0; k < 3; ++k) sum[k] += wrench[k].get<double>();
  }
  CHECK(sum[0] == Approx(0).margin(1e-9));
  CHECK(sum[1] == Approx(1));
  CHECK(sum[2] == Approx(0).margin(1e-9));
  REQUIRE(answers[1].at("motions").size() == 1);
  const Json& fall = answers[1]["motions"][0].at("twist");
  CHECK(fall[0].get<double>() == Approx(0).margin(1e-12));
  CHECK(fall[1].get<double>() == Approx(-1));
  CHECK(fall[2].get<double>() == Approx(0).margin(1e-12));
  CHECK(answers[2].at("error").get<std::string>().find("overlaps") != std::string::npos);
}

TEST_CASE("a block let go is seated or misseated or escapes and must rise over the rim to get out") {
  const auto answers = ask_all(kVee, {question("project", 0, 20, 45), question("project", 32, 50, 0),
                                      question("project", 50, 20, 0), question("project", 1000, 5, 45)});
  const Names outcomes{"seated", "misseated", "escaped", "escaped"};
  // The middle of the block passes the rim 10 above it. Where it is beyond the nest already it need not rise.
  const std::vector<double> rises{20, 0, 0, 0};
  for (std::size_t i = 0; i < answers.size(); ++i) {
    CAPTURE(i, answers[i].dump());
    CHECK(answers[i].at("outcome") == outcomes[i]);
    CHECK(answers[i].at("path").front().at("event") == "start");
    const double low = answers[i].at("escape_height_mm")[0], high = answers[i].at("escape_height_mm")[1];
    CHECK(low <= rises[i] + 1e-6);
    CHECK(high >= rises[i] - 1e-6);
    CHECK(high - low <= 0.1 + 1e-9);
  }
  CHECK(answers[0].at("path").back().at("event") == "rests");
  CHECK(answers[0].at("path").back().at("y_mm").get<double>() == Approx(kSeat_mm));
  CHECK(answers[1].at("path").back().at("y_mm").get<double>() == Approx(40));
  CHECK(answers[2].at("path").back().at("event") == "goes on for ever");
}

TEST_CASE("every start that evaluate lists ends in the same way and place when query lets it go") {
  for (const std::string& file : {kVee, nest("pallet/tee_in_a_slot")}) {
    const Json said = evaluated(file);
    Json seat;
    for (const Json& rest : said.at("rests")) {
      if (rest.at("is_seat") == true) seat = rest;
    }
    REQUIRE(seat.is_object());
    std::vector<Json> questions;
    for (const Json& start : said.at("starts")) {
      questions.push_back(question("project", seat["x_mm"].get<double>() + start.at("x_mm").get<double>(),
                                   seat["y_mm"].get<double>() + start.at("y_mm").get<double>(),
                                   seat["orientation_deg"].get<double>() + start.at("theta_deg").get<double>()));
    }
    REQUIRE(questions.size() > 4);
    const auto answers = ask_all(file, questions);
    for (std::size_t i = 0; i < answers.size(); ++i) {
      CAPTURE(file, i, questions[i].dump());
      CHECK(answers[i].at("outcome") == said["starts"][i].at("outcome"));
      if (answers[i]["outcome"] == "seated" || answers[i]["outcome"] == "misseated")
        check_same_place(answers[i].at("path").back(), said["starts"][i].at("end"), 1e-5);
    }
  }
}

TEST_CASE("every rest that evaluate lists is at rest and has an escape height that the brackets share") {
  // Of faces_told_apart the seat as written overlaps its nest by half a millionth of a millimetre.
  for (const std::string& file : {nest("pallet/faces_told_apart"), nest("pallet/tee_in_a_slot")}) {
    const Json said = evaluated(file);
    std::vector<Json> questions;
    for (const Json& rest : said.at("rests")) questions.push_back(let_go(rest));
    REQUIRE(questions.size() > 2);
    const auto answers = ask_all(file, questions);
    std::set<std::string> aspects;
    for (std::size_t i = 0; i < answers.size(); ++i) {
      const Json& rest = said["rests"][i];
      CAPTURE(file, rest.at("escape_height_mm").dump(), answers[i].dump());
      aspects.insert(rest.at("aspect"));
      CHECK(answers[i].at("outcome") == (rest.at("is_seat") == true ? "seated" : "misseated"));
      check_same_place(answers[i].at("path").back(), rest, 1e-4);
      REQUIRE(answers[i].at("escape_height_mm")[1].is_number());
      const double low = answers[i]["escape_height_mm"][0], high = answers[i]["escape_height_mm"][1];
      CHECK(low <= rest["escape_height_mm"][1].get<double>() + 2e-6);
      CHECK(high >= rest["escape_height_mm"][0].get<double>() - 2e-6);
    }
    CHECK(aspects.size() == (file.find("faces") != std::string::npos ? 2 : 1));
  }
}

TEST_CASE("facets of a nest touch where they say") {
  const Json answer = ask_all(kVee, {Json{{"id", 1}, {"type", "facets"}}}).front();
  REQUIRE(answer.at("facets").size() > 8);
  std::vector<Json> questions;
  for (const Json& facet : answer["facets"]) {
    CHECK(facet.at("fixed")[0] == 0);
    CHECK(facet.at("fixed")[1].get<int>() < 7);
    CHECK(facet.at("moving").get<int>() < 4);
    if (facet.at("boundary").empty()) continue;
    Json q = question("contacts", 0, 0, 0);
    q["q"] = facet["boundary"][0]["from"];
    questions.push_back(q);
  }
  REQUIRE(questions.size() > 8);
  for (const Json& found : ask_all(kVee, questions)) CHECK_FALSE(found.at("contacts").empty());
}

TEST_CASE("what nests cannot be asked is an error in words and the stream goes on") {
  const std::string file = nest("pallet/faces_told_apart");
  Json no_aspect = question("clearance", 0, 50, 0), no_theta = question("project", 0, 50, 0);
  Json tolerance = question("project", 0, 50, 0), extra = question("motion", 0, 50, 0);
  no_aspect.erase("aspect");
  no_theta["q"].erase("theta_deg");
  tolerance["tolerance_mm"] = 0.1;
  extra["q"]["z_mm"] = 3;
  const std::vector<std::pair<Json, std::string>> asked{
      {question("support", 0, 50, 0), "'support' in a nest"},
      {Json{{"id", 1}, {"type", "sweep"}}, "'sweep' of a nest"},
      {question("escape", 0, 50, 0), "the unknown type 'escape'"},
      {question("projekt", 0, 50, 0), "did you mean 'project'?"},
      {question("clearance", 0, 50, 0, "sideways"), "expected one of up, down"},
      {no_aspect, "expected one of up, down"},
      {no_theta, "/q/theta_deg"},
      {Json{{"id", 1}, {"type", "project"}, {"aspect", "up"}}, "/q: nothing"},
      {Json{{"id", 1}, {"aspect", "up"}}, "/type"},
      {tolerance, "unknown key 'tolerance_mm'"},
      {extra, "z_mm"},
      {question("project", 0, -15, 0), "overlaps what is fixed by "},
      {question("motion", 0, -15, 0), "overlaps what is fixed by "},
      {question("clearance", 2e9, 0, 0), "at most 1e9"},
      {Json{1, 2}, ""},
  };
  std::vector<Json> questions;
  for (const auto& [line, words] : asked) questions.push_back(line);
  questions.push_back(question("clearance", 0, 1000, 0));
  const auto answers = ask_all(file, questions);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    CAPTURE(i, answers[i].dump());
    REQUIRE(answers[i].contains("error"));
    CHECK(answers[i]["error"].get<std::string>().find(asked[i].second) != std::string::npos);
  }
  CHECK(answers.back().at("free") == true);
}
