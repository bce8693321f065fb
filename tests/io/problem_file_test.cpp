#include "io/problem_file.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "io/json_document.hpp"
#include "io/patched.hpp"

using namespace formotion;
using Json = nlohmann::ordered_json;

namespace {

const char* const kGood = R"({
  "formotion": 1, "name": "el", "kind": "feeder",
  "part": {"outline_mm": [[0,0],[30,0],[30,10],[10,10],[10,20],[0,20]], "thickness_mm": 3, "flips": true},
  "environment": {"track_width_mm": 40},
  "variables": {"w": {"min": 6, "max": 20, "value": 9}, "v": {"min": 1, "max": 3}},
  "design": {"features": [{"type": "balcony", "width_mm": "w", "length_mm": "2*v + 58"}]},
  "goal": {"deliver": "one pose"}
})";

std::string patched(const std::string& pointer, const std::string& value) {
  return formotion::patched(kGood, pointer, value);
}

}  // namespace

TEST_CASE("a good problem is read as it stands") {
  const ProblemFile file = parse_problem(kGood, "p.json");
  CHECK(file.name == "el");
  CHECK(file.kind == "feeder");
  CHECK(file.search.evaluations == 20000);
  CHECK(file.search.seed == 1);
  REQUIRE(file.feeder.part.aspects.size() == 2);
  CHECK(file.feeder.part.aspects[1].name == "down");
  CHECK(file.feeder.part.aspects[1].probability == 0.5);
  CHECK(file.feeder.part.aspects[1].outline_mm[1][0].constant == -30);
  CHECK(file.feeder.environment.wall_friction == 0.2);
  CHECK(file.feeder.environment.conveying_speed_mm_s == 50);
  REQUIRE(file.feeder.objectives.size() == 3);
  CHECK(file.feeder.objectives[1].name == "tolerance_mm");
  const auto& balcony = std::get<feeder::Balcony>(file.feeder.designs[0][0].shape);
  CHECK(balcony.length_mm(std::vector<double>{9, 2}) == 62);
}

TEST_CASE("the canonical problem is a problem, and its own canonical form") {
  const ProblemFile file = parse_problem(kGood, "p.json");
  CHECK(parse_problem(file.canonical, "q.json").canonical == file.canonical);
}

TEST_CASE("folders' names are safe whatever the problem's name") {
  CHECK(parse_problem(patched("/name", "\"el bracket\""), "p.json").slug == "el_bracket");
  CHECK(parse_problem(patched("/name", "\"../../etc/passwd\""), "p.json").slug == "etc_passwd");
  CHECK(parse_problem(patched("/name", "\"\xc3\xa4\xc3\xb6\""), "p.json").slug == "problem");
}

