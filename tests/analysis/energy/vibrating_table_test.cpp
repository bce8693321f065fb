// The bound of docs/nests.md against a mass followed from impact to impact, and each of its steps.
#include "analysis/energy/vibrating_table.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "witness/bouncing_mass.hpp"
#include "witness/random_shapes.hpp"

using namespace formotion;
using namespace formotion::witness;

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

// The most energy (as height) and the largest energy of a raising impact, over a number of impacts.
double highest(BouncingMass mass, int impacts) {
  double most = mass.energy_mm();
  for (int i = 0; i < impacts && !mass.rides; ++i) {
    mass.to_next_impact();
    most = std::max(most, mass.energy_mm());
  }
  return most;
}

double angular(const VibratingTable& table) { return kTurn * table.frequency_hz; }
// Peak acceleration over gravity.
double strength(const VibratingTable& table) {
  return table.amplitude_mm * angular(table) * angular(table) / kGravity_mm_s2;
}
VibratingTable table_of(double gamma, double frequency_hz, double restitution) {
  const double w = kTurn * frequency_hz;
  return {gamma * kGravity_mm_s2 / (w * w), frequency_hz, restitution};
}

// A frictionless bead that does not leave a round bottom of radius R: a pendulum whose pivot the table shakes.
// Its greatest height over the mean level of the bottom.
double bead_in_bowl(const VibratingTable& table, double radius_mm, double angle, double seconds) {
  const double w = angular(table), h = 1e-5;
  const auto turn = [&](double t, double at) {
    return -(kGravity_mm_s2 - table.amplitude_mm * w * w * std::sin(w * t)) / radius_mm * std::sin(at);
  };
  double rate = 0, most = 0;
  for (double t = 0; t < seconds && std::abs(angle) < 1.5; t += h) {
    const double half = rate + h / 2 * turn(t, angle);
    angle += h * half;
    rate = half + h / 2 * turn(t + h, angle);
    most = std::max(most, table.amplitude_mm * std::sin(w * t) + radius_mm * (1 - std::cos(angle)));
  }
  return most;
}

}  // namespace

TEST_CASE("An impact raises energy only below the speed K V and leaves with less than K V") {
  Random random(1);
  int raised = 0;
  for (int i = 0; i < 100000; ++i) {
    const double e = uniform(random, 0, 0.99), k = (1 + e) / (1 - e);
    const double table = uniform(random, -1, 1), approach = uniform(random, 0, 4 * k);
    const double before = table - approach, after = table + e * approach;
    const bool rises = after * after > before * before * (1 + 1e-12);
    CHECK(rises <= (-before < k * table));
    if (rises) CHECK((after > 0 && after < k * table));
    if (-before < k * table * (1 - 1e-9) && approach > 1e-6) CHECK(rises);
    raised += rises;
  }
  CHECK(raised > 1000);
}

TEST_CASE("The bound is the most energy of a mass that leaves the table at K times its speed") {
  for (const double e : {0.0, 0.3, 0.8}) {
    for (const double gamma : {0.02, 0.3, 0.9, 1.0, 1.5, 8.0}) {
      const VibratingTable table = table_of(gamma, 50, e);
      const double k = (1 + e) / (1 - e), w = angular(table);
      double most = 0;
      for (int i = 0; i <= 200000; ++i) {
        const double phase = kTurn / 4 * i / 200000, speed = k * table.amplitude_mm * w * std::cos(phase);
        most = std::max(most, table.amplitude_mm * std::sin(phase) + speed * speed / (2 * kGravity_mm_s2));
      }
      CHECK(greatest_height_mm(table) == Approx(most).epsilon(1e-8));
      CHECK(greatest_rise_mm(table) == Approx(most + table.amplitude_mm).epsilon(1e-8));
    }
  }
}

