// Escape heights beside a planner that looks for lower ways (tests/witness/escape_planner.hpp), and that planner beside
// what is known.
#include <catch2/catch.hpp>

#include "witness/escape_attack.hpp"

using namespace formotion;
using namespace formotion::testing;

namespace {

// The planner's own lowest way out of a pocket, as a rise. Infinite where it found none.
double lowest_rise(const Polygon& part, const Polygon& fixed, const Configuration& start, double below_mm,
                   long samples) {
  const witness::PlannedNest planned(part, {{fixed, 0, false}}, 0);
  witness::WayQuestion question;
  question.start = start;
  question.from_mm = -40;
  question.to_mm = 40;
  question.below_mm = start.y_mm + below_mm;
  question.free_samples = samples;
  const witness::FoundWay found = look_for_way(planned, question);
  if (!found.got_out) return std::numeric_limits<double>::infinity();
  const Nest nest(part, fixed);
  CHECK(nest.overlaps_on(found.path) == 0);
  CHECK(nest.is_out(found.path.back()));
  CHECK(nest.highest_on(found.path) == found.highest_mm);
  return found.highest_mm - start.y_mm;
}

}  // namespace

TEST_CASE("the planner's clearances are those of contact analysis") {
  witness::Random random(3);
  int free = 0, round = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const RandomNest drawn(seed);
    const Nest nest(drawn.part, drawn.fixed, drawn.grow_mm);
    if (!nest.obstacles.round_exactly) continue;
    const witness::PlannedNest planned(drawn.part, drawn.fixed, drawn.grow_mm);
    for (int k = 0; k < 60; ++k) {
      const Configuration q{witness::uniform(random, -45, 45), witness::uniform(random, -35, 25),
                            witness::uniform(random, -9, 9)};
      CAPTURE(seed, q.x_mm, q.y_mm, q.theta_rad);
      CHECK(planned.clearance_mm(q) == Approx(std::max(0.0, clearance_mm(nest.part, nest.obstacles, q))).margin(1e-8));
      free += planned.clearance_mm(q) > 0;
      round += planned.clearance_mm(q) > 0 && drawn.grow_mm > 0;
    }
  }
  CHECK(free > 500);
  CHECK(round > 100);
}

TEST_CASE("the planner comes near to heights that are known and not below them") {
  // Straight up and out; over a corner, half a diagonal of 6 x 6; and upright between walls, then over the rim.
  const double deep = lowest_rise(block(-3, -3, 3, 3), pocket(30, 9), {0, 3.01, 0}, 20, 2500);
  CHECK(deep > 9 - 0.01);
  CHECK(deep < 9.5);
  const double flat = lowest_rise(block(-3, -6, 3, 6), pocket(40, 3), {0, 6.01, 0}, 10, 2500);
  CHECK(flat > std::sqrt(45.0) - 6.01);
  CHECK(flat < std::sqrt(45.0) - 6.01 + 0.3);
  CHECK(std::isinf(lowest_rise(block(-3, -3, 3, 3), pocket(30, 9), {0, 3.01, 0}, 9 - 0.01 - 1e-6, 800)));
}

TEST_CASE("a planner that knows the way of the upper bound comes under it but not under the lower bound") {
  int attacked = 0, threaded = 0;
  for (const std::uint64_t seed : {0, 8, 10, 12}) {
    const witness::Attack attack = witness::attacked_nest(seed, 800, 0.1);
    CAPTURE(seed, attack.lower_mm, attack.upper_mm, attack.pushed_mm, attack.alone_mm);
    REQUIRE(attack.why_not == nullptr);
    ++attacked;
    CHECK_FALSE(attack.got_below);
    // It can thread what is free: the way that is known, and the little that is lower.
    threaded += attack.pushed_mm < attack.upper_mm;
  }
  CHECK(threaded >= attacked - 1);
}

TEST_CASE("no planner gets below the lower bounds of many nests", "[.long]") {
  for (std::uint64_t seed = 200; seed < 300; ++seed) {
    const witness::Attack attack = witness::attacked_nest(seed, 8000, 0.1);
    CAPTURE(seed, attack.lower_mm, attack.upper_mm, attack.pushed_mm, attack.alone_mm);
    CHECK_FALSE(attack.got_below);
  }
}