TEST_CASE("each kind of bad input is one issue, at its place, in words") {
  const std::vector<Bad> all{
      {"/formotion", "2", "/formotion", "expected 1"},
      {"/formotion", "~", "/formotion", "nothing"},
      {"/name", "\"\"", "/name", "an empty name"},
      {"/name", "7", "/name", "expected a string"},
      {"/kind", "\"fixtures\"", "/kind", "did you mean"},
      {"/kind", "\"feder\"", "/kind", "did you mean 'feeder'?"},
      {"/part", "~", "/part", "nothing"},
      {"/part", "[]", "/part", "expected an object"},
      {"/part/thicknes_mm", "3", "/part/thicknes_mm", "did you mean 'thickness_mm'?"},
      {"/part/thickness_mm", "~", "/part/thickness_mm", "nothing"},
      {"/part/thickness_mm", "0", "/part/thickness_mm", "a number above 0"},
      {"/part/thickness_mm", "-1", "/part/thickness_mm", "a number above 0"},
      {"/part/thickness_mm", "\"3\"", "/part/thickness_mm", "\"3\""},
      {"/part/thickness_mm", "1e300", "/part/thickness_mm", "at most 1e9"},
      {"/part/outline_mm", "[[0,0],[1,0]]", "/part/outline_mm", "three corners"},
      {"/part/outline_mm", "[[0,0],[10,0],[0,10],[10,10]]", "/part/outline_mm", "meets itself"},
      {"/part/outline_mm", "[[0,0],[10,0],[5,0]]", "/part/outline_mm", "different corners"},
      {"/part/outline_mm/2", "[30]", "/part/outline_mm/2", "a corner [x, y]"},
      {"/part/outline_mm/2", "[30,null]", "/part/outline_mm/2/1", "null"},
      {"/part/outline_mm/2", "[\"w*w\",10]", "/part/outline_mm/2/0", "product of two variables"},
      {"/part/outline_mm/2", "[\"nope\",10]", "/part/outline_mm/2/0", "unknown variable 'nope'"},
      {"/part/holes_mm", "[[[100,100],[101,100],[101,101]]]", "/part/holes_mm/0", "lies outside of the outline"},
      {"/part/holes_mm", "[[[1,1],[4,1],[4,4]],[[2,2],[5,2],[5,5]]]", "/part/holes_mm/1", "meets hole 0"},
      {"/part/com_mm", "[100,100]", "/part/com_mm", "centre of mass outside"},
      {"/part/com_mm", "[1]", "/part/com_mm", "a point [x, y]"},
      {"/part/flips", "1", "/part/flips", "true or false"},
      {"/part/file", "\"missing.dxf\"", "/part/file", "both file and outline_mm"},
      {"/environment", "~", "/environment", "track_width_mm"},
      {"/environment/track_width_mm", "~", "/environment/track_width_mm", "the track's width"},
      {"/environment/track_width_mm", "0", "/environment/track_width_mm", "a number above 0"},
      {"/environment/tilt_deg", "75", "/environment/tilt_deg", "from -60 to 60"},
      {"/environment/wall_friction", "-0.1", "/environment/wall_friction", "from 0 to 10"},
      {"/environment/mobility", "{\"radius\": 3}", "/environment/mobility/radius", "unknown key"},
      {"/variables/w/min", "30", "/variables/w/min", "at most max"},
      {"/variables/w/value", "50", "/variables/w/value", "from 6"},
      {"/variables/w/max", "\"a\"", "/variables/w/max", "expected a number"},
      {"/variables/9x", "{\"min\": 0, \"max\": 1}", "/variables/9x", "beginning with a letter"},
      {"/variables/u", "{\"min\": 0, \"max\": 1}", "/variables/u", "nothing uses"},
      {"/design/features", "[]", "/design/features", "at least one feature"},
      {"/design/features/0/type", "~", "/design/features/0/type", "nothing"},
      {"/design/features/0/type", "\"balkony\"", "/design/features/0/type", "did you mean 'balcony'?"},
      {"/design/features/0/type", "\"fense\"", "/design/features/0/type", "did you mean 'fence'?"},
      {"/design/features/0/width", "3", "/design/features/0/width", "did you mean 'width_mm'?"},
      {"/design/features/0/length_mm", "-3", "/design/features/0/length_mm", "at least 0"},
      {"/design/features/0/length_mm", "\"58+2*v/0\"", "/design/features/0/length_mm", "division by zero"},
      {"/design/features/0/length_mm", "\"58+2*v/w\"", "/design/features/0/length_mm", "division by a variable"},
      {"/design/features/0/length_mm", "\"(58+2*v\"", "/design/features/0/length_mm", "missing ')'"},
      {"/design/features/0/length_mm", "\"2*vv\"", "/design/features/0/length_mm", "did you mean 'v'?"},
      {"/design/features/1", R"({"type": "canyon", "from_mm": 5, "to_mm": 5, "length_mm": 9})",
       "/design/features/1/from_mm", "below to_mm"},
      {"/design/features/1", R"({"type": "dish-out", "depth_mm": 6, "length_mm": 9})", "/design/features/1/depth_mm",
       "half of length_mm"},
      {"/design/features/1", R"({"type": "scallop", "depth_mm": 6, "half_angle_deg": 90})",
       "/design/features/1/half_angle_deg", "below 89.9"},
      {"/design/features/1", R"({"type": "cutout", "polygon_mm": [[0,0],[9,0],[0,9],[9,9]]})",
       "/design/features/1/polygon_mm", "meets itself"},
      {"/design/features/1", R"({"type": "fence", "polygon_mm": [[0,0],[9,0],[0,9],[9,9]]})",
       "/design/features/1/polygon_mm", "meets itself"},
      {"/design/features/1", R"({"type": "fence", "polygon_mm": [[0,0],[9,0]]})", "/design/features/1/polygon_mm",
       "three corners"},
      {"/design/features/1", R"({"type": "fence"})", "/design/features/1/polygon_mm", "three corners"},
      {"/design/features/1", R"({"type": "fence", "poligon_mm": [], "polygon_mm": [[0,0],[9,0],[0,9]]})",
       "/design/features/1/poligon_mm", "did you mean 'polygon_mm'?"},
      {"/design/features/1", R"({"type": "wall", "profile_mm": [[0,0]]})", "/design/features/1/profile_mm",
       "two corners"},
      {"/design/features/1", R"({"type": "wall", "profile_mm": [[9,0],[0,4]]})", "/design/features/1/profile_mm",
       "not before its last"},
      {"/design/features/1", R"({"type": "wall", "profile_mm": [[0,0],[12,4],[9,0]]})", "/design/features/1/profile_mm",
       "leaves the stretch"},
      {"/design/features/1", R"({"type": "wall", "profile_mm": [[0,0],[6,5],[6,2],[3,4],[9,0]]})",
       "/design/features/1/profile_mm", "meets itself"},
      {"/design/features/1", R"({"type": "wall", "profile_mm": [[0,0],["z",2],[9,0]]})",
       "/design/features/1/profile_mm/1/0", "unknown variable 'z'"},
      {"/design/features/1", R"({"type": "pin", "x_mm": 0, "y_mm": 4, "diameter_mm": 0})",
       "/design/features/1/diameter_mm", "above 0"},
      {"/design/features/1", R"({"type": "pin", "x_mm": 0, "diameter_mm": 3})", "/design/features/1/y_mm", "nothing"},
      {"/environment/start_y_mm", "0", "/environment/start_y_mm", "a number above 0"},
      {"/goal", "~", "/goal", "nothing"},
      {"/goal/deliver", "\"two poses\"", "/goal/deliver", "one pose"},
      {"/goal/deliver", R"({"aspect": "up", "orientation_deg": 45})", "/goal/deliver", "up 0.00 deg"},
      {"/goal/deliver", R"({"aspect": "side", "orientation_deg": 0})", "/goal/deliver/aspect", "unknown aspect"},
      {"/goal/deliver", R"({"orientation_deg": 0})", "/goal/deliver/aspect", "nothing"},
      {"/goal/require_tip", "\"yes\"", "/goal/require_tip", "true or false"},
      {"/search", R"({"evaluations": 0})", "/search/evaluations", "at least 1"},
      {"/search", R"({"evaluations": 1.5})", "/search/evaluations", "a whole number"},
      {"/search", R"({"seed": -1})", "/search/seed", "at least 0"},
      {"/search", R"({"objectives": ["efficency"]})", "/search/objectives/0", "did you mean 'efficiency'?"},
      {"/search", R"({"objectives": ["length_mm", "length_mm"]})", "/search/objectives/1", "again"},
      {"/search", R"({"objectives": []})", "/search/objectives", "an array"},
      {"/manufacture", R"({"cutter_radius_mm": -1})", "/manufacture/cutter_radius_mm", "at least 0"},
      {"/uncertainty", R"({"drive_deg": [10, -10]})", "/uncertainty/drive_deg", "min not above max"},
      {"/uncertainty", R"({"drive_deg": 10})", "/uncertainty/drive_deg", "an interval"},
      {"/extra", "1", "/extra", "unknown key 'extra'"},
  };
  for (const Bad& bad : all) {
    std::vector<InputIssue> issues = issues_of(patched(bad.pointer, bad.value));
    if (bad.words != "nothing uses") {  // a design that cannot be read uses nothing
      std::erase_if(issues, [](const InputIssue& issue) { return issue.found == "a variable that nothing uses"; });
    }
    CAPTURE(bad.pointer, bad.value);
    REQUIRE(issues.size() == 1);
    const std::string line = to_line(issues[0]);
    CAPTURE(line);
    CHECK(issues[0].where == bad.where);
    CHECK(line.find(bad.words) != std::string::npos);
    CHECK(line.rfind("error: p.json:", 0) == 0);
    CHECK(line.find('\n') == std::string::npos);
  }
}

