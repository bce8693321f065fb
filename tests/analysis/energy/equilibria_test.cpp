#include "analysis/energy/equilibria.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "analysis/geometry/boolean.hpp"
#include "witness/sampled_equilibria.hpp"

using namespace formotion;
using namespace formotion::witness;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDown = -kPi / 2;
constexpr double kInfinite = std::numeric_limits<double>::infinity();

Obstacles obstacles_of(const std::vector<Loop>& loops) {
  std::vector<ObstacleShape> shapes;
  for (const Loop& loop : loops) shapes.push_back({{loop, {}}, 0, false});
  return *make_obstacles(shapes);
}

// Its lower left corner and upper right corner from the centre of mass.
MovingShape block(double left, double low, double right, double high) {
  return MovingShape::of({{rectangle(left, low, right, high), {}}}, 0.3 * (right - left + high - low));
}

PushSet known(double direction_rad, double friction) { return {direction_rad, direction_rad, friction, friction}; }

std::vector<ContactPoint> feet(double half_width, double height) {
  return {{{0, 1}, {-half_width, -height}}, {{0, 1}, {half_width, -height}}};
}

std::vector<ContactPoint> random_contacts(Random& random) {
  std::vector<ContactPoint> contacts;
  const int count = 1 + below(random, 4);
  for (int i = 0; i < count; ++i) {
    const double a = uniform(random, -kPi, kPi);
    contacts.push_back({{std::cos(a), std::sin(a)}, {uniform(random, -5, 5), uniform(random, -5, 5)}});
  }
  return contacts;
}

bool holds(const std::vector<ContactPoint>& contacts, const Point& force, double moment, double friction) {
  MotionLaw law = damped(force, 3, friction);
  law.load.z() = moment;
  return equilibrium(contacts, law).has_value();
}

double least_theta(const EquilibriumSet& set) {
  return std::min_element(set.samples.begin(), set.samples.end(),
                          [](const auto& a, const auto& b) { return a.theta_rad < b.theta_rad; })
      ->theta_rad;
}
double most_theta(const EquilibriumSet& set) {
  return std::max_element(set.samples.begin(), set.samples.end(),
                          [](const auto& a, const auto& b) { return a.theta_rad < b.theta_rad; })
      ->theta_rad;
}

}  // namespace

TEST_CASE(
    "a block on a floor resists mu times its weight or tips first: its weight upwards and half its width in moment") {
  for (const auto& [half, height, mu] :
       {std::tuple(5.0, 3.0, 0.3), std::tuple(1.0, 3.0, 2.0), std::tuple(2.0, 4.0, 0.0)}) {
    const auto contacts = feet(half, height);
    CAPTURE(half, height, mu);
    CHECK(resisted(contacts, kDown, mu, 0) == Approx(std::min(mu, half / height)).margin(1e-9));
    CHECK(resisted(contacts, kDown, mu, kPi) == Approx(std::min(mu, half / height)).margin(1e-9));
    CHECK(resisted(contacts, kDown, mu, kPi / 2) == Approx(1));
    CHECK(resisted(contacts, kDown, mu, kDown) == kInfinite);
    CHECK(resisted_moment_mm(contacts, kDown, mu) == Approx(half));
    const double slope = std::min(mu, half / height);
    CHECK(least_resisted(contacts, kDown, mu) == Approx(slope / std::hypot(1, slope)).margin(1e-9));
  }
  CHECK(resisted(feet(5, 3), 0, 0.3, 0) == 0);
  CHECK(least_resisted(feet(5, 3), 0, 0.3) == 0);
  CHECK(resisted_moment_mm(feet(5, 3), 0, 0.3) == 0);
  CHECK(can_hold({}, known(kDown, 1), 3) == Verdict::Impossible);
}

