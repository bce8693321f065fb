// insert() against what is known in closed form of chamfers and of pegs in holes (Whitney 1982), and against the laws
// that every instant must keep.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "analysis/contact/clearance.hpp"
#include "witness/insertion_scenes.hpp"

using namespace formotion;
using namespace formotion::witness;

namespace {

constexpr double kDegree = std::numbers::pi / 180;

Insertion with_path(const InsertionTask& task, const Configuration& start) {
  return insert(task, start, {.keep_path = true});
}

Insertion down_the_slope(const PointOnSlope& joint) {
  const SteppingScene scene = scene_of(joint);
  const JointTask made(scene);
  return with_path(made.task, scene.drawn);
}

// Of the carrier, down a straight slope of width u: the integral of K U tan(slope + phi) over the depth, and what the
// support along the approach holds at the end.
double slope_work(const PointOnSlope& joint) {
  const double u = joint.width_mm, rise = std::tan(joint.slope_rad + std::atan(joint.friction));
  const double force = joint.stiffness.kx_n_per_mm * u * rise;
  return force * u / 2 / std::tan(joint.slope_rad) + force * force / 2 / joint.stiffness.ky_n_per_mm;
}

// In a snap the carrier's real force is not in balance with the contacts.
bool snaps(const InsertionMoment& moment) { return moment.is_snap; }

}  // namespace

TEST_CASE("A chamfer pushes back with the lateral force times the tangent of its angle and that of friction") {
  for (const double degrees : {20.0, 45.0, 70.0}) {
    PointOnSlope joint;
    joint.slope_rad = degrees * kDegree;
    const Insertion insertion = down_the_slope(joint);
    REQUIRE(insertion.outcome == InsertionOutcome::Assembled);
    int sliding = 0;
    for (const InsertionMoment& moment : insertion.path) {
      if (moment.contacts.empty()) continue;
      const double aside = moment.q.x_mm + joint.width_mm;  // U
      const double lateral = joint.stiffness.kx_n_per_mm * aside;
      CHECK(moment.axial_n == Approx(lateral * std::tan(joint.slope_rad + std::atan(joint.friction))).margin(1e-4));
      sliding += aside > 0.1;
    }
    CHECK(sliding > 0);
  }
}

TEST_CASE("A support that also tilts deflects a tip as two springs in a row") {
  PointOnSlope joint;
  joint.stiffness = {10, 1e6, 1e6};
  joint.width_mm = 0.5;
  const double soft =
      1 / (1 / joint.stiffness.kx_n_per_mm + joint.centre_mm * joint.centre_mm / joint.stiffness.ktheta_nmm_per_rad);
  const SteppingScene scene = scene_of(joint);
  const JointTask made(scene);
  const Insertion insertion = with_path(made.task, scene.drawn);
  REQUIRE(insertion.outcome == InsertionOutcome::Assembled);
  const InsertionMoment& end = insertion.path.back();
  const Point tip = end.q.position() + rotated(Point(0, -joint.centre_mm), end.q.theta_rad);
  const double deflection = tip.x() + joint.width_mm;
  REQUIRE(deflection > 0.4);
  CHECK(std::abs(end.lateral_n) == Approx(soft * deflection).epsilon(2e-3));
  CHECK(end.axial_n == Approx(soft * deflection * std::tan(joint.slope_rad + std::atan(joint.friction))).epsilon(2e-3));
}

TEST_CASE("A chamfer jams where its angle and that of friction make a right angle or more") {
  for (const double friction : {0.1, 0.3, 0.6, 1.0}) {
    for (const double beyond : {-8.0, -1.0, 1.0, 8.0}) {
      PointOnSlope joint;
      joint.friction = friction;
      joint.stiffness = {10, 100, 1e9};
      joint.slope_rad = std::numbers::pi / 2 - std::atan(friction) + beyond * kDegree;
      if (joint.slope_rad > 88 * kDegree) continue;
      SteppingScene scene = scene_of(joint);
      // Near the right angle the spring gives way for long before the tip has slid down.
      scene.approach.distance_mm = 1000;
      const JointTask made(scene);
      const InsertionOutcome expected = beyond < 0 ? InsertionOutcome::Assembled : InsertionOutcome::Jammed;
      CAPTURE(friction, beyond);
      CHECK(insert(made.task, scene.drawn).outcome == expected);
    }
  }
}