TEST_CASE("No mass that starts on the table is ever thrown above the bound") {
  Random random(2);
  double largest_share = 0;
  for (int i = 0; i < 240; ++i) {
    const double e = 0.1 * (1 + i % 9);
    const VibratingTable table = table_of(std::exp(uniform(random, -1, 3)), uniform(random, 5, 200), e);
    BouncingMass mass = mass_on(table, uniform(random, 0, kTurn), 0, 0);
    mass.speed_mm_s = mass.table_mm_s();
    const double start = uniform(random, 0, 1) < 0.5 ? mass.energy_mm() : greatest_height_mm(table);
    if (start > mass.energy_mm()) {
      mass.speed_mm_s = std::sqrt(2 * kGravity_mm_s2 * (start - mass.height_mm)) * uniform(random, 0, 1);
      mass.speed_mm_s = std::max(mass.speed_mm_s, mass.table_mm_s());
    }
    const double bound = greatest_height_mm(table);
    for (int k = 0; k < 10 && !mass.rides; ++k) mass.to_next_impact();  // what it started with is lost or kept
    const double most = highest(mass, 3000);
    CHECK(most <= bound * (1 + 1e-9));
    largest_share = std::max(largest_share, most / bound);
  }
  CAPTURE(largest_share);
  CHECK(largest_share > 0.9);
}

TEST_CASE("A mass that starts with more energy than vibration gives never gains any") {
  Random random(3);
  for (int i = 0; i < 50; ++i) {
    const VibratingTable table = table_of(uniform(random, 0.2, 6), uniform(random, 10, 100), uniform(random, 0, 0.9));
    const double start = greatest_height_mm(table) * uniform(random, 1, 3);
    BouncingMass mass = mass_on(table, uniform(random, 0, kTurn), 0, 0);
    mass.speed_mm_s = std::sqrt(2 * kGravity_mm_s2 * (start - mass.height_mm));
    CHECK(greatest_height_mm(table, start) == Approx(start));
    CHECK(highest(mass, 1000) <= start * (1 + 1e-9));
  }
}

TEST_CASE("Without restitution the mass reaches the bound") {
  for (const double gamma : {1.01, 1.2, 2.0, 5.0, 20.0}) {
    const VibratingTable table = table_of(gamma, 30, 0);
    BouncingMass mass = mass_on(table, 0, 0, 0);
    mass.speed_mm_s = mass.table_mm_s();
    REQUIRE_FALSE(mass.to_next_impact());  // rides until gravity cannot hold it
    CHECK(mass.energy_mm() == Approx(greatest_height_mm(table)).epsilon(1e-9));
  }
}

TEST_CASE("A mass whose every flight lasts one period stays in the closed form of that orbit") {
  const VibratingTable table = table_of(1.2, 30, 0.5);
  const double k = 3, w = angular(table), flight = 1 / table.frequency_hz, leaves = kGravity_mm_s2 * flight / 2;
  const double phase = std::acos(leaves / (k * table.amplitude_mm * w));
  BouncingMass mass = mass_on(table, phase, 0, leaves);
  for (int i = 0; i < 200; ++i) {
    REQUIRE(mass.to_next_impact());
    CHECK(std::remainder(mass.phase() - phase, kTurn) == Approx(0).margin(1e-6));
    CHECK(mass.speed_mm_s == Approx(leaves).epsilon(1e-6));
  }
}

TEST_CASE("The amplitude for a height is the largest whose bound is that height") {
  Random random(4);
  for (int i = 0; i < 2000; ++i) {
    const double height = std::exp(uniform(random, -6, 4)), e = uniform(random, 0, 0.95);
    const double frequency = std::exp(uniform(random, 0, 6));
    const double amplitude = amplitude_for_mm(height, frequency, e);
    CHECK(greatest_height_mm({amplitude, frequency, e}) == Approx(height).epsilon(1e-10));
    CHECK(greatest_height_mm({amplitude * 1.001, frequency, e}) > height);
    const double smaller = amplitude_for_rise_mm(height, frequency, e);
    CHECK(greatest_rise_mm({smaller, frequency, e}) == Approx(height).epsilon(1e-10));
    CHECK(smaller < amplitude);
  }
}

