// Heights closed for whole cells, free heights and free motions, against sampled members.
#include "analysis/energy/open_heights.hpp"

#include <catch2/catch.hpp>

#include "analysis/energy/nests.hpp"

using namespace formotion;
using namespace formotion::testing;

namespace {

bool holds(const std::vector<RealRange>& ranges, double height) {
  return std::any_of(ranges.begin(), ranges.end(),
                     [height](const RealRange& r) { return height >= r.low && height <= r.high; });
}

double near_an_end(const std::vector<RealRange>& ranges, witness::Random& random) {
  const RealRange& range = ranges[witness::below(random, static_cast<int>(ranges.size()))];
  const double end = witness::below(random, 2) ? range.low : range.high;
  return (std::isfinite(end) ? end : 0) +
         witness::uniform(random, -1, 1) * std::pow(10, witness::uniform(random, -6, 0));
}

Place along(const Place& a, const Place& b, double h) {
  return {std::lerp(a.across_mm, b.across_mm, h), std::lerp(a.height_mm, b.height_mm, h),
          std::lerp(a.turn_rad, b.turn_rad, h)};
}

}  // namespace

TEST_CASE("no member of a cell is free at a height that is closed for the cell") {
  witness::Random random(5);
  int closed = 0;
  for (int i = 0; i < 60; ++i) {
    const RandomNest drawn(i);
    const Nest nest(drawn.part, drawn.fixed, drawn.grow_mm, 0.7 * i);
    const OpenHeights heights(nest.space, nest.gravity, 0.002);
    for (int cell = 0; cell < 30; ++cell) {
      RealRange across{witness::uniform(random, -40, 40), 0}, turn{witness::uniform(random, 0, 6), 0};
      across.high = across.low + (cell % 5 ? std::pow(10, witness::uniform(random, -3, 0.8)) : 0);
      turn.high = turn.low + (cell % 7 ? std::pow(10, witness::uniform(random, -3, -0.1)) : 0);
      const std::vector<RealRange> open = heights.open(across, turn);
      for (int member = 0; member < 20; ++member) {
        const Place place{member % 3 ? witness::uniform(random, across.low, across.high) : across.low,
                          member % 2 ? near_an_end(open, random) : witness::uniform(random, -40, 20),
                          member % 4 ? witness::uniform(random, turn.low, turn.high) : turn.high};
        if (holds(open, place.height_mm)) continue;
        ++closed;
        CAPTURE(i, cell, place.across_mm, place.height_mm, place.turn_rad);
        REQUIRE_FALSE(nest.is_free(heights.configuration_of(place)));
      }
    }
  }
  CHECK(closed > 10000);
}

TEST_CASE("free heights at a place are free and all that is free lies in them") {
  witness::Random random(6);
  int members = 0;
  for (int i = 0; i < 60; ++i) {
    const RandomNest drawn(i);
    const Nest nest(drawn.part, drawn.fixed, drawn.grow_mm, 0.7 * i);
    const OpenHeights heights(nest.space, nest.gravity, 0.002);
    for (int k = 0; k < 20; ++k) {
      Place place{witness::uniform(random, -40, 40), 0, witness::uniform(random, 0, 6)};
      if (i % 4 == 1) place.across_mm = std::round(place.across_mm);
      const std::vector<RealRange> free = heights.free(place.across_mm, place.turn_rad);
      for (int member = 0; member < 30; ++member) {
        place.height_mm = member % 2 ? near_an_end(free, random) : witness::uniform(random, -40, 20);
        const bool is_free = nest.is_free(heights.configuration_of(place)), is_in = holds(free, place.height_mm);
        const bool at_end = std::any_of(free.begin(), free.end(), [&](const RealRange& r) {
          return std::min(std::abs(place.height_mm - r.low), std::abs(place.height_mm - r.high)) < 0.02;
        });
        if (is_in == is_free) continue;
        // Rounds count as a little larger, and touching is a matter of rounding.
        CAPTURE(i, k, place.across_mm, place.height_mm, place.turn_rad);
        ++members;
        CHECK(at_end);
        CHECK((is_free || std::any_of(free.begin(), free.end(), [&](const RealRange& r) {
                 return std::min(std::abs(place.height_mm - r.low), std::abs(place.height_mm - r.high)) < 1e-6;
               })));
      }
    }
  }
  CHECK(members < 200);
}

TEST_CASE("straight motions called free are free all along and those that are free by a margin are called free") {
  witness::Random random(7);
  int called = 0, missed = 0;
  for (int i = 0; i < 60; ++i) {
    const RandomNest drawn(i);
    const Nest nest(drawn.part, drawn.fixed, drawn.grow_mm, 0.7 * i);
    const OpenHeights heights(nest.space, nest.gravity, 0.002);
    for (int k = 0; k < 40; ++k) {
      const Place a{witness::uniform(random, -40, 40), witness::uniform(random, -25, 15),
                    witness::uniform(random, 0, 6)};
      const Place b{a.across_mm + witness::uniform(random, -3, 3), a.height_mm + witness::uniform(random, -3, 3),
                    a.turn_rad + witness::uniform(random, -0.5, 0.5)};
      const bool is_called = heights.is_straight_free(a, b);
      bool is_free = true, by_margin = true;
      for (int h = 0; h <= 60; ++h) {
        const Configuration q = heights.configuration_of(along(a, b, h / 60.0));
        is_free = is_free && nest.is_free(q);
        by_margin = by_margin && is_free && clearance_mm(nest.part, nest.obstacles, q) > 0.1;
      }
      CAPTURE(i, k);
      if (is_called) CHECK(is_free);
      called += is_called;
      missed += by_margin && !is_called;
    }
  }
  CHECK(called > 200);
  CHECK(missed == 0);
}

TEST_CASE("convex pieces cover an area and nothing else") {
  witness::Random random(8);
  for (int i = 0; i < 150; ++i) {
    Polygon area = i % 3 ? witness::random_polygon(random, 12) : witness::grid_polygon(random, 10);
    if (i % 5 == 0) area = united({area.outer, placed(witness::random_polygon(random, 10), 0, {4, 3}).outer}).front();
    std::vector<Loop> pieces;
    for (const ConvexPiece& piece : convex_cover(area)) pieces.push_back(piece.corners);
    double missing = 0, extra = 0;
    for (const Polygon& rest : difference(loops_of(area), pieces)) missing += signed_area(rest.outer);
    for (const Polygon& rest : difference(pieces, loops_of(area))) extra += signed_area(rest.outer);
    CAPTURE(i);
    CHECK(missing < 1e-6);
    CHECK(extra < 1e-6);
  }
}