TEST_CASE("The work down a straight chamfer is that of its closed form and least at 45 degrees less half of friction") {
  for (const double friction : {0.1, 0.343, 0.7}) {
    PointOnSlope joint;
    joint.friction = friction;
    double least = 1e300, at = 0;
    const double best = std::atan(std::hypot(1, friction) - friction);
    CHECK(best == Approx(45 * kDegree - std::atan(friction) / 2));
    for (int i = -6; i <= 6; ++i) {
      joint.slope_rad = best + i * kDegree;
      const double work = down_the_slope(joint).work_nmm;
      CHECK(work == Approx(slope_work(joint)).epsilon(1e-4));
      if (work < least) {
        least = work;
        at = joint.slope_rad;
      }
    }
    CHECK(at == Approx(best).margin(0.5 * kDegree));
  }
}

// One contact at the mouth, at depth l along the peg: with C = Kx (Lg - l - mu r), e the peg's offset there,
// U = e Kt / (C (Lg - l) + Kt), theta = C e / (C (Lg - l) + Kt).
TEST_CASE("A peg in one-point contact stands where Whitney's equations put it") {
  for (const double centre : {20.0, 30.0, 45.0}) {
    PegInHole joint;
    joint.hole_chamfer_mm = 1;
    joint.centre_mm = centre;
    joint.stiffness = {5, 1000, 50000};
    joint.hole_half_mm = 10.05;
    const SteppingScene scene = scene_of(joint);
    const JointTask made(scene);
    const double error = 0.25;
    const Insertion insertion = with_path(made.task, start_with_errors(made.task, -error, 0, 0));
    int seen = 0;
    for (const InsertionMoment& moment : insertion.path) {
      if (moment.contacts.size() != 1 || snaps(moment)) continue;
      const CarriedContact& contact = moment.contacts.front();
      const bool at_mouth = contact.pair.kind == ContactKind::EdgeOnCorner && contact.point.y() < -0.5;
      if (!at_mouth || contact.mode == ContactMode::Stick) continue;
      const Point on_peg = rotated(contact.point - moment.q.position(), -moment.q.theta_rad);
      if (on_peg.y() > joint.peg_length_mm - centre - 1 || on_peg.y() < -centre + 0.01) continue;
      const double offset = error - (joint.hole_half_mm - joint.peg_half_mm);
      const double above = -on_peg.y();  // Lg - l
      const double c = joint.stiffness.kx_n_per_mm * (above - joint.friction * joint.peg_half_mm);
      const double kt = joint.stiffness.ktheta_nmm_per_rad, divisor = c * above + kt;
      CHECK(moment.q.x_mm + error == Approx(offset * kt / divisor).epsilon(0.01));
      CHECK(moment.q.theta_rad == Approx(c * offset / divisor).epsilon(0.01).margin(1e-6));
      ++seen;
    }
    CAPTURE(centre, insertion.path.size());
    CHECK(seen > 0);
  }
}

