#include "analysis/constraints/support_travel.hpp"

#include <catch2/catch.hpp>

#include "analysis/constraints/planar_support.hpp"
#include "analysis/geometry/boolean.hpp"
#include "witness/random_shapes.hpp"

using namespace formotion;

namespace {

struct Case {
  Polygon part;  // standing on the wall, centre of mass at x = 0
  double com_wall = 0;
  Track track;
};

// A part on the wall and one to three disjoint voids.
Case random_case(witness::Random& random, bool on_grid) {
  Case c;
  c.part = on_grid ? witness::grid_polygon(random, 10) : witness::random_polygon(random, 12);
  const Point com = area_moments(c.part).centroid;
  c.part = placed(c.part, 0, -com);
  c.com_wall = -bounding_box(c.part.outer).min.y();
  c.part = placed(c.part, 0, {0, c.com_wall});
  c.track.width_mm = on_grid ? 6 + witness::below(random, 14) : witness::uniform(random, 8, 30);
  std::vector<Loop> loops;
  for (int i = 0, n = 1 + witness::below(random, 3); i < n; ++i) {
    const Point at = on_grid ? Point(witness::below(random, 15), witness::below(random, 10))
                             : Point(witness::uniform(random, 0, 20), witness::uniform(random, -2, 20));
    Polygon hole = on_grid ? witness::grid_polygon(random, 9) : witness::random_polygon(random, 9);
    loops.push_back(placed(hole, 0, at).outer);
  }
  c.track.voids = united(loops);
  return c;
}

double margin_sampled(const Case& c, double x) {
  return support_margin(placed(c.part, 0, {x, 0}), c.track, {x, c.com_wall}).value_or(1e9);
}

}  // namespace

TEST_CASE("no sample of a travel is below its least margin, and the least margin is attained: 2,000 travels") {
  witness::Random random(314159);
  int lost = 0, moving_minimum = 0;
  for (int i = 0; i < 2000; ++i) {
    const bool on_grid = i % 4 == 3;
    const Case c = random_case(random, on_grid);
    const TravellingPart part = TravellingPart::of(c.part, c.com_wall, 0, c.track.width_mm);
    const VoidOutline voids = VoidOutline::of(loops_of(c.track.voids));
    const Travel travel{part, voids};
    const LeastMargin least = least_margin(travel);
    CAPTURE(i, on_grid, least.margin_mm, least.x_mm);

    const double from = voids.edges.box.min.x() - part.edges.box.max.x(),
                 to = voids.edges.box.max.x() - part.edges.box.min.x();
    double sampled = 1e9;
    for (int k = 0; k <= 400; ++k) {
      const double x = from + (to - from) * (k + 0.37) / 401;
      const double margin = margin_sampled(c, x);
      if (margin < 1e8) REQUIRE(margin >= least.margin_mm - 1e-6);
      sampled = std::min(sampled, margin);
    }
    // Attained: in the limit from one side, since the margin may jump up at the place itself.
    const double near = std::min(
        {margin_sampled(c, least.x_mm), margin_sampled(c, least.x_mm - 1e-6), margin_sampled(c, least.x_mm + 1e-6)});
    if (least.margin_mm < part.plain_margin_mm - 1e-9) REQUIRE(near == Approx(least.margin_mm).margin(2e-4));
    lost += least.margin_mm < 0;
    moving_minimum += sampled > least.margin_mm + 1e-9;
  }
  CHECK(lost > 250);
  CHECK(lost < 1900);
  CHECK(moving_minimum > 300);  // sampling alone would have missed them
}

