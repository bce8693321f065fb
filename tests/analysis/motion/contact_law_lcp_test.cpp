// The modes of contact_law.hpp against the complementarity problem, and against statics done by hand.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "analysis/motion/contact_law.hpp"
#include "witness/contact_lcp.hpp"
#include "witness/random_shapes.hpp"

using namespace formotion;
using namespace formotion::witness;

namespace {

constexpr double kPi = std::numbers::pi;

Point direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

LcpCase random_case(Random& random, int contacts, double friction) {
  LcpCase lcp;
  lcp.friction = friction;
  lcp.gyration_mm = uniform(random, 0.3, 1.5);
  const Point force = direction(uniform(random, 0, 2 * kPi));
  lcp.wrench = {force.x(), force.y(), below(random, 2) ? 0 : uniform(random, -1, 1)};
  for (int i = 0; i < contacts; ++i) {
    lcp.contacts.push_back(
        {direction(uniform(random, 0, 2 * kPi)), uniform(random, 0.1, 2) * direction(uniform(random, 0, 2 * kPi))});
  }
  return lcp;
}

// Contacts as polygons make them: ends of a flush edge, two normals at one point, opposite walls, axis-parallel loads.
LcpCase aligned_case(Random& random, int contacts, double friction) {
  LcpCase lcp;
  lcp.friction = friction;
  lcp.gyration_mm = 0.5 * (1 + below(random, 3));
  const Point force = direction(kPi / 4 * below(random, 8));
  lcp.wrench = {force.x(), force.y(), 0};
  for (int i = 0; i < contacts; ++i) {
    Point lever(below(random, 5) - 2, below(random, 5) - 2);
    if (i > 0 && below(random, 3) == 0) lever = lcp.contacts.front().lever;
    lcp.contacts.push_back({direction(kPi / 2 * below(random, 4)), lever});
  }
  return lcp;
}

struct Asked {
  std::vector<ContactPoint> contacts;
  MotionLaw law;
  std::vector<Motion> motions;
};

Asked ask(const LcpCase& lcp) {
  Asked asked;
  for (const LcpContact& contact : lcp.contacts) asked.contacts.push_back({contact.normal, contact.lever});
  asked.law = damped({lcp.wrench[0], lcp.wrench[1]}, lcp.gyration_mm, lcp.friction);
  asked.law.load[2] = lcp.wrench[2];
  asked.motions = consistent_motions(asked.contacts, asked.law);
  return asked;
}

Twist3 twist_of(const Motion& motion) {
  return {motion.twist.linear.x(), motion.twist.linear.y(), motion.twist.angular};
}

bool lists(const Asked& asked, const Twist3& twist) {
  for (const Motion& motion : asked.motions) {
    if ((twist_of(motion) - twist).norm() < 1e-6 * (1 + twist.norm())) return true;
  }
  return false;
}

// Between two listed motions. Where one contact's normal passes through another contact, a motion may turn about the
// latter; its friction, and with it the speed, may then be anything in a range. The ends of the range are listed.
bool lists_ends_about(const Asked& asked, const Twist3& twist) {
  for (const Motion& from : asked.motions) {
    for (const Motion& to : asked.motions) {
      const Twist3 span = twist_of(to) - twist_of(from), into = twist - twist_of(from);
      const double share = into.dot(span) / span.squaredNorm();
      if (share > 0 && share < 1 && (into - share * span).norm() < 1e-6) return true;
    }
  }
  return false;
}

struct Tally {
  int cases = 0, solutions = 0, unlisted = 0, in_ranges = 0, unlawful = 0, several = 0, rays = 0;
};

void check_case(const LcpCase& lcp, Random& random, Tally& tally, bool all_bases) {
  const Asked asked = ask(lcp);
  ++tally.cases;
  tally.several += asked.motions.size() > 1;
  for (const Motion& motion : asked.motions) {
    const double off = violation(lcp, twist_of(motion), 1e-7);
    if (off > 1e-6) ++tally.unlawful;
  }
  std::vector<Twist3> twists;
  if (all_bases) twists = twists_by_bases(lcp);
  for (int i = 0; i < 4; ++i) {
    Eigen::VectorXd cover(4 * static_cast<Eigen::Index>(lcp.contacts.size()));
    for (double& entry : cover) entry = uniform(random, 0.2, 1);
    if (const auto twist = twist_by_lemke(lcp, cover)) {
      twists.push_back(*twist);
    } else {
      ++tally.rays;
    }
  }
  for (const Twist3& twist : twists) {
    if (violation(lcp, twist, 1e-7) > 1e-6) continue;  // a pivot went wrong in floating point: no witness
    ++tally.solutions;
    if (lists(asked, twist)) continue;
    ++(lists_ends_about(asked, twist) ? tally.in_ranges : tally.unlisted);
  }
}

bool holds(const std::vector<ContactPoint>& contacts, const Eigen::Vector3d& load, double friction) {
  MotionLaw law = damped({load[0], load[1]}, 1, friction);
  law.load[2] = load[2];
  return equilibrium(contacts, law).has_value();
}

}  // namespace

