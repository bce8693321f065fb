// What the first impact takes away, and what is captured because of it.
#include "analysis/energy/first_impact.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "analysis/energy/nests.hpp"

using namespace formotion;
using namespace formotion::testing;

namespace {

// The share of its energy that a part falling along -y keeps: the impact followed by small normal impulses (mass 1),
// sliding, sticking or turning back, until restitution has given back e^2 of the work of compression. A slow and
// obviously right answer.
double kept_step_by_step(const ContactPoint& contact, const ImpactLaw& law) {
  const Point n = contact.normal, t = turned_left(n);
  const double rn = cross(contact.lever, n) / law.gyration_mm, rt = cross(contact.lever, t) / law.gyration_mm;
  Point v(0, -1);
  double spin = 0, compression = 0, restored = 0;  // spin times the radius of gyration
  const double step = 1e-5;
  for (bool compressed = false;;) {
    const double normal_speed = n.dot(v) + rn * spin, slip = t.dot(v) + rt * spin;
    compressed = compressed || normal_speed >= 0;
    if (compressed && restored >= law.restitution * law.restitution * compression) break;
    // The tangential impulse that would end the slip within the step, as far as friction allows.
    const double wanted = -(slip / step + rn * rt) / (1 + rt * rt);
    const double along = std::clamp(wanted, -law.friction, law.friction);
    (compressed ? restored : compression) += std::abs(normal_speed) * step;
    v += step * (n + along * t);
    spin += step * (rn + along * rt);
  }
  return v.squaredNorm() + spin * spin;
}

}  // namespace

TEST_CASE("no impact followed step by step keeps more energy than the bound says") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(0, 1);
  double nearest = 1;
  for (int i = 0; i < 600; ++i) {
    const double turn = (share(random) - 0.5) * 2.8;
    const ContactPoint contact{{std::sin(turn), std::cos(turn)}, {8 * share(random) - 4, 8 * share(random) - 4}};
    const ImpactLaw law{share(random), i % 3 == 0 ? 0 : 1.5 * share(random), 0.5 + 4 * share(random)};
    const double bound = share_kept(contact, {0, -1}, law), kept = kept_step_by_step(contact, law);
    CAPTURE(i, bound, kept);
    REQUIRE(kept <= bound + 2e-3);
    if (law.friction == 0) REQUIRE(kept == Approx(bound).margin(2e-3));
    nearest = std::min(nearest, bound - kept);
  }
  CHECK(nearest < 2e-3);
}

TEST_CASE("a central impact keeps the square of the restitution and a side that is not approached keeps all") {
  const ImpactLaw law{0.3, 0.4, 2};
  CHECK(share_kept({{0, 1}, {0, -3}}, {0, -1}, law) == Approx(0.09));
  CHECK(share_kept({{1, 0}, {-3, 0}}, {0, -1}, law) == 1);
  CHECK(share_kept({{0, -1}, {0, 3}}, {0, -1}, law) == 1);
  CHECK(share_kept({{0, 1}, {0, -3}}, {0, -1}, {1, 0, 2}) == Approx(1));
  // A rod's end (Routh 1905): 1 - (1 - e^2) rho^2 / (rho^2 + r^2).
  CHECK(share_kept({{0, 1}, {-4, 0}}, {0, -1}, {0.5, 0, 2}) == Approx(1 - 0.75 * 4 / 20));
}

TEST_CASE("a part lands where it first touches and its energy is what the impact leaves") {
  const Nest nest(block(-1, -1, 1, 1), block(-10, -5, 10, 0));
  const ImpactLaw law{0.5, 0.2, std::sqrt(2.0 / 3)};
  const auto flat = landing(nest.space, nest.gravity, {2, 6, 0}, law);
  REQUIRE(flat);
  CHECK(flat->at.y_mm == Approx(1).margin(2e-6));
  // A corner of the flat side: r x n = 1, r x t = 1 (both ends alike).
  CHECK(flat->energy_mm == Approx(1 + 5 * (1 - 0.75 / (1 + 1.5 + 0.2 * 1.5))).margin(1e-5));
  const auto on_corner = landing(nest.space, nest.gravity, {2, 6, std::numbers::pi / 4}, law);
  REQUIRE(on_corner);
  CHECK(on_corner->at.y_mm == Approx(std::sqrt(2)).margin(2e-6));
  CHECK(on_corner->energy_mm == Approx(std::sqrt(2) + 0.25 * (6 - std::sqrt(2))).margin(1e-5));
  CHECK_FALSE(landing(nest.space, nest.gravity, {12, 6, 0}, law));  // past the floor
  CHECK_FALSE(landing(nest.space, nest.gravity, {2, 0, 0}, law));   // in it
  const auto resting = landing(nest.space, nest.gravity, {2, 1, 0}, law);
  REQUIRE(resting);
  CHECK(resting->energy_mm == Approx(1).margin(2e-6));
}

TEST_CASE("a fall that is too high for a puddle is captured if its first impact takes enough away") {
  const Nest nest(block(-1, -1, 1, 1), pocket(8, 3));
  const Configuration rest{0, 1, 0};
  const double rise = 3 - 1e-6;
  const Configuration from{0, 5, std::numbers::pi / 4};
  CHECK_FALSE(surely_captured(nest.space, nest.gravity, rest, rise, from));
  const auto dull = landing(nest.space, nest.gravity, from, {0.3, 0.2, std::sqrt(2.0 / 3)});
  REQUIRE(dull);
  CHECK(surely_captured(nest.space, nest.gravity, rest, rise, dull->at, dull->energy_mm));
  const auto lively = landing(nest.space, nest.gravity, from, {0.9, 0.2, std::sqrt(2.0 / 3)});
  REQUIRE(lively);
  CHECK_FALSE(surely_captured(nest.space, nest.gravity, rest, rise, lively->at, lively->energy_mm));
}
