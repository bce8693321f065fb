#include "report/turning_data.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "analysis/contact/clearance.hpp"
#include "applications/feeder/turning_picture.hpp"
#include "io/problem_file.hpp"
#include "report/report_data.hpp"

using namespace formotion;
using namespace formotion::feeder;
using Json = nlohmann::ordered_json;

namespace {

// Designs that turn their parts: ramps and a pin, a recess with a cut-out behind it, a belt with a bar, and a part with
// rotational symmetry and a mirrored aspect.
const char* const kRamps = R"({
  "formotion": 1, "name": "ramps", "kind": "feeder",
  "part": {"outline_mm": [[0, 0], [0, -30.5], [-10.5, -30.5], [-10.5, -9.5], [-40.6, -9.5], [-40.6, 0]],
           "thickness_mm": 3},
  "environment": {"track_width_mm": 60, "wall_friction": 0.2, "drive_deg": -30},
  "design": {"features": [{"type": "fence", "polygon_mm": [[0, -2], [84, -2], [84, 28]]},
                          {"type": "pin", "at_mm": 0, "x_mm": 123, "y_mm": 10, "diameter_mm": 6}]},
  "goal": {"deliver": {"orientation_deg": 180}}
})";
const char* const kRecess = R"({
  "formotion": 1, "name": "recess", "kind": "feeder",
  "part": {"outline_mm": [[0, 0], [40, 0], [40, 9], [24, 9], [24, 26], [12, 26], [12, 9], [0, 9]], "thickness_mm": 3},
  "environment": {"track_width_mm": 70, "wall_friction": 0.2, "drive_deg": -30},
  "design": {"features": [
    {"type": "wall", "profile_mm": [[0, 0], [62, 20], [62, -2.3], [78, -2.3], [108, 0]]},
    {"type": "balcony", "at_mm": 168, "width_mm": 13, "length_mm": 80}]},
  "goal": {"deliver": {"orientation_deg": 0}}
})";
const char* const kBelt = R"({
  "formotion": 1, "name": "belt", "kind": "feeder",
  "part": {"outline_mm": [[0, 0], [44, 6], [10, 16], [-4, 8]], "thickness_mm": 3},
  "environment": {"track_width_mm": 150, "drive_deg": 0, "start_y_mm": 60, "wall_friction": 0.15},
  "design": {"features": [
    {"type": "fence", "polygon_mm": [[0, 155], [152, 20], [156, 20], [156, 155]]}]},
  "goal": {"deliver": "one pose"}
})";
const char* const kFlipped = R"({
  "formotion": 1, "name": "flipped", "kind": "feeder",
  "part": {"outline_mm": [[0, 0], [30, 0], [34, 12], [4, 12]], "thickness_mm": 3, "flips": true},
  "environment": {"track_width_mm": 60, "wall_friction": 0.2, "drive_deg": -30},
  "design": {"features": [{"type": "fence", "polygon_mm": [[0, -2], [46, -2], [46, 16]]}]},
  "goal": {"deliver": "one pose"}
})";

struct Design {
  ProblemFile file;
  FeederProblem problem;
  FeederEvaluation evaluation;
  TurningPicture picture;
  std::vector<World> worlds;  // by aspect

  explicit Design(const char* text)
      : file(parse_problem(text, "problem.json")),
        problem(file.feeder),
        evaluation(problem.evaluate(0, {})),
        picture(*turning_picture(problem, 0, {}, true)) {
    for (const AspectShape& shape : problem.shapes({})) worlds.push_back(problem.world(0, {}, shape.name));
  }
};

// Of the evaluation's map.
const MapInterval& interval_at(const FeederEvaluation& evaluation, const std::string& aspect, double theta) {
  for (const MapInterval& interval : evaluation.outcome_map) {
    double off = std::fmod(theta - interval.from_rad, 2 * M_PI);
    if (off < 0) off += 2 * M_PI;
    if (interval.aspect == aspect && off <= interval.width_rad()) return interval;
  }
  throw std::logic_error("the map has a hole");
}

bool is_finite(const Json& json) {
  if (json.is_number_float()) return std::isfinite(json.get<double>());
  if (!json.is_structured()) return true;
  return std::all_of(json.begin(), json.end(), [](const Json& item) { return is_finite(item); });
}

}  // namespace

