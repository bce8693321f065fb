#include <catch2/catch.hpp>

#include "analysis/geometry/boolean.hpp"
#include "witness/feeder_specs.hpp"
#include "witness/sampled_track.hpp"

using namespace formotion;
using namespace formotion::witness;
using feeder::Outcome;

namespace {

feeder::PoseResult el_on(feeder::DesignSpec design) {
  return evaluated(feeder_spec(flat_part(el_outline(), true), std::move(design), 40)).poses[0];
}

}  // namespace

TEST_CASE("a centre of mass exactly over the lip is held, and marked marginal") {
  const auto pose = el_on({balcony(7.5, 100)});
  CHECK(pose.outcome == Outcome::Delivered);
  CHECK(*pose.margin_mm == Approx(0).margin(1e-9));
  CHECK(pose.marginal);
  CHECK_FALSE(el_on({balcony(7.5001, 100)}).marginal);
  CHECK(el_on({balcony(7.4999, 100)}).outcome == Outcome::Rejected);
  CHECK_FALSE(el_on({balcony(7.4999, 100)}).marginal);
}

TEST_CASE("marginal designs have no tolerance") {
  CHECK(*evaluated(feeder_spec(flat_part(el_outline(), true), {balcony(7.5, 100)}, 40)).metrics.tolerance_mm ==
        Approx(0).margin(1e-6));
}

TEST_CASE("a balcony of width 0 leaves the resting edge's line alone: a loss as deep as the centre is high") {
  const auto pose = el_on({balcony(0, 100)});
  CHECK(pose.outcome == Outcome::Rejected);
  CHECK(*pose.margin_mm == Approx(7.5).margin(1e-6));
}

TEST_CASE("a slot that only touches the part's edge takes nothing") {
  const auto pose = el_on({slot(20, 30, 100)});
  CHECK(pose.outcome == Outcome::Delivered);
  CHECK(*pose.margin_mm == Approx(*el_on({slot(25, 30, 100)}).margin_mm));
  CHECK(*el_on({slot(0, 0.5, 100)}).margin_mm == Approx(*el_on({slot(25, 30, 100)}).margin_mm).margin(0.51));
}

TEST_CASE("a slot drawn exactly to the wall leaves a lip of no width, that holds and is warned of") {
  const auto at_wall = evaluated(feeder_spec(flat_part(el_outline(), true), {slot(0, 8, 100)}, 40));
  CHECK(at_wall.poses[0].outcome == Outcome::Delivered);
  CHECK(*at_wall.metrics.tolerance_mm == 0);
  REQUIRE(at_wall.warnings.size() == 1);
  CHECK(at_wall.warnings[0].find("0.00 mm before the wall") != std::string::npos);
  CHECK(el_on({slot(-1, 8, 100)}).outcome == Outcome::Rejected);
}

TEST_CASE("features of no length, at or beyond the free edge, or below the wall change nothing") {
  const double plain = *el_on({slot(30, 35, 10)}).margin_mm;
  for (const auto& feature : {gap(0), balcony(40, 50), balcony(55, 50), balcony(9, 0), slot(-9, 0, 40), dish_out(0, 30),
                              scallop(0, 20), canyon(41, 50, 60), cutout({{0, -9}, {30, -9}, {15, 0}})}) {
    const auto evaluation = evaluated(feeder_spec(flat_part(el_outline(), true), {feature}, 40));
    for (const auto& pose : evaluation.poses) CHECK(pose.outcome == Outcome::Delivered);
    CHECK(*evaluation.poses[0].margin_mm == Approx(plain).margin(1e-9));
  }
}

TEST_CASE("a balcony below the wall is a gap") {
  const auto all_gone = evaluated(feeder_spec(flat_part(el_outline(), true), {balcony(-2, 60)}, 40));
  const auto as_gap = evaluated(feeder_spec(flat_part(el_outline(), true), {gap(60)}, 40));
  for (std::size_t i = 0; i < all_gone.poses.size(); ++i) {
    CHECK(all_gone.poses[i].outcome == as_gap.poses[i].outcome);
    CHECK(*all_gone.poses[i].margin_mm == Approx(*as_gap.poses[i].margin_mm).margin(1e-9));
  }
}