// M / (r Fz) + mu (1 + lambda) Fx / Fz = +-lambda with lambda = l / (2 r mu), M of the support about the middle of the
// tip, Fz inwards; the sign is that of the side that the tip touches. Small tilts: to within some tilts.
TEST_CASE("A peg that slides on two contacts stands on the edge of the jamming parallelogram") {
  Random random(3);
  int seen = 0;
  for (int i = 0; i < 150; ++i) {
    PegInHole joint;
    joint.hole_half_mm = 10 + uniform(random, 0.02, 0.1);
    joint.friction = uniform(random, 0.05, 0.3);
    joint.centre_mm = uniform(random, 0, 40);
    joint.stiffness = {uniform(random, 2, 20), 200, uniform(random, 5e3, 5e4)};
    const SteppingScene scene = scene_of(joint);
    const JointTask made(scene);
    const Insertion insertion =
        with_path(made.task, start_with_errors(made.task, uniform(random, -2, 2), 0, uniform(random, -0.02, 0.02)));
    for (const InsertionMoment& moment : insertion.path) {
      if (moment.contacts.size() != 2 || snaps(moment)) continue;
      const bool first = moment.contacts[0].pair.kind == ContactKind::CornerOnEdge;
      const CarriedContact &tip = moment.contacts[first ? 0 : 1], &mouth = moment.contacts[first ? 1 : 0];
      if (tip.pair.kind != ContactKind::CornerOnEdge || mouth.pair.kind != ContactKind::EdgeOnCorner) continue;
      if (tip.mode == ContactMode::Stick || mouth.mode == ContactMode::Stick) continue;
      if (std::abs(tip.normal.y()) > 1e-9 || tip.normal.dot(mouth.normal) > -0.9) continue;
      if (std::abs(moment.q.theta_rad) > 0.02 || moment.axial_n < 1) continue;
      const double r = joint.peg_half_mm, mu = joint.friction;
      const Point between = rotated(mouth.point - tip.point, -moment.q.theta_rad);
      const double lambda = between.y() / (2 * r * mu);
      // From the compliance centre to the middle of the tip.
      const Point arm = rotated(Point(0, joint.centre_mm), moment.q.theta_rad);
      const double at_tip = moment.moment_nmm + cross(arm, Point(moment.lateral_n, -moment.axial_n));
      const double sign = tip.normal.x() < 0 ? 1 : -1;
      const double stands = at_tip / (r * moment.axial_n) + mu * (1 + lambda) * moment.lateral_n / moment.axial_n;
      // The tilt turns the mouth's normal, and with it a share of tilt / mu of the friction.
      const double ratio = std::abs(moment.lateral_n / moment.axial_n);
      const double slack = std::abs(moment.q.theta_rad) / mu * (1 + lambda) * (1 + mu * mu * ratio * ratio) + 1e-6;
      if (slack > 0.2 * lambda) continue;
      CAPTURE(i, lambda, moment.q.theta_rad, ratio);
      CHECK(stands == Approx(sign * lambda).margin(slack));
      CHECK(ratio <= 1 / mu + slack / mu);
      ++seen;
    }
  }
  CHECK(seen >= 20);
}

TEST_CASE("Where a peg wedges the line between two of its contacts is in both friction cones") {
  Random random(9);
  int wedged = 0;
  for (int i = 0; i < 1200; ++i) {
    PegInHole joint;
    joint.friction = uniform(random, 0.3, 0.8);
    joint.hole_chamfer_mm = joint.peg_chamfer_mm = 1;
    joint.hole_half_mm = 10 + uniform(random, 0.1, 0.8);
    joint.centre_mm = uniform(random, 20, 58);
    joint.stiffness = {uniform(random, 5, 50), 200, uniform(random, 2e5, 1e6)};
    const SteppingScene scene = scene_of(joint);
    const JointTask made(scene);
    const double x = uniform(random, -1, 1), theta = uniform(random, 0.03, 0.12);
    const Insertion insertion = insert(made.task, start_with_errors(made.task, x, 0, theta));
    if (insertion.outcome != InsertionOutcome::Wedged) continue;
    ++wedged;
    double apart = 1e300;  // along the peg, of the two opposite contacts that are most level
    for (const CarriedContact& a : insertion.contacts) {
      for (const CarriedContact& b : insertion.contacts) {
        const Point between = rotated(b.point - a.point, -insertion.tilt_rad);
        if (std::abs(between.x()) > joint.peg_half_mm) apart = std::min(apart, std::abs(between.y()));
      }
    }
    CAPTURE(i, insertion.depth_mm, insertion.contacts.size());
    CHECK(apart <= joint.friction * 2 * joint.hole_half_mm);
  }
  CHECK(wedged > 0);
}

