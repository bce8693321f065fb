#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "analysis/geometry/boolean.hpp"
#include "applications/feeder/track_layout.hpp"
#include "applications/feeder/world.hpp"
#include "witness/feeder_specs.hpp"

using namespace formotion;
using namespace formotion::witness;
using feeder::Outcome;

namespace {

std::vector<feeder::PlacedFeature> placed_features(const feeder::FeederSpec& spec) {
  return feeder::FeederProblem(spec).place(0, {});
}
double void_area(const std::vector<feeder::PlacedFeature>& features) {
  double area = 0;
  for (const auto& feature : features) {
    for (const Polygon& polygon : feature.voids_mm) area += area_moments(polygon).area_mm2;
  }
  return area;
}

feeder::FeatureSpec fence(const Loop& polygon) { return {feeder::Fence{literal(polygon)}, {}}; }
feeder::FeatureSpec wall(const Loop& profile) { return {feeder::WallProfile{literal(profile)}, {}}; }
feeder::FeatureSpec pin(double x, double y, double diameter) {
  return {feeder::Pin{literal(x), literal(y), literal(diameter)}, {}};
}
feeder::Layout laid(const feeder::DesignSpec& design, feeder::Manufacture manufacture = {}) {
  feeder::Environment environment;
  environment.track_width_mm = 40;
  environment.spacing_mm = 5;
  return feeder::lay_out(design, environment, manufacture, 30, {});
}
// How high the fixed shapes stand at x, below y_most.
double face_at(const Obstacles& obstacles, double x, double y_most = 1e9) {
  double highest = -1e9;
  for (const FixedEdge& edge : obstacles.edges) {
    const double low = std::min(edge.from.x(), edge.to.x()), high = std::max(edge.from.x(), edge.to.x());
    if (!(low < x && x < high)) continue;
    const double y =
        edge.from.y() + (x - edge.from.x()) / (edge.to.x() - edge.from.x()) * (edge.to.y() - edge.from.y());
    if (y <= y_most) highest = std::max(highest, y);
  }
  return highest;
}
Obstacles obstacles_of(const feeder::Layout& layout, double grow = 0) {
  const auto made = make_obstacles(obstacle_shapes(layout, 1000), grow);
  REQUIRE(made.has_value());
  return *made;
}

}  // namespace

TEST_CASE("the first feature without a place starts at 0, each next one a spacing after the end of the one before") {
  feeder::FeederSpec spec = feeder_spec(flat_part(rectangle(0, 0, 4, 3), false),
                                        {at(gap(7), -50), gap(10), slot(2, 5, 20), at(gap(5), 200), gap(3)}, 40);
  auto features = placed_features(spec);
  CHECK(features[0].start_mm == -50);
  CHECK(features[1].start_mm == 0);
  CHECK(features[2].start_mm == Approx(10 + 5));  // the part's diameter
  CHECK(features[3].start_mm == 200);
  CHECK(features[4].start_mm == Approx(205 + 5));
  CHECK(evaluated(spec).metrics.length_mm == Approx(213 + 50));
  spec.environment.spacing_mm = 30;
  features = placed_features(spec);
  CHECK(features[2].start_mm == Approx(40));
}

TEST_CASE("features a part length apart act independently: 200 pairs") {
  int differing = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Random random(seed);
    feeder::FeederSpec both = random_feeder(random);
    feeder::DesignSpec design = both.designs[0];
    if (design.size() < 2) continue;
    design.resize(2);
    for (auto& feature : design) feature.at_mm.reset();
    const double offset =
        std::holds_alternative<feeder::Cutout>(design[1].shape) ? 120 : 0;  // may begin before its start
    both.environment.spacing_mm = offset + 80;
    both.designs[0] = design;
    feeder::FeederSpec first = both, second = both;
    first.designs[0] = {design[0]};
    second.designs[0] = {design[1]};
    const auto a = evaluated(first), b = evaluated(second), ab = evaluated(both);
    CAPTURE(seed);
    for (std::size_t i = 0; i < ab.poses.size(); ++i) {
      const bool one = a.poses[i].outcome == Outcome::Delivered, two = b.poses[i].outcome == Outcome::Delivered;
      REQUIRE((ab.poses[i].outcome == Outcome::Delivered) == (one && two));
      differing += one != two;
      if (one && two) {
        REQUIRE(*ab.poses[i].margin_mm == Approx(std::min(*a.poses[i].margin_mm, *b.poses[i].margin_mm)).margin(1e-9));
      } else if (!one) {
        REQUIRE(ab.poses[i].outcome == a.poses[i].outcome);  // the first lost position decides
      }
    }
  }
  CHECK(differing > 50);
}