TEST_CASE("a problem has exactly one of design, topologies and grammar") {
  const auto says = [](const std::string& text) {
    const auto issues = issues_of(text);
    return std::any_of(issues.begin(), issues.end(), [](const InputIssue& issue) {
      return issue.where.empty() && issue.expected == "exactly one of design, topologies and grammar";
    });
  };
  CHECK(says(patched("/topologies", R"([{"features": [{"type": "gap", "length_mm": 3}]}])")));
  CHECK(says(patched("/design", "~")));
  CHECK(says(patched("/grammar", "{}")));
  CHECK_FALSE(says(kGood));
}

TEST_CASE("all errors of a file come at once") {
  Json document = Json::parse(kGood);
  document["part"]["thickness_mm"] = 0;
  document["environment"]["tilt"] = 5;
  document["design"]["features"][0]["width_mm"] = "q";
  document["goal"]["deliver"] = 1;
  document["variables"]["idle"] = {{"min", 0}, {"max", 1}};
  std::vector<std::string> where;
  for (const InputIssue& issue : issues_of(document.dump())) where.push_back(issue.where);
  for (const char* expected :
       {"/part/thickness_mm", "/environment/tilt", "/design/features/0/width_mm", "/goal/deliver", "/variables/idle"}) {
    CHECK(std::count(where.begin(), where.end(), expected) == 1);
  }
}

