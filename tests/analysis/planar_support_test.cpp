#include "analysis/constraints/planar_support.hpp"

#include <catch2/catch.hpp>

#include "analysis/geometry/boolean.hpp"
#include "witness/exact_support.hpp"
#include "witness/random_shapes.hpp"

using namespace formotion;

namespace {

void check_same(const std::optional<double>& fast, const std::optional<double>& slow, int i) {
  CAPTURE(i, fast.value_or(-99), slow.value_or(-99));
  REQUIRE(fast.has_value() == slow.has_value());
  if (fast) REQUIRE(*fast == Approx(*slow).margin(1e-8));
}

}  // namespace

TEST_CASE("support agrees with exact Boolean operations and convex hull in 14,000 random configurations") {
  witness::Random random(20260101);
  for (int i = 0; i < 14000; ++i) {
    const witness::Situation s = witness::random_situation(random);
    check_same(support_margin(s.part, s.track, s.supported_point),
               witness::margin_by_boolean_operations(s.part, s.track, s.supported_point), i);
  }
}

TEST_CASE("support agrees with exact closed membership in 6,000 degenerate configurations") {
  witness::Random random(20260102);
  int without_area = 0;
  for (int i = 0; i < 6000; ++i) {
    const witness::Situation s = witness::degenerate_situation(random);
    const auto fast = support_margin(s.part, s.track, s.supported_point);
    check_same(fast, witness::margin_by_exact_generators(s.part, s.track, s.supported_point), i);
    const auto area = witness::margin_by_boolean_operations(s.part, s.track, s.supported_point);
    without_area += fast.has_value() != area.has_value() || (fast && std::abs(*fast - *area) > 1e-6);
  }
  CHECK(without_area > 50);  // contact without area did occur, and counted
}

TEST_CASE("the margin jumps when the nose lands on the far lip") {
  // Half-length 0.5 over a gap of 0.6: the centre passes the first lip at x = 0, the nose meets the far one at x = 0.1.
  const Polygon part{rectangle(-0.5, 0, 0.5, 1), {}};
  const Track track{2, {{rectangle(0, -5, 0.6, 5), {}}}};
  const auto margin = [&](double x) { return *support_margin(placed(part, 0, {x, 0}), track, {x, 0.5}); };
  CHECK(margin(0.0999) == Approx(-0.0999).margin(1e-9));
  CHECK(margin(0.1001) == Approx(0.5).margin(1e-9));
}

TEST_CASE("a centre of mass on the hull's edge is marginal: margin zero") {
  const Polygon part{rectangle(0, 0, 10, 10), {}};
  const Track track{20, {{rectangle(5, -1, 30, 30), {}}}};
  CHECK(*support_margin(part, track, {5, 5}) == Approx(0).margin(1e-12));
}

TEST_CASE("support along a line only is support: its hull has no inside, so the margin is never positive") {
  const Polygon part{rectangle(0, 5, 10, 10), {}};
  const Track touching{5, {}};  // the part's lower edge lies on the free edge
  CHECK(*support_margin(part, touching, {5, 5}) == Approx(0).margin(1e-12));
  CHECK(*support_margin(part, touching, {5, 6}) == Approx(-1));
  CHECK(*support_margin(part, touching, {12, 5}) == Approx(-2));
}

TEST_CASE("nothing under the part is no margin") {
  const Polygon part{rectangle(0, 0, 10, 10), {}};
  CHECK_FALSE(support_margin(part, {20, {{rectangle(-50, -1, 50, 30), {}}}}, {5, 5}).has_value());
}

TEST_CASE("a part's hole does not support, its rim does") {
  const Polygon frame{rectangle(0, 0, 10, 10), {{{2, 2}, {2, 8}, {8, 8}, {8, 2}}}};
  // Metal is left only beneath the hole: nothing but the rim touches it.
  const Track post{20, united({rectangle(-5, -5, 30, 2), rectangle(-5, 8, 30, 30), rectangle(-5, 0, 2, 20),
                               rectangle(8, 0, 30, 20)})};
  CHECK(*support_margin(frame, post, {5, 5}) == Approx(3));
  const Track smaller{20, united({rectangle(-5, -5, 30, 3), rectangle(-5, 7, 30, 30), rectangle(-5, 0, 3, 20),
                                  rectangle(7, 0, 30, 20)})};
  CHECK_FALSE(support_margin(frame, smaller, {5, 5}).has_value());
}

TEST_CASE("the margin does not change when everything is mirrored") {
  witness::Random random(7);
  for (int i = 0; i < 500; ++i) {
    const witness::Situation s = witness::random_situation(random);
    Track mirrored{s.track.width_mm, {}};
    for (const Polygon& hole : s.track.voids) mirrored.voids.push_back(mirrored_x(hole));
    const auto a = support_margin(s.part, s.track, s.supported_point);
    const auto b = support_margin(mirrored_x(s.part), mirrored, {-s.supported_point.x(), s.supported_point.y()});
    REQUIRE(a.has_value() == b.has_value());
    if (a) REQUIRE(*a == Approx(*b).margin(1e-9));
  }
}