TEST_CASE("two gaps that each let a part pass do not when at_mm joins them") {
  const auto passes = [](feeder::DesignSpec design) {
    return evaluated(feeder_spec(flat_part(rectangle(0, 0, 20, 10), false), std::move(design), 40)).poses[0].outcome ==
           Outcome::Delivered;
  };
  CHECK(passes({gap(6)}));
  CHECK(passes({gap(6), gap(6)}));
  CHECK_FALSE(passes({at(gap(6), 0), at(gap(6), 6)}));
  CHECK_FALSE(passes({at(gap(6), 0), at(gap(6), 5)}));
}

TEST_CASE("a cutter of radius r leaves (4 - pi) r^2 in the corners of a rectangle") {
  feeder::FeederSpec spec = feeder_spec(flat_part(el_outline(), true), {slot(3, 15, 30)}, 40);
  CHECK(void_area(placed_features(spec)) == Approx(360));
  for (const double radius : {0.5, 2.0, 4.0}) {
    spec.manufacture.cutter_radius_mm = radius;
    CHECK(void_area(placed_features(spec)) ==
          Approx(360 - (4 - std::numbers::pi) * radius * radius).margin(4 * 0.003 * radius));
  }
}

TEST_CASE("a cutter rounds the tip of a vee, and a design that lives by the sharp tip dies of it") {
  feeder::FeederSpec spec = feeder_spec(flat_part(el_outline(), true), {scallop(30, 30)}, 40);
  spec.manufacture.cutter_radius_mm = 2;
  double lowest = 1e9;
  const auto features = placed_features(spec);
  for (const Point& p : features[0].voids_mm[0].outer) lowest = std::min(lowest, p.y());
  CHECK(lowest == Approx(10 + 2 * (1 / std::sin(std::numbers::pi / 6) - 1)).margin(0.005));
}

TEST_CASE("a void that no cutter reaches is a violation") {
  feeder::FeederSpec spec = feeder_spec(flat_part(el_outline(), true), {slot(3, 6.9, 30)}, 40);
  spec.manufacture.cutter_radius_mm = 2;
  const auto evaluation = evaluated(spec);
  REQUIRE_FALSE(evaluation.violations.empty());
  CHECK(evaluation.violations[0].what == "the cutter does not fit into the void");
  spec.designs[0] = {slot(3, 7.1, 30)};
  for (const auto& violation : evaluated(spec).violations) CHECK(violation.what != evaluation.violations[0].what);
}

TEST_CASE("a web thinner than asked for is a violation by what it lacks") {
  feeder::FeederSpec spec =
      feeder_spec(flat_part(el_outline(), true), {at(slot(20, 24, 30), 0), at(slot(25, 30, 30), 0)}, 40);
  const auto webs = [&spec] {
    std::vector<double> by;
    for (const auto& violation : evaluated(spec).violations) {
      if (violation.what.rfind("the web", 0) == 0) by.push_back(violation.by);
    }
    return by;
  };
  CHECK(webs().empty());
  spec.manufacture.min_web_mm = 0.9;
  CHECK(webs().empty());
  spec.manufacture.min_web_mm = 2.5;
  REQUIRE(webs().size() == 1);
  CHECK(webs()[0] == Approx(1.5));
  spec.designs[0] = {at(slot(20, 26, 30), 0), at(slot(25, 30, 30), 0)};  // one void: no web
  CHECK(webs().empty());
}