TEST_CASE("opposing contacts hold every force with friction and without it only those along their line") {
  const std::vector<ContactPoint> jaws{{{1, 0}, {-5, 0}}, {{-1, 0}, {5, 0}}};
  CHECK(can_hold(jaws, {0, kPi, 0.1, 0.2}, 3) == Verdict::Certain);
  CHECK(resisted(jaws, kDown, 0.1, 1.234) == kInfinite);
  CHECK(resisted_moment_mm(jaws, kDown, 0.1) == kInfinite);
  CHECK(can_hold(jaws, known(0, 0), 3) == Verdict::Certain);
  CHECK(can_hold(jaws, known(kPi, 0), 3) == Verdict::Certain);
  CHECK(can_hold(jaws, known(kDown, 0), 3) == Verdict::Impossible);
  // Both ends of this half turn are held, what is between is not.
  CHECK(can_hold(jaws, {0, kPi, 0, 0}, 3) == Verdict::Possible);
  CHECK(resisted(jaws, 0, 0, kPi) == kInfinite);
  CHECK(least_resisted(jaws, 0, 0) == 0);
  // Two feet hold by the one on either side: a half turn of forces into a wall, with friction enough, only nearly.
  CHECK(can_hold(feet(100, 1), {-kPi, 0, 50, 50}, 3) == Verdict::Possible);
}

TEST_CASE(
    "what can be held and how much more agrees with single forces tried one by one: 400 random sets of contacts") {
  Random random(20261201);
  int certain = 0, possible = 0, impossible = 0, finite = 0;
  for (int i = 0; i < 400; ++i) {
    const auto contacts = random_contacts(random);
    PushSet push;
    push.from_rad = uniform(random, -kPi, kPi);
    push.to_rad = push.from_rad + (i % 3 == 0 ? 0 : uniform(random, 0, i % 3 == 1 ? 0.5 : kPi));
    push.friction_min = i % 5 == 0 ? 0 : uniform(random, 0, 1);
    push.friction_max = push.friction_min + (i % 2 == 0 ? 0 : uniform(random, 0, 0.5));
    const Verdict verdict = can_hold(contacts, push, 3);
    CAPTURE(i, name(verdict), contacts.size());
    int held = 0;
    bool some = false;
    for (int k = 0; k <= 40; ++k) {
      const double a = push.from_rad + (push.to_rad - push.from_rad) * k / 40;
      held += holds(contacts, {std::cos(a), std::sin(a)}, 0, push.friction_min);
      some = some || holds(contacts, {std::cos(a), std::sin(a)}, 0, push.friction_max);
    }
    CHECK((held == 41) == (verdict == Verdict::Certain));
    if (some) CHECK(verdict != Verdict::Impossible);
    if (!some) CHECK(sampled_verdict(contacts, push, 3, 1e-9) == verdict);
    certain += verdict == Verdict::Certain;
    possible += verdict == Verdict::Possible;
    impossible += verdict == Verdict::Impossible;

    const Point force(std::cos(push.from_rad), std::sin(push.from_rad));
    const double towards = uniform(random, -kPi, kPi), mu = push.friction_max;
    const Point added(std::cos(towards), std::sin(towards));
    const double most = resisted(contacts, push.from_rad, mu, towards);
    const double least = least_resisted(contacts, push.from_rad, mu);
    const double moment = resisted_moment_mm(contacts, push.from_rad, mu);
    if (!holds(contacts, force, 0, mu)) {
      CHECK(most + least + moment == 0);
      continue;
    }
    CHECK(least <= most + 1e-9);
    CHECK(holds(contacts, force + std::min(1e3, 0.999 * most) * added, 0, mu));
    if (most < 1e3) CHECK_FALSE(holds(contacts, force + (1.001 * most + 1e-6) * added, 0, mu));
    for (const double way : {1.0, -1.0}) CHECK(holds(contacts, force, way * std::min(1e3, 0.999 * moment), mu));
    if (moment < 1e3)
      CHECK_FALSE(
          (holds(contacts, force, 1.001 * moment + 1e-6, mu) && holds(contacts, force, -1.001 * moment - 1e-6, mu)));
    if (least == kInfinite) continue;
    ++finite;
    bool lets_go = false;
    for (int k = 0; k < 720; ++k) {
      const double a = kPi * k / 360;
      const Point other(std::cos(a), std::sin(a));
      lets_go = lets_go || !holds(contacts, force + (1.001 * least + 1e-6) * other, 0, mu);
      CHECK(holds(contacts, force + 0.999 * least * other, 0, mu));
    }
    CHECK(lets_go);
  }
  CHECK(certain > 40);
  CHECK(possible > 40);
  CHECK(impossible > 40);
  CHECK(finite > 30);
}