TEST_CASE("pictured intervals cover the circle, and end as the evaluation says") {
  for (const char* text : {kRamps, kRecess, kBelt, kFlipped}) {
    const Design design(text);
    std::map<int, std::vector<IntervalPicture>> by_aspect;
    for (const IntervalPicture& interval : design.picture.map) by_aspect[interval.aspect].push_back(interval);
    CHECK(by_aspect.size() == design.worlds.size());
    for (const auto& [aspect, intervals] : by_aspect) {
      double covered = 0;
      for (std::size_t i = 0; i < intervals.size(); ++i) {
        const MapInterval& interval = intervals[i].interval;
        if (intervals.size() > 1) CHECK(interval.to_rad == intervals[(i + 1) % intervals.size()].interval.from_rad);
        covered += interval.width_rad();
        const PathPicture& path = design.picture.paths.at(intervals[i].path);
        const MapInterval& judged = interval_at(design.evaluation, interval.aspect, interval.sample_rad);
        CHECK(path.aspect == aspect);
        CHECK(path.outcome == interval.outcome);
        CHECK(path.outcome == judged.outcome);
        CHECK(std::abs(std::remainder(path.points.front().theta_rad - interval.sample_rad, 2 * M_PI)) < 1e-12);
        if (!judged.exit_orientation_rad) continue;
        const double period = 2 * M_PI / (text == kFlipped ? 2 : 1);
        CHECK(std::abs(std::remainder(path.points.back().theta_rad - *judged.exit_orientation_rad, period)) < 1e-6);
      }
      CHECK(covered == Approx(2 * M_PI).margin(1e-12));
    }
  }
}

TEST_CASE("the paths of what reaches the goal have the design's efficiency") {
  for (const char* text : {kRamps, kRecess, kBelt, kFlipped}) {
    const Design design(text);
    double share = 0;
    if (text == kBelt) {
      for (const IntervalPicture& interval : design.picture.map)
        share += design.picture.paths[interval.path].is_goal ? interval.interval.width_rad() / (2 * M_PI) : 0;
    } else {
      for (const PoseResult& pose : design.evaluation.poses) {
        for (const PathPicture& path : design.picture.paths) {
          const bool same = design.problem.shapes({})[static_cast<std::size_t>(path.aspect)].name == pose.aspect &&
                            path.start_rad == pose.orientation_rad;
          share += same && path.is_goal ? pose.prior : 0;
        }
      }
    }
    CHECK(share == Approx(design.evaluation.metrics.efficiency).margin(1e-9));
  }
}

TEST_CASE("pictured paths go on without a gap, and no point of them is in an obstacle") {
  for (const char* text : {kRamps, kRecess, kBelt, kFlipped}) {
    const Design design(text);
    for (const PathPicture& path : design.picture.paths) {
      const World& world = design.worlds[static_cast<std::size_t>(path.aspect)];
      REQUIRE(path.points.size() > 1);
      double least = 1e300, longest_turn = 0;
      for (std::size_t i = 0; i < path.points.size(); ++i) {
        least = std::min(least, clearance_mm(world.part, world.obstacles, path.points[i]));
        if (i == 0) continue;
        const double turn = std::abs(path.points[i].theta_rad - path.points[i - 1].theta_rad);
        longest_turn = std::max(longest_turn, turn);
        // Chords are within 0.01 mm of the path; from between two obstacles the way out is longer than that.
        const Configuration &a = path.points[i - 1], &b = path.points[i];
        const Configuration middle{(a.x_mm + b.x_mm) / 2, (a.y_mm + b.y_mm) / 2, (a.theta_rad + b.theta_rad) / 2};
        CHECK(clearance_mm(world.part, world.obstacles, middle) >= -0.06);
      }
      CHECK(least >= -1e-6);
      CHECK(longest_turn < 0.3);
      REQUIRE(path.legs.size() > 1);
      CHECK(path.legs.front().from == 0);
      for (std::size_t i = 1; i < path.legs.size(); ++i) CHECK(path.legs[i].from > path.legs[i - 1].from);
      CHECK(path.legs.back().from < path.points.size());
    }
  }
}

TEST_CASE("a pictured path's contacts touch at the leg's first point") {
  for (const char* text : {kRamps, kRecess, kBelt}) {
    const Design design(text);
    for (const PathPicture& path : design.picture.paths) {
      const World& world = design.worlds[static_cast<std::size_t>(path.aspect)];
      for (const LegPicture& leg : path.legs) {
        const Configuration& q = path.points[leg.from];
        for (const ActiveContact& contact : leg.contacts) {
          const ContactState state = contact_state(world.part, world.obstacles, contact.pair, q.position(),
                                                   std::cos(q.theta_rad), std::sin(q.theta_rad));
          CHECK(std::abs(state.gap_mm) < 1e-6);
          CHECK((q.position() + state.lever - contact.point).norm() < 1e-6);
        }
      }
    }
  }
}

