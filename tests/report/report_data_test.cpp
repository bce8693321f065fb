#include "report/report_data.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "analysis/constraints/hull_margin.hpp"
#include "report/knee.hpp"
#include "report/report_page.hpp"

using namespace formotion;
using Json = nlohmann::ordered_json;

namespace {

// A run over an el bracket, of candidates drawn at random: two choices of features.
struct Run {
  ProblemFile file;
  feeder::FeederProblem problem;
  RunSummary run;

  explicit Run(int count, const std::string& text = problem_text("el bracket"))
      : file(parse_problem(text, "problems/el bracket.json")), problem(file.feeder) {
    std::mt19937 random(7);
    for (int i = 1; i <= count; ++i) {
      Evaluated e;
      e.number = i;
      e.candidate.topology = i % static_cast<int>(problem.topologies().size());
      for (const int v : problem.topologies()[static_cast<std::size_t>(e.candidate.topology)].variables) {
        const Variable& variable = problem.variables()[static_cast<std::size_t>(v)];
        e.candidate.values.push_back(variable.min + (variable.max - variable.min) * (random() / 4294967296.0));
      }
      e.score = problem.score(e.candidate);
      e.provenance = "a test";
      run.feasible += e.score.feasible ? 1 : 0;
      run.sample.push_back(e);
    }
    run.evaluations = run.budget = count;
    run.program_version = "0";
    run.complete = true;
    RunProgress progress;
    progress.evaluations = count;
    progress.front_size = 1;
    progress.best.assign(problem.objectives().size(), 0.0);
    run.history = {progress};
  }

  static std::string problem_text(const std::string& name) {
    Json json = Json::parse(R"({
      "formotion": 1, "name": "", "kind": "feeder",
      "part": {"outline_mm": [[0,0],[30,0],[30,10],[10,10],[10,20],[0,20]], "thickness_mm": 3, "flips": true},
      "environment": {"track_width_mm": 40, "tilt_deg": 5},
      "variables": {"w": {"min": 6, "max": 20}, "x": {"min": 0, "max": 30}, "y": {"min": 5, "max": 20}},
      "topologies": [
        {"features": [{"type": "cutout", "polygon_mm": [["x", "y"], [28, 0.5], [40, "y"]]}]},
        {"features": [{"type": "balcony", "width_mm": "w", "length_mm": 60}, {"type": "gap", "length_mm": "y"}]}
      ],
      "goal": {"deliver": "one pose"}
    })");
    json["name"] = name;
    return json.dump();
  }
};

// The margin at a position, from the exported corners of the hull; the least of just before, at and behind it.
double margin_of(const Json& pose, const Json& travel, double x) {
  double least = INFINITY;
  const Point supported(0, pose["supported_y_mm"]);
  for (const double at : {x - 3e-4, x, x + 3e-4}) {
    Loop corners;
    for (const Json& group : travel["groups"]) {
      if (at < group["from_mm"] || at > group["to_mm"]) continue;
      for (const Json& g : group["generators"]) {
        const double in = g[0], out = g[1];
        if (at < in - 1e-4 || at > out + 1e-4) continue;
        Point p(g[2], g[3]);
        if (g.size() == 6) p += std::clamp((at - in) / (out - in), 0.0, 1.0) * (Point(g[4], g[5]) - p);
        corners.push_back(p - supported);
      }
    }
    if (!corners.empty()) least = std::min(least, hull_margin(corners).margin_mm);
  }
  return least;
}

}  // namespace

TEST_CASE("the knee is the design farthest from the line through the extremes") {
  // Hand derivation: the line is x + y = 1; (0.2, 0.2) is 0.6 / sqrt(2) from it, (0.1, 0.6) is 0.3 / sqrt(2).
  const std::vector<std::vector<double>> losses{{0, 1}, {0.1, 0.6}, {0.2, 0.2}, {1, 0}};
  const std::optional<Knee> found = knee(losses);
  REQUIRE(found);
  CHECK(found->index == 2);
  CHECK(found->distance == Approx(0.6 / std::sqrt(2.0)));
}