TEST_CASE("lengths below 0 and bands turned over are violations, not crashes") {
  for (const auto& feature :
       {gap(-1), balcony(9, -3), canyon(9, 9, 50), slot(12, 8, 50), dish_out(20, 30), scallop(10, 95),
        cutout({{0, 0}, {10, 0}, {10, 0}}), cutout({{0, 0}, {9, 9}, {9, 0}, {0, 9}})}) {
    const auto evaluation = evaluated(feeder_spec(flat_part(el_outline(), true), {feature}, 40));
    CHECK_FALSE(evaluation.feasible);
    CHECK_FALSE(evaluation.violations.empty());
    CHECK_FALSE(evaluation.metrics.tolerance_mm.has_value());
  }
}

TEST_CASE("a part wider than the track is held by what lies on the track") {
  const auto outcome = [](double track) {
    return evaluated(feeder_spec(flat_part(rectangle(0, 0, 20, 10), false), {gap(1)}, track)).poses[0].outcome;
  };
  CHECK(outcome(5.1) == Outcome::Delivered);
  CHECK(outcome(4.9) == Outcome::Rejected);
}

TEST_CASE("voids that overlap, touch or lie in each other are their union") {
  const auto margins = [](feeder::DesignSpec design) {
    std::vector<double> all;
    for (const auto& pose : evaluated(feeder_spec(flat_part(el_outline(), true), std::move(design), 40)).poses) {
      all.push_back(*pose.margin_mm);
    }
    return all;
  };
  const auto whole = margins({at(slot(3, 15, 30), 0)});
  for (const auto& pieces :
       std::vector<feeder::DesignSpec>{{at(slot(3, 15, 20), 0), at(slot(3, 15, 20), 10)},    // overlapping
                                       {at(slot(3, 15, 10), 0), at(slot(3, 15, 20), 10)},    // touching
                                       {at(slot(3, 15, 30), 0), at(slot(5, 9, 10), 10)}}) {  // inside
    const auto found = margins(pieces);
    for (std::size_t i = 0; i < whole.size(); ++i) CHECK(found[i] == Approx(whole[i]).margin(1e-7));
  }
}

TEST_CASE("scores scale with the drawing, from a tenth to a thousand times the size") {
  for (const double scale : {0.1, 10.0, 1000.0}) {
    Loop outline = el_outline();
    for (Point& p : outline) p *= scale;
    feeder::PartSpec part = flat_part(outline, true);
    for (auto& aspect : part.aspects) aspect.height_mm = 3 * scale;
    const auto big = evaluated(
        feeder_spec(part, {balcony(9 * scale, 60 * scale), slot(2 * scale, 11 * scale, 9 * scale)}, 40 * scale));
    const auto small = evaluated(feeder_spec(flat_part(el_outline(), true), {balcony(9, 60), slot(2, 11, 9)}, 40));
    for (std::size_t i = 0; i < big.poses.size(); ++i) {
      CHECK(big.poses[i].outcome == small.poses[i].outcome);
      CHECK(*big.poses[i].margin_mm == Approx(scale * *small.poses[i].margin_mm).epsilon(1e-6));
    }
    CHECK(*big.metrics.tolerance_mm == Approx(scale * *small.metrics.tolerance_mm).epsilon(1e-5));
  }
}

TEST_CASE("shapes on a grid, where everything touches, agree with the witness: 150 designs") {
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    Random random(seed);
    feeder::DesignSpec design;
    for (int i = 0, n = 1 + below(random, 2); i < n; ++i) {
      const Point offset(below(random, 8), below(random, 8));
      Loop hole = grid_polygon(random, 12).outer;
      for (Point& p : hole) p += offset;
      design.push_back(cutout(hole));
      if (below(random, 2)) design.back() = at(design.back(), below(random, 12));
    }
    Polygon part = grid_polygon(random, 14);
    const feeder::FeederProblem problem(
        feeder_spec(flat_part(part.outer, false, part.holes), design, 10.5 + below(random, 12)));
    for (const std::string& text : compare(problem, 0, {}, {0.5, false}).disagreements) {
      UNSCOPED_INFO(text);
      CAPTURE(seed);
      CHECK(false);
    }
  }
}