TEST_CASE("pieces of the pictured space are placements that touch, held up as the design says") {
  for (const char* text : {kRamps, kRecess, kFlipped}) {
    const Design design(text);
    REQUIRE(design.picture.spaces.size() == design.worlds.size());
    for (const SpacePicture& space : design.picture.spaces) {
      const World& world = design.worlds[static_cast<std::size_t>(space.aspect)];
      const std::string aspect = design.problem.shapes({})[static_cast<std::size_t>(space.aspect)].name;
      CHECK(space.slices.size() == 120);
      std::size_t seen = 0;
      for (std::size_t k = 0; k < space.slices.size(); ++k) {
        const double theta = space.theta_rad(k), c = std::cos(theta), s = std::sin(theta);
        CHECK_FALSE(space.slices[k].empty());
        for (const PiecePicture& piece : space.slices[k]) {
          const bool round = piece.pair.kind == ContactKind::CornerOnCorner;  // chords of arcs of 0.2 rad
          const double off = round ? 0.005 * world.obstacles.corners[piece.pair.fixed].radius_mm : 1e-6;
          for (const Point& p : {piece.from, piece.to})
            CHECK(std::abs(contact_state(world.part, world.obstacles, piece.pair, p, c, s).gap_mm) <= off + 1e-9);
          if (++seen % 41 != 0) continue;
          const Point middle = (piece.from + piece.to) / 2;
          const SupportAnswer support = design.problem.support(0, {}, aspect, {middle.x(), middle.y(), theta});
          if (support.margin_mm && std::abs(*support.margin_mm) > 1e-6) CHECK(support.supported == piece.supported);
          CHECK(clearance_mm(world.part, world.obstacles, {middle.x(), middle.y(), theta}) >= -off - 1e-6);
        }
      }
      CHECK(seen > 300);
    }
  }
}

TEST_CASE("facets are called by the numbers of the problem file") {
  const Design design(kRamps);
  std::map<std::string, const FacetPicture*> by_label;
  for (const FacetPicture& facet : design.picture.spaces[0].facets) {
    CHECK(by_label.emplace(facet.label, &facet).second);  // each name once
  }
  // The long inner edge, from corner 3 to 4, on the tip of the ramp, corner 2; the outer corner 0 on its face, edge 2.
  REQUIRE(by_label.count("edge 3 on corner 2 of feature 0 (fence)") == 1);
  REQUIRE(by_label.count("corner 0 on edge 2 of feature 0 (fence)") == 1);
  CHECK(by_label.count("edge 0 on feature 1 (pin)") == 1);
  CHECK(by_label.count("corner 0 on the wall") == 1);
  CHECK(by_label["edge 3 on corner 2 of feature 0 (fence)"]->component == 1);
  CHECK(by_label["edge 3 on corner 2 of feature 0 (fence)"]->kind == ContactKind::EdgeOnCorner);
}

TEST_CASE("a turning design's JSON is small and whole") {
  for (const char* text : {kRamps, kRecess, kBelt, kFlipped}) {
    const Design design(text);
    const Json json = turning_json(design.problem, design.picture);
    CHECK(is_finite(json));
    CHECK(json.dump().size() < 400000);
    CHECK(json["outcome_map"].size() == design.picture.map.size());
    for (const Json& interval : json["outcome_map"])
      CHECK(json["paths"][interval["path"].get<std::size_t>()]["aspect"] == interval["aspect"]);
    CHECK(json["parts"].size() == design.worlds.size());
    CHECK(json["transitions"].is_null() == (text == kBelt));
    CHECK(json["sensitivity"].size() == 4);
    for (const auto& [aspect, space] : json["space"].items()) CHECK(space["slices"].size() == 120);
  }
}

TEST_CASE("without obstacles there is nothing to picture") {
  Json plain = Json::parse(kRecess);
  plain["design"]["features"].erase(0);
  const ProblemFile file = parse_problem(plain.dump(), "problem.json");
  CHECK_FALSE(turning_picture(FeederProblem(file.feeder), 0, {}, true));
}

TEST_CASE("a report holds every turning design's paths, and the space of the first six") {
  const ProblemFile file = parse_problem(kFlipped, "problem.json");
  const FeederProblem problem(file.feeder);
  RunSummary run;
  for (int i = 1; i <= 8; ++i) {
    Evaluated e;
    e.number = i;
    e.score = problem.score(e.candidate);
    run.front.push_back(e);
  }
  const Json data = report_data(file, problem, run, judged(problem, run.front));
  int spaces = 0;
  for (const Json& design : data["designs"]) {
    CHECK(design["travel"].is_null());
    CHECK(design["turning"]["paths"].size() == design["turning"]["outcome_map"].size());
    const bool has_space = !design["turning"]["space"].is_null();
    spaces += has_space ? 1 : 0;
    CHECK(has_space == (spaces <= 6 && design["number"] <= 6));
  }
  CHECK(spaces == 6);
}