TEST_CASE("the knee does not change with units, nor with an objective in which nothing differs") {
  std::mt19937 random(3);
  for (int round = 0; round < 50; ++round) {
    std::vector<std::vector<double>> losses, other;
    for (int i = 0; i < 12; ++i) {
      const double a = static_cast<double>(random()) / random.max(), b = static_cast<double>(random()) / random.max();
      losses.push_back({a, b, 1 - std::sqrt(a * b)});
      other.push_back({1000 * a - 5, 0.125 * b, 3.5, 2 * (1 - std::sqrt(a * b)) + 1});
    }
    const std::optional<Knee> one = knee(losses), two = knee(other);
    REQUIRE(one.has_value() == two.has_value());
    if (one) CHECK(one->index == two->index);
  }
}

TEST_CASE("the knee of three objectives is the design farthest from the plane through the extremes") {
  // Hand derivation: the plane is x + y + z = 2; the fourth design is 0.5 / sqrt(3) below it, the fifth 0.2 / sqrt(3).
  const std::optional<Knee> found = knee({{0, 1, 1}, {1, 0, 1}, {1, 1, 0}, {0.5, 0.5, 0.5}, {0.4, 0.6, 0.8}});
  REQUIRE(found);
  CHECK(found->index == 3);
  CHECK(found->distance == Approx(0.5 / std::sqrt(3.0)));
}

TEST_CASE("where the best designs of the objectives span no plane, the worst corners do") {
  // (0, 1, 0) is best in the first and the third objective, so two designs are left for three corners. The plane
  // through the worst corners is x + y + z = 2; the last design is 1.4 / sqrt(3) below it, the others 1 / sqrt(3).
  const std::optional<Knee> found = knee({{0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {0.2, 0.2, 0.2}});
  REQUIRE(found);
  CHECK(found->index == 3);
  CHECK(found->distance == Approx(1.4 / std::sqrt(3.0)));
}

TEST_CASE("there is no knee where the front does not bulge, with few designs, or with one objective") {
  CHECK_FALSE(knee({}));
  CHECK_FALSE(knee({{0, 1}, {1, 0}}));
  CHECK_FALSE(knee({{0, 1}, {0.5, 0.5}, {1, 0}}));
  CHECK_FALSE(knee({{0, 1}, {0.7, 0.7}, {1, 0}}));
  CHECK_FALSE(knee({{3}, {2}, {1}}));
  CHECK_FALSE(knee({{3, 1}, {2, 1}, {1, 1}}));
  CHECK(knee({{0, 1}, {0.2, 0.2}, {0.2, 0.2}, {1, 0}})->index == 1);
}

TEST_CASE("the exported hull corners give the margins that the program judged by") {
  Run run(60);
  run.run.front = run.run.sample;
  const Json data = report_data(run.file, run.problem, run.run, judged(run.problem, run.run.front));
  REQUIRE(data["designs"].size() == 60);
  int delivered = 0;
  for (const Json& design : data["designs"]) {
    const Json& part = data["parts"][design["part"].get<std::size_t>()];
    REQUIRE(design["poses"].size() == part["poses"].size());
    for (std::size_t i = 0; i < design["poses"].size(); ++i) {
      const Json& pose = design["poses"][i];
      CHECK(pose["aspect"] == part["poses"][i]["aspect"]);
      if (pose["outcome"] != "delivered" || pose["decided_by"].is_null()) continue;
      ++delivered;
      const double margin = margin_of(part["poses"][i], design["travel"][i], pose["decided_by"]["x_mm"]);
      CHECK(margin == Approx(pose["margin_mm"].get<double>()).margin(2e-3));
    }
  }
  CHECK(delivered > 20);
}

TEST_CASE("a report keeps exact what reproduces a design, and rounds what is measured") {
  Run run(20);
  run.run.front = {run.run.sample[4], run.run.sample[7]};
  const Json data = report_data(run.file, run.problem, run.run, judged(run.problem, run.run.front));
  for (std::size_t i = 0; i < 2; ++i) {
    const Evaluated& design = run.run.front[i];
    const Json& json = data["designs"][i];
    CHECK(json["id"] == design_id(design));
    const std::vector<double> all = all_values(run.problem, design.candidate);
    for (const int v : run.problem.topologies()[static_cast<std::size_t>(design.candidate.topology)].variables) {
      const std::string& name = run.problem.variables()[static_cast<std::size_t>(v)].name;
      const Json read_again = Json::parse(json["values"][name].dump());
      CHECK(read_again.get<double>() == all[static_cast<std::size_t>(v)]);
    }
    CHECK(json["metrics"]["length_mm"].dump().size() <= 10);
    CHECK(json["commands"]["evaluate"] ==
          "build/release/formotion evaluate 'problems/el bracket.json' --design results/el_bracket/designs/" +
              design_id(design) + ".json");
  }
  CHECK(data["parts"].size() == 1);  // no variable changes the part: its outlines are there once
  CHECK(data["sample"].size() == 20);
}

TEST_CASE("without a feasible design there is no knee, and every design says what is wrong") {
  Run run(40);
  for (const Evaluated& e : run.run.sample) {
    if (!e.score.feasible) run.run.front.push_back(e);
  }
  REQUIRE(run.run.front.size() > 3);
  run.run.feasible = 0;
  const Json data = report_data(run.file, run.problem, run.run, judged(run.problem, run.run.front));
  CHECK(data["knee"].is_null());
  for (const Json& design : data["designs"]) CHECK(design["violations"].size() > 0);
}

TEST_CASE("a page of many rounded shapes stays small, and the knee keeps its travel") {
  // Arcs are many edges, so each travel has many hull corners. The slot is inside out: no time goes into a tolerance.
  Json text = Json::parse(Run::problem_text("round"));
  text["topologies"] = Json::parse(R"([
    {"features": [{"type": "dish-out", "depth_mm": "y", "length_mm": "2*y + 40"}, {"type": "slot", "from_mm": "x + 5",
                   "to_mm": "x", "length_mm": "w"}, {"type": "dish-out", "depth_mm": "w", "length_mm": "2*w + 60"}]}])");
  text["manufacture"] = {{"cutter_radius_mm", 2}};
  Run run(100, text.dump());
  run.run.front = run.run.sample;
  run.run.feasible = 100;  // as if: the knee asks for the scores alone
  for (std::size_t i = 0; i < 100; ++i) {
    const double a = i / 99.0, b = (1 - a) * (1 - a);  // a convex front
    run.run.front[i].score.objectives = {-a, -b, 1};
  }
  const Json data = report_data(run.file, run.problem, run.run, judged(run.problem, run.run.front));
  CHECK(report_page(data).size() < 5000000);
  std::size_t without = 0;
  for (const Json& design : data["designs"]) {
    without += design["travel"].is_null() ? 1 : 0;
    if (design["id"] == data["knee"]["id"]) CHECK_FALSE(design["travel"].is_null());
  }
  CHECK(without > 0);
  CHECK(without < 100);
  CHECK(data["designs"][1]["id"] == "d2");  // the front's order stands
}