TEST_CASE("obstacles stand where they are drawn and end where they end: a pin at its rim") {
  const auto layout = laid({fence({{-3, 2}, {20, 8}, {0, 12}}), pin(6, 9, 4), wall({{-2, 0}, {10, 3}}), gap(7)});
  CHECK(layout.invalid.empty());
  CHECK(layout.features[0].start_mm == 0);
  CHECK(layout.features[0].end_mm == 20);
  CHECK(layout.features[1].start_mm == 25);
  CHECK(layout.features[1].end_mm == 25 + 6 + 2);
  CHECK(layout.features[1].obstacles.at(0).radius_mm == 2);
  CHECK(layout.features[1].obstacles.at(0).area.outer == Loop{{31, 9}});
  CHECK(layout.features[2].end_mm == 38 + 10);
  CHECK(layout.features[2].wall_face_mm == Loop{{36, 0}, {48, 3}});
  CHECK(layout.features[3].start_mm == 53);
  CHECK(layout.length_mm == 60);
  for (const auto& feature : layout.features) CHECK(feature.voids.empty() == (feature.type != "gap"));
}

TEST_CASE("component 0 is the wall, then come the obstacles in the design's order") {
  feeder::Drawing two;
  two.walls_mm = {rectangle(0, 5, 4, 9), rectangle(6, 5, 9, 9)};
  const auto layout = laid({gap(3), {two, {}}, pin(6, 9, 4), fence({{0, 2}, {20, 8}, {0, 12}})});
  const auto shapes = obstacle_shapes(layout, 1000);
  REQUIRE(shapes.size() == 5);
  CHECK(shapes[0].is_datum);
  CHECK(bounding_box(shapes[0].area.outer).max == Point(1000, 0));
  CHECK(shapes[3].radius_mm == 2);
  const std::vector<std::string> names{"the wall", "feature 1 (drawing)", "feature 1 (drawing)", "feature 2 (pin)",
                                       "feature 3 (fence)"};
  const std::vector<int> features{-1, 1, 1, 2, 3};
  for (int k = 0; k < 5; ++k) {
    CHECK(obstacle_name(layout, k) == names[static_cast<std::size_t>(k)]);
    CHECK(feature_of(layout, k) == features[static_cast<std::size_t>(k)]);
  }
  for (std::size_t k = 1; k < shapes.size(); ++k) CHECK_FALSE(shapes[k].is_datum);
}

TEST_CASE("a wall profile takes the place of the wall's face, above it and below") {
  // Up to a step of 3, down into a recess of 2, up again to y = 1, where the wall's own face is a step down.
  const auto layout = laid({wall({{0, 0}, {10, 5}, {10, 2}, {20, -2}, {30, -2}, {30, 1}, {40, 1}})});
  REQUIRE(layout.invalid.empty());
  const Obstacles obstacles = obstacles_of(layout);
  CHECK(obstacles.areas.size() == 1);
  CHECK(face_at(obstacles, -5) == 0);
  CHECK(face_at(obstacles, 5) == Approx(2.5));
  CHECK(face_at(obstacles, 14) == Approx(0.4));
  CHECK(face_at(obstacles, 16) == Approx(-0.4));
  CHECK(face_at(obstacles, 25) == Approx(-2));
  CHECK(face_at(obstacles, 35) == Approx(1));
  CHECK(face_at(obstacles, 45) == 0);
  // Grown and shrunk, the wall stays where it is and the profile moves.
  for (const double grow : {0.25, -0.25}) {
    const Obstacles moved = obstacles_of(layout, grow);
    CHECK(moved.areas.size() == 1);
    CHECK(face_at(moved, -5) == 0);
    CHECK(face_at(moved, 25) == Approx(-2 + grow));
    CHECK(face_at(moved, 35) == Approx(1 + grow));
    CHECK(face_at(moved, 5) == Approx(2.5 + grow * std::sqrt(1.25)));
    CHECK(face_at(moved, 41) == 0);
  }
}

