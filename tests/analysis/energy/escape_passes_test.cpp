// Passes between rests, and what is captured.
#include <catch2/catch.hpp>

#include "analysis/energy/nests.hpp"

using namespace formotion;
using namespace formotion::testing;

namespace {

// Three pits on one floor: walls of 10, 4, 6 and 8 from left to right; a block of 2 passes each with its middle 1
// above.
Polygon three_pits() {
  return {{{-30, -5},
           {30, -5},
           {30, 8},
           {25, 8},
           {25, 0},
           {11, 0},
           {11, 6},
           {7, 6},
           {7, 0},
           {-7, 0},
           {-7, 4},
           {-11, 4},
           {-11, 0},
           {-25, 0},
           {-25, 10},
           {-30, 10}},
          {}};
}
const std::vector<Configuration> kPits{{-18, 1, 0}, {0, 1, 0}, {18, 1, 0}};

}  // namespace

TEST_CASE("pits join in the order of the walls between them") {
  const Nest nest(block(-1, -1, 1, 1), three_pits());
  const MergeTree tree = merge_tree(nest.space, nest.gravity, kPits, beyond(nest.obstacles, nest.gravity));
  REQUIRE(tree.passes.size() == 3);
  const std::array<double, 3> heights{5, 7, 9};
  const std::array<std::pair<int, int>, 3> joined{{{0, 1}, {2, 4}, {3, 5}}};
  for (int k = 0; k < 3; ++k) {
    const Pass& pass = tree.passes[k];
    CAPTURE(k, pass.lower_mm);
    CHECK(std::pair(pass.first, pass.second) == joined[k]);
    CHECK(pass.lower_mm <= heights[k] + 1e-6);
    REQUIRE(pass.upper_mm);
    CHECK(*pass.upper_mm >= heights[k] - 1e-6);
    CHECK(*pass.upper_mm - pass.lower_mm <= 0.1);
    REQUIRE(pass.at);
    CHECK(nest.gravity.height_mm(*pass.at) == Approx(*pass.upper_mm).margin(1e-8));
  }
  REQUIRE(tree.brackets.size() == 3);
  for (int i = 0; i < 3; ++i) {
    const EscapeBracket alone = nest.escape(kPits[i]);
    CHECK(tree.brackets[i].lower_mm <= 8 + 1e-6);
    CHECK(*tree.brackets[i].upper_mm >= 8 - 1e-6);
    CHECK(std::abs(tree.brackets[i].lower_mm - alone.lower_mm) <= 0.1);
    CHECK(nest.overlaps_on(tree.brackets[i].path) == 0);
  }
}

TEST_CASE("the rise between two pits is that over the highest wall between them") {
  const Nest nest(block(-1, -1, 1, 1), three_pits());
  const std::array<std::array<double, 3>, 3> rises{{{0, 4, 6}, {4, 0, 6}, {6, 6, 0}}};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      const EscapeBracket found = rise_between(nest.space, nest.gravity, kPits[i], kPits[k]);
      CAPTURE(i, k, found.lower_mm, found.why);
      REQUIRE(found.upper_mm);
      CHECK(found.lower_mm <= rises[i][k] + 1e-6);
      CHECK(*found.upper_mm >= rises[i][k] - 1e-6);
      CHECK(*found.upper_mm - found.lower_mm <= 0.1);
      CHECK(nest.overlaps_on(found.path) == 0);
      CHECK((found.path.back().position() - kPits[k].position()).norm() < 1e-9);
    }
  }
}

TEST_CASE("a way between the two sides of a wall leads under it") {
  const Nest nest(block(-1, -1, 1, 1), block(-5, -20, 5, 30));
  const EscapeBracket found = rise_between(nest.space, nest.gravity, {-9, 0, 0}, {9, 0, 1});
  REQUIRE(found.upper_mm);
  CHECK(*found.upper_mm <= 0.1);
  CHECK(nest.overlaps_on(found.path, 400) == 0);
}

TEST_CASE("rests that cannot be reached from outside have passes of their own") {
  const Polygon box{rectangle(-30, -5, 30, 20),
                    {{{-25, 0}, {-25, 15}, {25, 15}, {25, 0}, {2, 0}, {2, 4}, {-2, 4}, {-2, 0}}}};
  const Nest nest(block(-1, -1, 1, 1), box);
  const MergeTree tree =
      merge_tree(nest.space, nest.gravity, {{-10, 1, 0}, {10, 1, 0}, {0, 21, 0}}, beyond(nest.obstacles, nest.gravity));
  REQUIRE(tree.passes.size() == 2);
  CHECK(std::pair(tree.passes[0].first, tree.passes[0].second) == std::pair(0, 1));
  CHECK(tree.passes[0].lower_mm == Approx(5).margin(0.1));
  CHECK(std::pair(tree.passes[1].first, tree.passes[1].second) == std::pair(2, 3));
  CHECK(tree.passes[1].lower_mm == Approx(21).margin(0.1));
  CHECK(std::isinf(tree.brackets[0].lower_mm));
}

TEST_CASE("what falls within a puddle is captured and what falls from higher or from elsewhere is not") {
  const Nest nest(block(-1, -1, 1, 1), three_pits());
  const double rise = 6 - 1e-6;  // of the right pit: over the wall of 6 with its middle on 7
  const auto captured = [&](const Configuration& at, const Configuration& from, double rise_mm) {
    return surely_captured(nest.space, nest.gravity, at, rise_mm, from);
  };
  CHECK(captured(kPits[2], {18, 5, 0}, rise));
  CHECK(captured(kPits[2], {13, 3, 1}, rise));
  CHECK(captured(kPits[2], {22, 6.9, 0.3}, rise));
  CHECK_FALSE(captured(kPits[2], {18, 7.1, 0}, rise));  // too high
  CHECK_FALSE(captured(kPits[2], {0, 5, 0}, rise));     // in the pit beside
  CHECK_FALSE(captured(kPits[2], {9, 6, 0}, rise));     // in the wall
  CHECK(captured(kPits[1], {-18, 6, 0}, 6 - 1e-6));     // over the low wall, both pits are one puddle
  // The floor of a pit is one set of rests.
  CHECK(captured(kPits[2], {14, 1, 0}, rise));
  CHECK(captured(kPits[2], kPits[2], rise));
  CHECK_FALSE(captured(kPits[1], {-18, 1, 0}, 4 - 1e-6));
}