TEST_CASE("every solution of the complementarity problem is among the listed motions: 9,000 random contacts") {
  Random random(20261101);
  for (const double friction : {0.0, 0.2, 0.6, 1.5}) {
    Tally tally;
    for (int i = 0; i < 1000; ++i) check_case(random_case(random, 1, friction), random, tally, true);
    for (int i = 0; i < 1000; ++i) check_case(random_case(random, 2, friction), random, tally, true);
    for (int i = 0; i < 250; ++i) check_case(random_case(random, 3, friction), random, tally, i < 25);
    CAPTURE(friction, tally.cases, tally.solutions, tally.in_ranges, tally.several, tally.rays);
    CHECK(tally.unlisted + tally.in_ranges == 0);
    CHECK(tally.unlawful == 0);
    CHECK(tally.solutions > 4 * tally.cases);
    if (friction > 1) CHECK(tally.several > 20);  // ambiguous cases did occur
  }
}

TEST_CASE(
    "flush edges, double contacts and opposite walls: solutions or the ends of their range are listed, 4,000 cases") {
  Random random(20261102);
  for (const double friction : {0.0, 0.3, 1.0, 2.0}) {
    Tally tally;
    for (int i = 0; i < 500; ++i) check_case(aligned_case(random, 2, friction), random, tally, true);
    for (int i = 0; i < 500; ++i) check_case(aligned_case(random, 3, friction), random, tally, false);
    CAPTURE(friction, tally.cases, tally.solutions, tally.in_ranges, tally.several, tally.rays);
    CHECK(tally.unlisted == 0);
    CHECK(tally.unlawful == 0);
    CHECK(tally.solutions > tally.cases);
  }
}

TEST_CASE("a block on an incline sticks up to the angle of friction, and then slides") {
  // Two corners on the incline, the centre of mass 1 above it; seen along the incline.
  const std::vector<ContactPoint> contacts{{{0, 1}, {-2, -1}}, {{0, 1}, {2, -1}}};
  for (const double friction : {0.1, 0.3, 0.8}) {
    for (const double off : {-1e-3, 1e-3}) {
      const double slope = std::atan(friction) + off;
      const MotionLaw law = damped({std::sin(slope), -std::cos(slope)}, 1, friction);
      const std::vector<Motion> motions = consistent_motions(contacts, law);
      REQUIRE(motions.size() == 1);
      CHECK(motions[0].at_rest() == (off < 0));
      if (off < 0) continue;
      // Down the incline by what friction leaves, without turning.
      CHECK(motions[0].twist.linear.x() == Approx(std::sin(slope) - friction * std::cos(slope)).margin(1e-12));
      CHECK(motions[0].twist.linear.y() == Approx(0).margin(1e-12));
      CHECK(motions[0].twist.angular == Approx(0).margin(1e-12));
    }
  }
}

TEST_CASE("a tall block on an incline topples about its lower corner when its weight passes outside of it") {
  const double friction = 1.2, slope = 0.6;  // would stick, but tan 0.6 exceeds half the base over the height, 1 / 2
  const std::vector<ContactPoint> contacts{{{0, 1}, {-1, -2}}, {{0, 1}, {1, -2}}};
  const std::vector<Motion> motions =
      consistent_motions(contacts, damped({std::sin(slope), -std::cos(slope)}, 1, friction));
  REQUIRE(motions.size() == 1);
  CHECK_FALSE(motions[0].at_rest());
  CHECK(motions[0].twist.angular < 0);
  CHECK(separation_speed(contacts[1], motions[0].twist) == Approx(0).margin(1e-12));
  CHECK(sliding_speed(contacts[1], motions[0].twist) == Approx(0).margin(1e-12));
  // About the corner, (D F)-torque over the inertia about it: (r x F) / (gyration^2 + r^2).
  const double torque = cross(Point(-1, 2), Point(std::sin(slope), -std::cos(slope)));
  CHECK(motions[0].twist.angular == Approx(torque / (1 + 5)));
}

