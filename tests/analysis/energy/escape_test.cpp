// Escape heights against closed forms.
#include "analysis/energy/escape.hpp"

#include <catch2/catch.hpp>

#include "analysis/energy/nests.hpp"

using namespace formotion;
using namespace formotion::testing;

namespace {

void check_bracket(const Nest& nest, const Configuration& start, double rise, double gap, double slack = 1e-6) {
  EscapeOptions options;
  options.gap_mm = gap;
  const EscapeBracket found = nest.escape(start, options);
  CAPTURE(rise, gap, found.lower_mm, found.why);
  CHECK(found.lower_mm <= rise + slack);
  REQUIRE(found.upper_mm);
  CAPTURE(*found.upper_mm);
  CHECK(*found.upper_mm >= rise - slack);
  CHECK(*found.upper_mm - found.lower_mm <= gap);
  CHECK(found.why.empty());
  CHECK(nest.overlaps_on(found.path) == 0);
  REQUIRE(found.path.size() > 1);
  CHECK((found.path.front().position() - start.position()).norm() == 0);
  CHECK(nest.is_out(found.path.back()));
  CHECK(nest.highest_on(found.path) - nest.gravity.height_mm(start) == Approx(*found.upper_mm).margin(1e-9));
  CHECK(nest.gravity.height_mm(*found.pass) - nest.gravity.height_mm(start) == Approx(*found.upper_mm).margin(1e-8));
}

void check_bracket(const Nest& nest, const Configuration& start, double rise) {
  for (const double gap : {1.0, 0.1, 0.02}) check_bracket(nest, start, rise, gap);
}

}  // namespace

TEST_CASE("a part that is nearly round rises out of a pocket by the depth") {
  check_bracket(Nest(regular(48, 10), pocket(30, 14)), {0, 10, 0}, 14);
}

TEST_CASE("a part of next to no size rises to the top of a hill") {
  const Polygon hill{{{-30, -5}, {30, -5}, {30, 0}, {12, 0}, {5, 8}, {-5, 0}, {-20, 0}, {-30, 20}}, {}};
  check_bracket(Nest(block(-0.01, -0.01, 0.01, 0.01), hill), {-7, 0.01, 0}, 8);
}

TEST_CASE("a block leaves a pocket deeper than itself by the depth") {
  check_bracket(Nest(block(-3, -3, 3, 3), pocket(30, 9)), {0, 3, 0}, 9);
}

TEST_CASE("a standing block leaves a shallow pocket over its corner") {
  // Lying it passes the rim at 3 + 3 = 6, where it stands it is 6 high, over its corner half a diagonal.
  check_bracket(Nest(block(-3, -6, 3, 6), pocket(40, 3)), {0, 6, 0}, std::sqrt(45.0) - 6);
}

TEST_CASE("a lying block that a narrow pocket holds upright pays for its length") {
  // A pocket of 7: the block of 6 x 12 stands in it and cannot lie down before it is out; it must be above the rim by
  // half its width at least, and in between its corners pass the walls.
  const Nest nest(block(-3, -6, 3, 6), pocket(7, 20));
  EscapeOptions options;
  const EscapeBracket found = nest.escape({0, 6, 0}, options);
  REQUIRE(found.upper_mm);
  CHECK(found.lower_mm > 20 + 3 - 6);
  CHECK(*found.upper_mm <= 20);  // straight up and out
  CHECK(*found.upper_mm - found.lower_mm <= options.gap_mm);
  CHECK(nest.overlaps_on(found.path) == 0);
}

TEST_CASE("a part as wide as its pocket rises straight out by the depth") {
  check_bracket(Nest(block(-5, -4, 5, 4), pocket(10, 7)), {0, 4, 0}, 7);
  check_bracket(Nest(block(-4, -5, 4, 5), pocket(10, 7)), {0, 4, std::numbers::pi / 2}, 7);
}

TEST_CASE("a part as wide as its pocket rises straight out however the nest is turned") {
  for (const double turned : {0.3, 1.7, -2.4}) {
    const Nest nest(block(-5, -4, 5, 4), {{pocket(10, 7), 0, false}}, 0, turned);
    const Point at = rotated(Point(0, 4), turned);
    check_bracket(nest, {at.x(), at.y(), turned}, 7, 0.1);
  }
}

