// The contact law where theory says how many motions there are, and how they scale.
#include "analysis/motion/contact_law.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "witness/random_shapes.hpp"

using namespace formotion;
using namespace formotion::witness;

namespace {

constexpr double kPi = std::numbers::pi;

Point direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

MotionLaw random_load(Random& random, double gyration, double friction) {
  MotionLaw law = damped(direction(uniform(random, 0, 2 * kPi)), gyration, friction);
  law.load[2] = gyration * uniform(random, -3, 3);
  return law;
}

Eigen::Vector3d row(const ContactPoint& contact, const Point& along) {
  return {along.x(), along.y(), cross(contact.lever, along)};
}

}  // namespace

TEST_CASE("one contact has three answers for some loads iff f |r x n| |r x t| > gyration^2 + (r x n)^2") {
  Random random(20261201);
  int ambiguous = 0, plain = 0;
  for (int i = 0; i < 2000; ++i) {
    const double gyration = uniform(random, 0.3, 2), friction = uniform(random, 0.1, 4);
    const Point normal = direction(uniform(random, 0, 2 * kPi));
    const ContactPoint contact{normal, uniform(random, 0.2, 4) * direction(uniform(random, 0, 2 * kPi))};
    const double rn = cross(contact.lever, normal), rt = cross(contact.lever, turned_left(normal));
    const double excess = friction * std::abs(rn * rt) - (gyration * gyration + rn * rn);
    if (std::abs(excess) < 1e-2) continue;
    // Loads that press or pull alike; those that slide the contact in the direction in which it digs in are among them.
    bool three = false;
    for (int k = 0; k < 40; ++k) {
      const MotionLaw law = random_load(random, gyration, friction);
      const std::size_t answers = consistent_motions(std::span(&contact, 1), law).size();
      REQUIRE((answers == 1 || answers == 3));
      three = three || answers == 3;
      if (excess < 0) REQUIRE(answers == 1);
    }
    ++(three ? ambiguous : plain);
    // A load made for it: the sliding force alone, times -1, drives the contact apart and holds it there as well.
    if (excess < 0) continue;
    const double s = rn * rt > 0 ? 1 : -1;  // of the sliding against which friction digs in
    MotionLaw law = damped({0, 0}, gyration, friction);
    const Eigen::Vector3d f = row(contact, normal) - s * friction * row(contact, turned_left(normal));
    law.load = -f;
    if (consistent_motions(std::span(&contact, 1), law).size() < 2) {
      // At this very load the part is at rest on the cone's edge; a little aside there are three.
      FAIL("the load on the cone's edge has one answer");
    }
  }
  CHECK(ambiguous > 100);
  CHECK(plain > 500);
}