TEST_CASE("a run that evaluated nothing has a report") {
  Run run(0);
  const Json data = report_data(run.file, run.problem, run.run, judged(run.problem, run.run.front));
  CHECK(data["designs"].empty());
  CHECK(data["knee"].is_null());
  CHECK(data["parts"].size() == 1);
}

TEST_CASE("the page holds the data so that no name can end its script") {
  Run run(6, Run::problem_text("<!-- </script><script>alert(1)</script>"));
  run.run.front = run.run.sample;
  const Json data = report_data(run.file, run.problem, run.run, judged(run.problem, run.run.front));
  const std::string page = report_page(data);
  const std::string begin = "<script id=\"report-data\" type=\"application/json\">";
  const std::size_t from = page.find(begin);
  REQUIRE(from != std::string::npos);
  const std::size_t to = page.find("</script>", from);
  const std::string text = page.substr(from + begin.size(), to - from - begin.size());
  CHECK(text.find('<') == std::string::npos);
  CHECK(Json::parse(text) == data);
  CHECK(page.find("alert(1)</script>") == std::string::npos);
}

TEST_CASE("the page loads nothing from elsewhere") {
  Run run(3);
  const std::string page = report_page(report_data(run.file, run.problem, run.run, judged(run.problem, run.run.front)));
  for (std::size_t at = page.find("//"); at != std::string::npos; at = page.find("//", at + 1)) {
    if (at < 5 || (page.compare(at - 5, 5, "http:") != 0 && page.compare(at - 6, 6, "https:") != 0)) continue;
    CHECK(page.compare(at, 13, "//www.w3.org/") == 0);  // names of XML vocabularies
  }
  for (const char* link : {"<link rel=\"stylesheet\"", "<script src", "@import", "url(http"}) {
    CHECK(page.find(link) == std::string::npos);
  }
}
