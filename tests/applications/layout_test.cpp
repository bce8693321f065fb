#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "analysis/geometry/boolean.hpp"
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