TEST_CASE("the answers of an ambiguous contact are those of Painleve: apart, sticking, sliding") {
  // A rod that leans: the contact below to the left of the centre of mass, friction 3.
  const ContactPoint contact{{0, 1}, {-1, -2}};
  const double gyration = 0.5, friction = 3;
  // r x n = -1, r x t = -2: 3 * 2 > 0.25 + 1.
  MotionLaw law = damped({1, -1}, gyration, friction);
  Random random(20261202);
  int three = 0;
  for (int i = 0; i < 2000; ++i) {
    law.load = {uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
    const std::vector<Motion> motions = consistent_motions(std::span(&contact, 1), law);
    if (motions.size() == 1) continue;
    ++three;
    REQUIRE(motions.size() == 3);
    int apart = 0, sticks = 0, slides = 0;
    for (const Motion& motion : motions) {
      apart += motion.modes[0] == ContactMode::Break;
      sticks += motion.modes[0] == ContactMode::Stick;
      slides += motion.modes[0] == ContactMode::SlideLeft || motion.modes[0] == ContactMode::SlideRight;
    }
    CHECK(apart == 1);
    CHECK(sticks == 1);
    CHECK(slides == 1);
  }
  CHECK(three > 20);
}

TEST_CASE("where opposite contacts can wedge, rest and motion are both listed, without friction motion alone") {
  // In a channel of its own width, driven along it.
  const std::vector<ContactPoint> contacts{{{0, 1}, {0, -1}}, {{0, -1}, {0, 1}}};
  for (const double angle : {-0.2, 0.0, 0.2}) {
    const MotionLaw rough = damped(direction(angle), 1, 0.3);
    const std::vector<Motion> motions = consistent_motions(contacts, rough);
    REQUIRE(motions.size() == 2);
    CHECK(motions[0].at_rest());
    CHECK(motions[1].twist.linear.x() == Approx(std::cos(angle) - 0.3 * std::abs(std::sin(angle))).margin(1e-12));
    CHECK(motions[1].twist.linear.y() == Approx(0).margin(1e-12));
    const std::vector<Motion> smooth = consistent_motions(contacts, damped(direction(angle), 1, 0));
    REQUIRE(smooth.size() == 1);
    CHECK(smooth[0].twist.linear.x() == Approx(std::cos(angle)));
  }
  // Tapered by more than the friction on each side it cannot wedge, and slides out.
  const double half_angle = 0.31;
  const std::vector<ContactPoint> tapered{{direction(kPi / 2 - half_angle), {0, -1}},
                                          {direction(-kPi / 2 + half_angle), {0, 1}}};
  const std::vector<Motion> out = consistent_motions(tapered, damped({1, 0}, 1, 0.3));
  REQUIRE(out.size() == 1);
  CHECK_FALSE(out[0].at_rest());
  CHECK(consistent_motions(tapered, damped({1, 0}, 1, 0.35)).size() == 2);
  // Driven into the taper it is held with any friction, and there is no other way.
  const std::vector<Motion> into = consistent_motions(tapered, damped({-1, 0}, 1, 0.0));
  REQUIRE(into.size() == 1);
  CHECK(into[0].at_rest());
}

TEST_CASE("without friction there is one motion: the feasible one nearest to the free one") {
  Random random(20261203);
  int several = 0;
  for (int i = 0; i < 3000; ++i) {
    const double gyration = uniform(random, 0.3, 2);
    const MotionLaw law = random_load(random, gyration, 0);
    std::vector<ContactPoint> contacts;
    const int count = 1 + below(random, 3);
    for (int k = 0; k < count; ++k)
      contacts.push_back({direction(uniform(random, 0, 2 * kPi)), 2 * direction(uniform(random, 0, 2 * kPi))});
    const std::vector<Motion> motions = consistent_motions(contacts, law);
    several += motions.size() > 1;
    if (motions.size() != 1) continue;
    // Gauss: (v - D F) . D^-1 (u - v) >= 0 for every feasible u. Feasible u by chance, and rest.
    const Twist& twist = motions[0].twist;
    const Eigen::Vector3d v(twist.linear.x(), twist.linear.y(), twist.angular);
    const Eigen::Vector3d weight(1, 1, gyration * gyration);
    const Eigen::Vector3d off = v - law.mobility * law.load;
    REQUIRE(off.cwiseProduct(weight).dot(-v) >= -1e-8);
    for (int k = 0; k < 30; ++k) {
      const Eigen::Vector3d u(uniform(random, -2, 2), uniform(random, -2, 2), uniform(random, -2, 2));
      bool feasible = true;
      for (const ContactPoint& contact : contacts) feasible = feasible && row(contact, contact.normal).dot(u) >= 0;
      if (feasible) REQUIRE(off.cwiseProduct(weight).dot(u - v) >= -1e-8);
    }
  }
  CHECK(several == 0);
}

TEST_CASE("motions scale with load and mobility, and units of length do not matter") {
  Random random(20261204);
  for (int i = 0; i < 500; ++i) {
    const double gyration = uniform(random, 0.5, 2), friction = uniform(random, 0, 1);
    MotionLaw law = random_load(random, gyration, friction);
    std::vector<ContactPoint> contacts;
    for (int k = 0; k < 2; ++k)
      contacts.push_back({direction(uniform(random, 0, 2 * kPi)), 2 * direction(uniform(random, 0, 2 * kPi))});
    const std::vector<Motion> motions = consistent_motions(contacts, law);
    MotionLaw faster = law;
    faster.load *= 7;
    faster.mobility *= 3;
    const std::vector<Motion> fast = consistent_motions(contacts, faster);
    // Metres for millimetres: levers and gyration shrink, moments too.
    const double metre = 1e-3;
    MotionLaw other = damped({law.load[0], law.load[1]}, metre * gyration, friction);
    other.load[2] = metre * law.load[2];
    std::vector<ContactPoint> small = contacts;
    for (ContactPoint& contact : small) contact.lever *= metre;
    const std::vector<Motion> in_metres = consistent_motions(small, other);
    REQUIRE(fast.size() == motions.size());
    REQUIRE(in_metres.size() == motions.size());
    for (std::size_t k = 0; k < motions.size(); ++k) {
      const Twist& a = motions[k].twist;
      CHECK((fast[k].twist.linear - 21 * a.linear).norm() < 1e-9);
      CHECK(fast[k].twist.angular == Approx(21 * a.angular).margin(1e-9));
      CHECK((in_metres[k].twist.linear - a.linear).norm() < 1e-9);
      CHECK(metre * in_metres[k].twist.angular == Approx(a.angular).margin(1e-9));
    }
  }
}

TEST_CASE("turned and mirrored worlds move in turned and mirrored ways") {
  Random random(20261205);
  for (int i = 0; i < 500; ++i) {
    const MotionLaw law = random_load(random, uniform(random, 0.5, 2), uniform(random, 0, 2));
    std::vector<ContactPoint> contacts;
    for (int k = 0; k < 3; ++k)
      contacts.push_back({direction(uniform(random, 0, 2 * kPi)), 2 * direction(uniform(random, 0, 2 * kPi))});
    const double turn = uniform(random, 0, 2 * kPi);
    const auto mirrored = [](const Point& p) { return Point(-p.x(), p.y()); };
    std::vector<ContactPoint> turned = contacts, mirror = contacts;
    for (ContactPoint& c : turned) c = {rotated(c.normal, turn), rotated(c.lever, turn)};
    for (ContactPoint& c : mirror) c = {mirrored(c.normal), mirrored(c.lever)};
    MotionLaw turned_law = law, mirror_law = law;
    turned_law.load.head<2>() = rotated({law.load[0], law.load[1]}, turn);
    mirror_law.load = {-law.load[0], law.load[1], -law.load[2]};
    const std::vector<Motion> motions = consistent_motions(contacts, law);
    const std::vector<Motion> by_turn = consistent_motions(turned, turned_law);
    const std::vector<Motion> by_mirror = consistent_motions(mirror, mirror_law);
    REQUIRE(by_turn.size() == motions.size());
    REQUIRE(by_mirror.size() == motions.size());
    for (const Motion& motion : motions) {
      const auto has = [&](const std::vector<Motion>& list, const Point& linear, double angular) {
        return std::any_of(list.begin(), list.end(), [&](const Motion& m) {
          return (m.twist.linear - linear).norm() < 1e-8 && std::abs(m.twist.angular - angular) < 1e-8;
        });
      };
      CHECK(has(by_turn, rotated(motion.twist.linear, turn), motion.twist.angular));
      CHECK(has(by_mirror, mirrored(motion.twist.linear), -motion.twist.angular));
    }
  }
}