TEST_CASE("a part leaves through a slot of its own height and through a gap of its own width") {
  const Nest slot(
      block(-2, -2, 2, 2),
      {{block(-20, -5, 20, 0), 0, false}, {block(-20, 0, -15, 30), 0, false}, {block(10, 4, 20, 30), 0, false}});
  check_bracket(slot, {-2, 2, 0}, 0);
  const Nest gap(block(-2, -2, 2, 2), {{block(-20, -5, 6, 0), 0, false},
                                       {block(10, -5, 20, 0), 0, false},
                                       {block(-20, 0, -15, 30), 0, false},
                                       {block(15, 0, 20, 30), 0, false}});
  check_bracket(gap, {-2.3, 2, 0}, 0);
}

TEST_CASE("a part in a closed box is enclosed and so is a T in its slot") {
  const Polygon box{rectangle(-40, -40, 40, 40), {{{-15, -15}, {-15, 15}, {15, 15}, {15, -15}}}};
  const Nest closed(block(-5, -4, 5, 4), box);
  const EscapeBracket found = closed.escape({0, 0, 0.3});
  CHECK(std::isinf(found.lower_mm));
  CHECK_FALSE(found.upper_mm);
  CHECK(found.why == "enclosed");
  const Polygon slot{{{-30, -10},
                      {30, -10},
                      {30, 10},
                      {3, 10},
                      {3, 4},
                      {8, 4},
                      {8, 0},
                      {-8, 0},
                      {-8, 4},
                      {-3, 4},
                      {-3, 10},
                      {-30, 10}},
                     {}};
  const Polygon tee{{{-7, -2}, {7, -2}, {7, 1}, {2, 1}, {2, 10}, {-2, 10}, {-2, 1}, {-7, 1}}, {}};
  CHECK(Nest(tee, slot).escape({0, 2.01, 0}).why == "enclosed");
}

TEST_CASE("a part on a flat top and one over a slot that is too narrow need not rise") {
  check_bracket(Nest(block(-5, -4, 5, 4), block(-40, -10, 40, 0)), {0, 4, 0}, 0);
  check_bracket(Nest(block(-8, -3, 8, 3), pocket(8, 9)), {0, 12, 0}, 0);
}

TEST_CASE("round corners count by what they are") {
  std::vector<ObstacleShape> pins{{block(-30, -5, 30, 0), 0, false}};
  for (const double x : {-12.0, 12.0}) pins.push_back({{{Point(x, 3)}, {}}, 3, false});
  const Nest nest(block(-6, -3, 6, 3), pins);
  for (const double gap : {1.0, 0.1}) check_bracket(nest, {0, 3, 0}, 6, gap);
  // Touching both pins: 18 between the rounds' sides, at the height of their middles.
  const Nest close(block(-9, -3, 9, 3), pins);
  check_bracket(close, {0, 3, 0}, 6, 0.1);
  const Nest grown(block(-6, -3, 6, 3), {{pocket(24, 6), 0, false}}, 0.5);
  check_bracket(grown, {0, 3.5, 0}, 6);
}

TEST_CASE("starts that are out are out and starts that overlap are refused") {
  const Nest nest(block(-3, -3, 3, 3), pocket(30, 9));
  const EscapeBracket out = nest.escape({45, -3, 0});
  CHECK(out.lower_mm == 0);
  CHECK(out.upper_mm == 0.0);
  CHECK(out.path.size() == 1);
  const EscapeBracket inside = nest.escape({0, 1, 0});
  CHECK_FALSE(inside.upper_mm);
  CHECK_FALSE(inside.why.empty());
}

TEST_CASE("few cells give a bracket that is true and says why it is wide") {
  const Nest nest(block(-3, -6, 3, 6), pocket(7, 20));
  EscapeOptions options;
  options.most_cells = 200;
  options.gap_mm = 0.01;
  const EscapeBracket rough = nest.escape({0, 6, 0}, options);
  const EscapeBracket fine = nest.escape({0, 6, 0});
  CHECK_FALSE(rough.why.empty());
  CHECK(rough.lower_mm <= *fine.upper_mm);
  if (rough.upper_mm) CHECK(*rough.upper_mm >= fine.lower_mm);
  options.want_path = false;
  options.most_cells = 1000000;
  options.gap_mm = 0.1;
  const EscapeBracket bare = nest.escape({0, 6, 0}, options);
  CHECK_FALSE(bare.upper_mm);
  CHECK(bare.path.empty());
  CHECK(bare.lower_mm <= *fine.upper_mm);
  CHECK(bare.lower_mm >= fine.lower_mm - 0.1);
}