TEST_CASE("The bound is continuous where throwing begins") {
  const VibratingTable at = table_of(1.0 / 9, 40, 0.5);  // K^2 A w^2 = g
  for (const double share : {1 - 1e-9, 1.0, 1 + 1e-9}) {
    CHECK(greatest_height_mm({at.amplitude_mm * share, 40, 0.5}) == Approx(at.amplitude_mm).epsilon(1e-8));
  }
  CHECK(strength(at) == Approx(1.0 / 9));
}

TEST_CASE("Bounds have the dimension of length in gravity's units") {
  // 0.5 mm at 50 Hz, e = 0: 157.08 mm/s thrown at best, 1.258 mm, and g / (2 w^2) = 0.0497 mm more.
  CHECK(greatest_height_mm({0.5, 50, 0}) == Approx(1.3077).epsilon(1e-3));
  // Twice the frequency and a quarter of the amplitude: the same accelerations, a quarter of the height.
  CHECK(greatest_height_mm({0.125, 100, 0.4}) == Approx(greatest_height_mm({0.5, 50, 0.4}) / 4));
}

TEST_CASE("Tables at rest and elastic tables are the ends of the bound") {
  CHECK(greatest_height_mm({0, 50, 0.5}, 2) == 2);
  CHECK(greatest_height_mm({0, 50, 1}) == 0);
  CHECK(greatest_height_mm({0.3, 0, 1}) == 0.3);
  CHECK(std::isinf(greatest_height_mm({1e-9, 50, 1})));
  CHECK(std::isinf(greatest_rise_mm({1e-9, 50, 1})));
  CHECK(greatest_height_mm({0.3, 50, 0.999999999}) < 1e20);
  CHECK(amplitude_for_mm(3, 50, 1) == 0);
  CHECK(amplitude_for_mm(0, 50, 0.5) == 0);
  CHECK(amplitude_for_mm(-1, 50, 0.5) == 0);
  CHECK(amplitude_for_mm(3, 0, 0.5) == 3);
  CHECK(amplitude_for_rise_mm(3, 50, 1) == 0);
  CHECK(amplitude_for_rise_mm(3, 0, 0.5) == 1.5);
}

TEST_CASE("One impact can lift a turning body above the bound for point masses") {
  // It turns, so that the corner that touches is at rest just before and the rest of its energy is not at stake.
  const VibratingTable table = table_of(3, 40, 0.4);
  const double speed = table.amplitude_mm * angular(table), bound = greatest_height_mm(table);
  const double gyration = 4, lever = 4;  // of the corner, across gravity
  const double sinking = std::sqrt(2 * kGravity_mm_s2 * bound * 0.99 / (1 + gyration * gyration / (lever * lever)));
  const double rate = sinking / lever;  // centre down, corner up
  const double before = (sinking * sinking + gyration * gyration * rate * rate) / 2;
  CHECK(before < kGravity_mm_s2 * bound);
  const double approach = speed - (lever * rate - sinking);  // of table and corner
  const double impulse = (1 + table.restitution) * approach / (1 + lever * lever / (gyration * gyration));
  const double rising = -sinking + impulse, turning = rate + impulse * lever / (gyration * gyration);
  CHECK((rising + lever * turning) - speed == Approx(table.restitution * approach));  // it is that impact
  CHECK((rising * rising + gyration * gyration * turning * turning) / 2 > 1.05 * kGravity_mm_s2 * bound);
}

TEST_CASE("A round bottom shaken at twice its swing throws a bead above the bound for level floors") {
  const double radius = 20, swing = std::sqrt(kGravity_mm_s2 / radius);
  const VibratingTable table = table_of(0.4, 2 * swing / kTurn, 0);
  const double bound = greatest_height_mm(table, 0.01);
  CHECK(bound == Approx(table.amplitude_mm));  // a level floor would never lose the bead at 0.4 g
  CHECK(bead_in_bowl(table, radius, 0.01, 5) > 3 * bound);
}