TEST_CASE("the wall is cut only where a profile lies below it, also by profiles that overlap") {
  CHECK(laid({wall({{0, 0}, {10, 5}, {20, 0}})}).features[0].wall_cuts.empty());
  const auto layout = laid({at(wall({{0, 0}, {10, -5}, {20, 0}}), 0), at(wall({{0, 0}, {10, -3}, {20, 0}}), 15)});
  REQUIRE(layout.features[1].wall_cuts.size() == 1);
  CHECK(layout.features[1].wall_cuts[0].from == 15);
  CHECK(layout.features[1].wall_cuts[0].to == 35);
  const auto shapes = obstacle_shapes(layout, 1000);
  CHECK_FALSE(defect(shapes[0].area).has_value());
  const Obstacles obstacles = obstacles_of(layout);
  CHECK(obstacles.areas.size() == 1);
  for (const FixedEdge& edge : obstacles.edges) CHECK(edge.length_mm > 0);
  CHECK(face_at(obstacles, 9) == Approx(-4.5));
  CHECK(face_at(obstacles, 26) == Approx(-2.7));
  CHECK(face_at(obstacles, 17) == Approx(-0.6));  // the higher of the two
}

TEST_CASE("a fence that reaches into the wall is one piece with it") {
  const Obstacles obstacles = obstacles_of(laid({fence({{0, -4}, {30, -4}, {30, 6}})}));
  CHECK(obstacles.areas.size() == 1);
  CHECK(face_at(obstacles, 29) == Approx(-4 + 10 * 29 / 30.0));
  CHECK(face_at(obstacles, 6) == 0);
  CHECK(face_at(obstacles, 31) == 0);
}

TEST_CASE("obstacles that variables made impossible are violations, and the rest stands") {
  const auto layout = laid({fence({{0, 0}, {9, 0}, {0, 9}, {9, 9}}), pin(3, 9, -2), wall({{5, 0}, {5, 3}, {4, 0}}),
                            wall({{0, 0}}), pin(3, 9, 2)});
  REQUIRE(layout.invalid.size() == 5);  // a diameter below 0 is also none
  const std::vector<std::string> where{"feature 0 (fence)", "feature 1 (pin)", "feature 1 (pin)", "feature 2 (wall)",
                                       "feature 3 (wall)"};
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK(layout.invalid[i].where == where[i]);
    CHECK(layout.invalid[i].by > 0);
  }
  CHECK(obstacle_shapes(layout, 1000).size() == 2);
}

TEST_CASE("the cutter's radius rounds voids, not what stands on the track") {
  feeder::Manufacture manufacture;
  manufacture.cutter_radius_mm = 2;
  const Loop polygon{{0, 2}, {20, 2}, {20, 8}, {10, 3}, {0, 8}};
  CHECK(laid({fence(polygon)}, manufacture).features[0].obstacles[0].area.outer == polygon);
}

TEST_CASE(
    "the world of an aspect: radius of gyration about the centre of mass, unit drive, wall without an end in reach") {
  feeder::FeederSpec spec = feeder_spec(flat_part(rectangle(0, 0, 30, 12), true, {}, Point(10, 6)),
                                        {fence({{0, -4}, {30, -4}, {30, 6}})}, 40);
  spec.environment.drive_rad = -0.5;
  spec.environment.wall_friction = 0.35;
  const feeder::World world = feeder::FeederProblem(spec).world(0, {}, "down");
  CHECK(world.part.gyration_mm == Approx(std::sqrt((30.0 * 30 + 12 * 12) / 12 + 25)));
  CHECK(world.drive.force.x() == Approx(std::cos(0.5)));
  CHECK(world.drive.force.y() == Approx(-std::sin(0.5)));
  CHECK(world.drive.friction == 0.35);
  CHECK(world.shapes.size() == 2);
  CHECK(face_at(world.obstacles, -9000) == 0);
  CHECK(face_at(world.obstacles, 9000) == 0);
  double right = 0;  // turned over, the long side is on the left
  for (const MovingCorner& corner : world.part.corners) right = std::max(right, corner.at.x());
  CHECK(right == Approx(10));
  spec.environment.radius_of_gyration_mm = 7;
  CHECK(feeder::FeederProblem(spec).world(0, {}, "up").part.gyration_mm == 7);
}