TEST_CASE("the stretches without support are those of fine samples: 1,000 travels") {
  witness::Random random(271828);
  for (int i = 0; i < 1000; ++i) {
    const Case c = random_case(random, i % 4 == 3);
    const TravellingPart part = TravellingPart::of(c.part, c.com_wall, 0, c.track.width_mm);
    if (part.plain_margin_mm < 0) continue;
    const VoidOutline voids = VoidOutline::of(loops_of(c.track.voids));
    const SupportLoss loss = support_loss({part, voids});
    CAPTURE(i);
    const double from = voids.edges.box.min.x() - part.edges.box.max.x(),
                 to = voids.edges.box.max.x() - part.edges.box.min.x();
    for (int k = 0; k <= 300; ++k) {
      const double x = from + (to - from) * (k + 0.41) / 301;
      const auto margin = support_margin(placed(c.part, 0, {x, 0}), c.track, {x, c.com_wall});
      if (margin && std::abs(*margin) < 1e-5) continue;
      bool in = false, near = false;
      for (const Interval& stretch : loss.lost_mm) {
        in = in || (stretch.from <= x && x <= stretch.to);
        near = near || std::abs(stretch.from - x) < 1e-5 || std::abs(stretch.to - x) < 1e-5;
      }
      if (!near) REQUIRE(in == (!margin || *margin < 0));
    }
    CHECK(loss.lost == !loss.lost_mm.empty());
    if (loss.lost) CHECK(loss.x_mm == loss.lost_mm.front().from);
  }
}

TEST_CASE("the margin at one place of a travel is the configuration's") {
  witness::Random random(99);
  for (int i = 0; i < 500; ++i) {
    const Case c = random_case(random, false);
    const TravellingPart part = TravellingPart::of(c.part, c.com_wall, 0, c.track.width_mm);
    const VoidOutline voids = VoidOutline::of(loops_of(c.track.voids));
    const double x = witness::uniform(random, -20, 40);
    const auto travelling = margin_at({part, voids}, x);
    const auto standing = support_margin(placed(c.part, 0, {x, 0}), c.track, {x, c.com_wall});
    REQUIRE(travelling.has_value() == standing.has_value());
    if (travelling) REQUIRE(*travelling == Approx(*standing).margin(1e-6));
  }
}

TEST_CASE("a mirrored part past mirrored voids has the same least margin") {
  witness::Random random(5);
  for (int i = 0; i < 300; ++i) {
    const Case c = random_case(random, i % 2 == 0);
    std::vector<Loop> mirrored;
    for (const Polygon& hole : c.track.voids) {
      for (const Loop& loop : loops_of(mirrored_x(hole))) mirrored.push_back(loop);
    }
    const auto least = [&](const Polygon& p, const std::vector<Loop>& loops) {
      const TravellingPart part = TravellingPart::of(p, c.com_wall, 0, c.track.width_mm);
      const VoidOutline voids = VoidOutline::of(loops);
      return least_margin({part, voids}).margin_mm;
    };
    REQUIRE(least(c.part, loops_of(c.track.voids)) == Approx(least(mirrored_x(c.part), mirrored)).margin(1e-7));
  }
}

TEST_CASE("early stopping and ignoring change no decision") {
  witness::Random random(8);
  for (int i = 0; i < 300; ++i) {
    const Case c = random_case(random, false);
    const TravellingPart part = TravellingPart::of(c.part, c.com_wall, 0, c.track.width_mm);
    const VoidOutline voids = VoidOutline::of(loops_of(c.track.voids));
    const double exact = least_margin({part, voids}).margin_mm;
    for (const double level : {-1.0, 0.0, 1.0}) {
      REQUIRE((least_margin({part, voids}, level, level).margin_mm < level) == (exact < level));
    }
  }
}

TEST_CASE("a rail that holds the part down takes its stretch out of the travel") {
  const Polygon square{rectangle(-5, 0, 5, 10), {}};
  const TravellingPart part = TravellingPart::of(square, 5, 0, 20);
  const VoidOutline gap = VoidOutline::of({rectangle(0, -50, 20, 70)});
  CHECK(least_margin({part, gap}).margin_mm < 0);
  CHECK(least_margin({part, gap, {{-6, 26}}}).margin_mm == Approx(5));
  CHECK(support_loss({part, gap, {{-6, 26}}}).lost == false);
  CHECK(support_loss({part, gap, {{-6, 2}}}).x_mm == Approx(2));
}