TEST_CASE("text that is no JSON names its line and column, duplicate keys their place") {
  auto issues = issues_of("{\n  \"formotion\": 1,\n  \"name\": \"a\"\n  \"kind\": 2}");
  REQUIRE(issues.size() == 1);
  CHECK(to_line(issues[0]).rfind("error: p.json:4:", 0) == 0);
  issues = issues_of(R"({"formotion": 1, "part": {"flips": true, "flips": false}})");
  REQUIRE_FALSE(issues.empty());
  CHECK(issues[0].where == "/part/flips");
  CHECK(to_line(issues[0]).find("again") != std::string::npos);
  CHECK_FALSE(issues_of("").empty());
  CHECK_FALSE(issues_of("[1,2]").empty());
  CHECK_FALSE(issues_of(std::string(100000, '[')).empty());
  CHECK_FALSE(issues_of("{\"formotion\": 1e999}").empty());
  CHECK_FALSE(issues_of(std::string("{\"name\": \"\xff\xfe\"}")).empty());
}

TEST_CASE("files that are no files are errors in words") {
  for (const char* path : {"/no/such/file.json", "/", "/dev/zero"}) {
    CHECK_THROWS_AS(read_problem_file(path), InputError);
  }
}

TEST_CASE("every shipped problem is good, and its canonical form says the same") {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(FORMOTION_SOURCE_DIR "/problems/feeder")) {
    if (entry.path().extension() != ".json") continue;
    ++count;
    CAPTURE(entry.path().string());
    const ProblemFile file = read_problem_file(entry.path().string());
    CHECK(file.slug == entry.path().stem().string());
    CHECK(parse_problem(file.canonical, "elsewhere.json").canonical == file.canonical);
  }
  CHECK(count >= 1);
}