TEST_CASE("a block on an incline rests for certain or possibly or never by its friction") {
  const double slope = 0.3;
  const MovingShape part = block(-5, -3, 5, 3);
  const double c = std::cos(slope), s = std::sin(slope);
  const Obstacles ramp = obstacles_of({{{-50 * c, -50 * s},
                                        {50 * s - 50 * c, -50 * s - 50 * c},
                                        {50 * c + 50 * s, 50 * s - 50 * c},
                                        {50 * c, 50 * s}}});
  const ContactSpace space(part, ramp);
  const auto best = [&](double low, double high) {
    Verdict found = Verdict::Impossible;
    for (const EquilibriumSet& set : equilibria(space, {kDown, kDown, low, high})) {
      if (std::abs(std::remainder(set.certain.theta_rad - slope, kPi / 2)) < 1e-9) found = std::max(found, set.verdict);
    }
    return found;
  };
  const double critical = std::tan(slope);
  CHECK(best(critical + 1e-6, critical + 0.1) == Verdict::Certain);
  CHECK(best(critical - 1e-6, critical + 1e-6) == Verdict::Possible);
  CHECK(best(0, critical - 1e-6) == Verdict::Impossible);
}

TEST_CASE("a rectangle on a floor has four sets: each as long as the mass stays over the floor") {
  const MovingShape part = block(-5, -3, 5, 3);
  const Obstacles floor = obstacles_of({rectangle(-50, -10, 50, 0)});
  const ContactSpace space(part, floor);
  for (const double mu : {0.0, 0.3}) {
    const auto sets = equilibria(space, known(kDown, mu));
    REQUIRE(sets.size() == 4);
    for (const EquilibriumSet& set : sets) {
      CHECK(set.verdict == Verdict::Certain);
      CHECK(set.size_mm == Approx(100));
      CHECK(std::abs(std::remainder(set.certain.theta_rad, kPi / 2)) < 1e-12);
    }
  }
  for (const EquilibriumSet& set : equilibria(space, {kDown - 0.1, kDown + 0.1, 0, 0}))
    CHECK(set.verdict == Verdict::Possible);
}

TEST_CASE("a ladder rests on floor and wall iff tan theta is at least (1 - mu^2) / (2 mu)") {
  const MovingShape part = block(-50, -5e-4, 50, 5e-4);
  const Obstacles corner = obstacles_of({rectangle(-10, -10, 200, 0), rectangle(-10, -10, 0, 200)});
  const ContactSpace space(part, corner);
  for (const double mu : {0.3, 0.5, 0.9}) {
    // It leans: foot on the floor, head on the wall; steepest at pi / 2.
    const double limit = kPi - std::atan((1 - mu * mu) / (2 * mu));
    double found = 0;
    for (const EquilibriumSet& set : equilibria(space, known(kDown, mu))) {
      const double middle = 0.5 * (kPi / 2 + limit);
      if (least_theta(set) < middle && middle < most_theta(set)) found = std::max(found, most_theta(set));
    }
    CAPTURE(mu);
    CHECK(found == Approx(limit).margin(1e-4));
  }
}

TEST_CASE("a rectangle on two corners in a right-angled vee tilts by atan(sin 2 phi / (k + cos 2 phi)) either way") {
  // Contacts, vee and the normals' meeting point lie on a circle about the middle of the lower edge; friction turns
  // that point by 2 phi about it (derived). k: twice the mass's height over the edge, by the edge's length.
  const Obstacles vee = obstacles_of({{{0, 0}, {100, -10}, {100, 100}}, {{0, 0}, {-100, 100}, {-100, -10}}});
  for (const auto& [height, mu] :
       {std::pair(4.0, 0.2), std::pair(5.0, 0.2), std::pair(3.0, 0.1), std::pair(4.0, 0.0)}) {
    const MovingShape part = block(-5, -height, 5, 2);
    const ContactSpace space(part, vee);
    const double phi = std::atan(mu), tilt = std::atan(std::sin(2 * phi) / (height / 5 + std::cos(2 * phi)));
    int found = 0;
    for (const EquilibriumSet& set : equilibria(space, known(kDown, mu))) {
      const double off = std::remainder(set.certain.theta_rad, 2 * kPi);
      if (std::abs(off) > tilt + 0.01) continue;
      ++found;
      CHECK(most_theta(set) - least_theta(set) == Approx(2 * tilt).margin(1e-7));
      CHECK(std::abs(off) <= tilt + 1e-7);
    }
    CAPTURE(height, mu);
    CHECK(found == 1);
  }
}