TEST_CASE("a ladder on floor and wall stands iff its angle is at least 90 degrees less twice the angle of friction") {
  Random random(20261103);
  int standing = 0;
  for (int i = 0; i < 4000; ++i) {
    const double friction = uniform(random, 0.05, 1), angle = uniform(random, 0.02, kPi / 2 - 0.02);
    const double limit = kPi / 2 - 2 * std::atan(friction);
    if (std::abs(angle - limit) < 1e-6) continue;
    // Of length 2: the foot on the floor to the right, the head on the wall to the left.
    const Point half(std::cos(angle), -std::sin(angle));
    const bool stands = holds({{{0, 1}, half}, {{1, 0}, -half}}, {0, -1, 0}, friction);
    REQUIRE(stands == (angle > limit));
    standing += stands;
  }
  CHECK(standing > 1000);
  CHECK(standing < 3000);
}

TEST_CASE("a peg with one sticking contact pivots about it") {
  // Pushed down onto its corner, the contact to the left of the centre of mass; friction enough to hold the corner.
  const std::vector<ContactPoint> contacts{{{0, 1}, {-1, -1}}};
  const std::vector<Motion> motions = consistent_motions(contacts, damped({0, -1}, 1, 0.9));
  REQUIRE(motions.size() == 1);
  const Twist& twist = motions[0].twist;
  CHECK((twist.linear + twist.angular * turned_left(contacts[0].lever)).norm() == Approx(0).margin(1e-12));
  CHECK(twist.angular == Approx(-1.0 / 3));  // moment 1 about the corner, over gyration^2 + r^2 = 1 + 2
}

// A peg of half-width r, its tip's centre the origin, y out of the hole: it touches the hole's right wall with its tip
// and the mouth's left corner at depth l. Loads are (Fx, -1, M) at the tip, lambda = l / (2 r f) (Whitney 1982).
std::vector<ContactPoint> leaning_peg(double r, double depth) { return {{{-1, 0}, {r, 0}}, {{1, 0}, {-r, depth}}}; }

TEST_CASE("vertices and sides of the jamming parallelogram of a peg in a hole are where equilibrium begins") {
  Random random(20261104);
  for (int i = 0; i < 1000; ++i) {
    const double r = uniform(random, 0.5, 2), friction = uniform(random, 0.1, 0.9);
    const double lambda = uniform(random, 1.05, 4), depth = 2 * r * friction * lambda;
    const std::vector<ContactPoint> contacts = leaning_peg(r, depth);
    const Point tip_alone(1 / friction, -r), mouth_alone(-1 / friction, (2 * lambda + 1) * r);  // (Fx, M)
    CHECK(holds(contacts, {tip_alone.x(), -1, tip_alone.y()}, friction));
    CHECK(holds(contacts, {mouth_alone.x(), -1, mouth_alone.y()}, friction));
    const double s = uniform(random, 0.05, 0.95);
    const Point side = s * tip_alone + (1 - s) * mouth_alone;
    CHECK(side.y() / r + friction * (1 + lambda) * side.x() == Approx(lambda));  // two-point sliding
    CHECK(holds(contacts, {side.x(), -1, side.y() + 1e-4 * r}, friction));
    CHECK_FALSE(holds(contacts, {side.x(), -1, side.y() - 1e-4 * r}, friction));
    CHECK_FALSE(holds(contacts, {0, -1, 0}, friction));  // pushed straight in: it goes in
  }
}

TEST_CASE("a peg wedges, whatever the load, iff the depth between its contacts is below 2 r f") {
  Random random(20261105);
  for (int i = 0; i < 1000; ++i) {
    const double r = uniform(random, 0.5, 2), friction = uniform(random, 0.1, 0.9);
    const Eigen::Vector3d load(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
    CHECK(holds(leaning_peg(r, 0.98 * 2 * r * friction), load, friction));
    // One of a load and its opposite is free.
    const std::vector<ContactPoint> deeper = leaning_peg(r, 1.02 * 2 * r * friction);
    CHECK_FALSE((holds(deeper, load, friction) && holds(deeper, -load, friction)));
  }
}