TEST_CASE("Forces balance and Coulomb's law holds at every instant of random insertions") {
  Random random(11);
  int carrying = 0;
  for (int i = 0; i < 60; ++i) {
    const SteppingScene scene = random_joint(random);
    const JointTask made(scene);
    const double x = uniform(random, -3, 3), theta = uniform(random, -0.04, 0.04);
    const Configuration start = start_with_errors(made.task, x, 0, theta);
    for (const InsertionMoment& moment : with_path(made.task, start).path) {
      CHECK(clearance_mm(made.part, made.obstacles, moment.q) >= -1e-6);
      if (snaps(moment)) continue;
      Eigen::Vector3d sum(moment.lateral_n, -moment.axial_n, moment.moment_nmm);
      double size = 1;
      for (const CarriedContact& contact : moment.contacts) {
        const double limit = scene.friction * contact.force.normal;
        CHECK(contact.force.normal >= -1e-6);
        CHECK(std::abs(contact.force.tangential) <= limit + 1e-6 * (1 + limit));
        // Left: the material moves to the left of the normal, friction to its right.
        if (contact.mode == ContactMode::SlideLeft) {
          CHECK(contact.force.tangential == Approx(-limit).margin(1e-6).epsilon(1e-9));
        } else if (contact.mode == ContactMode::SlideRight) {
          CHECK(contact.force.tangential == Approx(limit).margin(1e-6).epsilon(1e-9));
        }
        const Point force =
            contact.force.normal * contact.normal + contact.force.tangential * turned_left(contact.normal);
        sum += Eigen::Vector3d(force.x(), force.y(), cross(contact.point - moment.q.position(), force));
        size += contact.force.normal * 30;
        ++carrying;
      }
      CAPTURE(i, moment.event, moment.travel_mm, sum.norm());
      CHECK(sum.norm() <= 1e-6 * size);
    }
  }
  CHECK(carrying > 200);
}

TEST_CASE("A mirrored and a turned world have the same insertion") {
  Random random(5);
  for (int i = 0; i < 20; ++i) {
    SteppingScene scene = random_joint(random);
    scene.stiffness.ky_n_per_mm = scene.stiffness.kx_n_per_mm;
    const double x = uniform(random, -2, 2), theta = uniform(random, -0.03, 0.03), turn = uniform(random, 0.2, 3);
    SteppingScene mirror = scene, turned = scene;
    mirror.part = mirrored_x(scene.part);
    turned.part = placed(scene.part, turn, Point(0, 0));
    for (Polygon& polygon : mirror.fixed) polygon = mirrored_x(polygon);
    for (Polygon& polygon : turned.fixed) polygon = placed(polygon, turn, Point(0, 0));
    turned.approach.direction = rotated(scene.approach.direction, turn);
    const Point drawn = rotated(scene.drawn.position(), turn);
    turned.drawn = {drawn.x(), drawn.y(), 0};
    const JointTask a(scene), b(mirror), c(turned);
    const Insertion as_is = insert(a.task, start_with_errors(a.task, x, 0, theta));
    const Insertion in_mirror = insert(b.task, start_with_errors(b.task, -x, 0, -theta));
    const Insertion in_turn = insert(c.task, start_with_errors(c.task, x, 0, theta));
    CAPTURE(i);
    CHECK(in_mirror.outcome == as_is.outcome);
    CHECK(in_turn.outcome == as_is.outcome);
    CHECK(in_mirror.depth_mm == Approx(as_is.depth_mm).margin(1e-4));
    CHECK(in_mirror.tilt_rad == Approx(-as_is.tilt_rad).margin(1e-5));
    CHECK(in_turn.depth_mm == Approx(as_is.depth_mm).margin(1e-4));
    CHECK(in_turn.lateral_mm == Approx(as_is.lateral_mm).margin(1e-4));
    CHECK(in_turn.work_nmm == Approx(as_is.work_nmm).epsilon(1e-4).margin(1e-3));
  }
}