TEST_CASE("a peg is wedged against every force only where the line between its contacts is in both friction cones") {
  const double mu = 0.8;
  const MovingShape part = block(-5, -20, 5, 20);
  const Obstacles slot = obstacles_of({rectangle(-50, -80, -5.1, 0), rectangle(5.1, -80, 50, 0)});
  const ContactSpace space(part, slot);
  const auto off_normals = [&](const Configuration& q) {
    const auto touches = touches_at(space, q);
    if (touches.size() != 2) return -1.0;
    const ContactState &a = touches[0][0].state, &b = touches[1][0].state;
    const Point line = (b.lever - a.lever).normalized();
    return std::max(std::acos(std::abs(line.dot(a.normal))), std::acos(std::abs(line.dot(b.normal))));
  };
  int wedged = 0;
  for (const EquilibriumSet& set : equilibria(space, {-kPi, 0, mu, mu})) {
    if (set.verdict != Verdict::Certain) continue;
    ++wedged;
    CHECK(off_normals(set.certain) >= 0);
    CHECK(off_normals(set.certain) <= std::atan(mu) + 1e-6);
  }
  CHECK(wedged >= 4);
  // Without enough friction nothing is held for every force.
  for (const EquilibriumSet& set : equilibria(space, {-kPi, 0, 0.01, 0.01})) CHECK(set.verdict == Verdict::Possible);
}

TEST_CASE("a part balanced with a convex corner on a convex corner is no equilibrium of two contacts") {
  const MovingShape part = block(-5, -5, 5, 5);
  const Obstacles peak = obstacles_of({{{0, 0}, {-10, -60}, {10, -60}}});
  const ContactSpace space(part, peak);
  CHECK(equilibria(space, known(kDown, 0.1)).empty());
}

TEST_CASE("a triangle that just fits its pocket rests there and nowhere else in it") {
  const MovingShape part = MovingShape::of({{{{-6, -2}, {6, -2}, {0, 4}}, {}}}, 3);
  const Obstacles pocket = obstacles_of({{{0, 0}, {20, 20}, {20, -5}, {-20, -5}, {-20, 20}}});
  const ContactSpace space(part, pocket);
  int found = 0;
  for (const EquilibriumSet& set : equilibria(space, known(kDown, 0))) {
    if (std::abs(std::remainder(set.certain.theta_rad - kPi, 2 * kPi)) > 0.1) continue;
    ++found;
    CHECK(set.size_mm < 1e-6);
    CHECK(set.certain.y_mm == Approx(4));
  }
  CHECK(found == 1);
}

namespace {

void compare_scenes(int scenes, bool on_grid, double grow_mm) {
  SetAgreement total;
  for (int i = 0; i < scenes; ++i) {
    Random random(1000 + i);
    const StaticScene scene = random_static_scene(random, on_grid, grow_mm);
    const ContactSpace space(scene.part, scene.obstacles);
    const auto one = compare_sets(scene, equilibria(space, scene.push), 12 * kPi / 180, 0.03);
    CAPTURE(i, one.held, one.samples);
    CHECK(one.missed == 0);
    CHECK(one.unheld == 0);
    CHECK(one.short_of == 0);
    total.held += one.held;
    total.sets += one.sets;
  }
  CHECK(total.held > 5 * scenes);
  CHECK(total.sets > 4 * scenes);
}

}  // namespace

TEST_CASE("sets agree with slices of free space tried one by one: 60 random scenes") { compare_scenes(60, false, 0); }
TEST_CASE("sets agree with slices of free space tried one by one: 50 scenes of right angles") {
  compare_scenes(50, true, 0);
}
TEST_CASE("sets agree with slices of free space tried one by one: 6 scenes of rounded shapes") {
  compare_scenes(6, false, 0.3);
}
