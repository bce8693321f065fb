// Insertions on a damper against closed forms and against backward Euler steps that know no events and no modes.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "analysis/insertion/damped_insertion.hpp"
#include "analysis/insertion/exclusion.hpp"
#include "witness/insertion_scenes.hpp"

using namespace formotion;
using namespace formotion::witness;

namespace {

constexpr double kSpeed = 4;  // mm/s

bool is_decided(InsertionOutcome outcome) {
  return outcome != InsertionOutcome::Ambiguous && outcome != InsertionOutcome::Undecided;
}

double radians_of(double degrees) { return degrees * std::numbers::pi / 180; }

// The scene for the program and for the steps, with bx = by = b and btheta = b gyration^2.
SteppingScene damped_scene(SteppingScene scene, double b, double gyration) {
  scene.stiffness = {b, b, b * gyration * gyration};
  return scene;
}
SteppingScene stepped_scene(SteppingScene scene, double step_mm) {
  const double per_step = kSpeed / step_mm;
  scene.stiffness.kx_n_per_mm *= per_step;
  scene.stiffness.ky_n_per_mm *= per_step;
  scene.stiffness.ktheta_nmm_per_rad *= per_step;
  return scene;
}

Insertion insert_on_damper(const SteppingScene& scene, const Configuration& start,
                           const InsertionOptions& options = {}) {
  JointTask made(scene);
  made.task.damper_speed_mm_s = kSpeed;
  return insert(made.task, start, options);
}

SteppingOptions damped_steps() {
  SteppingOptions options;
  options.step_mm = 0.01;
  options.most_mm = 1;
  options.damped = true;
  return options;
}

SteppedInsertion step_on_damper(const SteppingScene& scene, const Configuration& start) {
  const SteppingOptions options = damped_steps();
  return step_insertion(stepped_scene(scene, options.step_mm), start, options);
}

// A slim part on a slope at angle a from the approach, 1 mm over it; its tip lies where the force of sliding passes
// through the compliance centre, so that the part does not turn. Goal: width_mm across.
SteppingScene straight_slide(double a, double friction, double b) {
  PointOnSlope joint;
  joint.slope_rad = a;
  joint.friction = friction;
  SteppingScene scene = scene_of(joint);
  const double steep = a + std::atan(friction);
  const Point f(std::cos(steep), std::sin(steep)), side = 1.5 * turned_left(f);
  scene.part.outer = {-30 * f, -20 * f - side, 5 * f, -20 * f + side};
  const double u = joint.width_mm;
  scene.drawn = {30 * f.x() - u, 30 * f.y() + 1, 0};  // the tip is at (-u, 1)
  scene.stiffness = {b, b, b * 15 * 15};
  scene.approach.distance_mm = 1000;
  scene.goal = {1 + u / std::tan(a), 100, 0.2};
  return scene;
}

// A slim part whose tip stands on a floor.
SteppingScene leaning(double friction) {
  SteppingScene scene;
  scene.part.outer = {Point(0, -30), Point(2, -20), Point(2, 10), Point(-2, 10), Point(-2, -20)};
  scene.fixed = {{{Point(-200, -10), Point(200, -10), Point(200, 0), Point(-200, 0)}, {}}};
  scene.friction = friction;
  scene.approach = {Point(0, -1), 100, std::nullopt};
  scene.goal = {1e3, 1e3, 1e3};
  return scene;
}

}  // namespace

TEST_CASE("A part on a damper that touches nothing goes as its carrier does and needs no force") {
  PegInHole joint;
  const SteppingScene scene = damped_scene(scene_of(joint), 3, 12);
  const Insertion end = insert_on_damper(scene, scene.drawn);
  CHECK(end.outcome == InsertionOutcome::Assembled);
  CHECK(end.travel_mm == Approx(scene.goal.depth_mm).margin(2e-6));
  CHECK(end.peak_axial_n == 0);
  CHECK(end.peak_lateral_n == 0);
  CHECK(end.work_nmm == 0);
  SteppingScene shorter = scene;
  shorter.approach.distance_mm = 10;
  const Insertion blocked = insert_on_damper(shorter, scene.drawn);
  CHECK(blocked.outcome == InsertionOutcome::Blocked);
  CHECK(blocked.travel_mm == Approx(10));
  CHECK(blocked.depth_mm == Approx(10));
}

// With a the slope's angle from the approach and no turning: the face takes sin a of the carrier's speed, so that
// N = b v0 sin a, and v = v0 cos(a + phi) / cos phi along the face (derived).
TEST_CASE("On a damper a chamfer is slid down with the speed and force of their closed forms") {
  for (const double degrees : {20.0, 45.0, 70.0}) {
    for (const double friction : {0.0, 0.2, 0.36}) {
      const double a = radians_of(degrees), phi = std::atan(friction), b = 2.5, width = 3;
      const SteppingScene scene = straight_slide(a, friction, b);
      const Insertion end = insert_on_damper(scene, scene.drawn);
      CAPTURE(degrees, friction, end.why);
      const double axial = b * kSpeed * std::sin(a) * std::sin(a + phi) / std::cos(phi);
      const double travel = width / std::sin(a) * std::cos(phi) / std::cos(a + phi);
      CHECK(end.outcome == InsertionOutcome::Assembled);
      CHECK(end.peak_axial_n == Approx(axial).epsilon(1e-6));
      CHECK(end.peak_lateral_n == Approx(b * kSpeed * std::sin(a) * std::cos(a + phi) / std::cos(phi)).epsilon(1e-6));
      CHECK(end.travel_mm == Approx(1 + travel).epsilon(1e-5));
      CHECK(end.work_nmm == Approx(axial * travel).epsilon(1e-5));
    }
  }
}

// The tip is straight below the centre: rest is a balance on one contact.
TEST_CASE("On a damper a chamfer jams from the complement of the friction angle on") {
  for (const double friction : {0.2, 0.5, 1.0}) {
    PointOnSlope joint;
    joint.friction = friction;
    const double steepest = std::numbers::pi / 2 - std::atan(friction);
    CHECK(insert_on_damper(straight_slide(steepest - 0.02, friction, 2),
                           straight_slide(steepest - 0.02, friction, 2).drawn)
              .outcome == InsertionOutcome::Assembled);
    joint.slope_rad = steepest + 0.01;
    SteppingScene scene = damped_scene(scene_of(joint), 2, 15);
    scene.approach.distance_mm = 2000;
    const Insertion end = insert_on_damper(scene, scene.drawn);
    CAPTURE(friction, end.why);
    CHECK(end.outcome == InsertionOutcome::Jammed);
    CHECK(end.depth_mm == Approx(1));
    CHECK(end.travel_mm == Approx(2000));
    CHECK(end.peak_axial_n == Approx(2 * kSpeed));
    CHECK(end.work_nmm == Approx(2 * kSpeed * 1999));
    REQUIRE(end.contacts.size() == 1);
    CHECK(end.contacts[0].force.normal == Approx(2 * kSpeed * std::sin(joint.slope_rad)));
  }
}

// A pivot at distance r turns by dtheta / dt = v0 r sin(theta) / (r^2 + gyration^2), theta from the approach: the time
// is (r^2 + gyration^2) / (v0 r) times the change of ln tan(theta / 2) (derived).
TEST_CASE("On a damper a part that pivots takes the time of its closed form and never falls past the force") {
  const double r = 30, g = 17, from = 0.2, to = 0.7, b = 2;
  SteppingScene scene = damped_scene(leaning(8), b, g);
  scene.drawn = {0, r * std::cos(from), from};
  scene.goal.depth_mm = r * (std::cos(from) - std::cos(to));
  scene.goal.tilt_rad = 3;
  const Insertion end = insert_on_damper(scene, scene.drawn);
  CHECK(end.outcome == InsertionOutcome::Assembled);
  CHECK(std::abs(end.tilt_rad) == Approx(to - from).epsilon(1e-5));
  const double travel = (r * r + g * g) / r * std::log(std::tan(to / 2) / std::tan(from / 2));
  CHECK(end.travel_mm == Approx(travel).epsilon(1e-4));
  // The carrier's speed less the part's along the approach.
  const auto axial = [&](double theta) {
    return b * kSpeed * (1 - std::pow(r * std::sin(theta), 2) / (r * r + g * g));
  };
  CHECK(end.peak_axial_n == Approx(axial(from)).epsilon(1e-4));
  double work = 0;  // axial / speed d theta over its rate
  for (int i = 0; i < 20000; ++i) {
    const double theta = from + (i + 0.5) / 20000 * (to - from);
    work += axial(theta) * (r * r + g * g) / (r * std::sin(theta)) * (to - from) / 20000;
  }
  CHECK(end.work_nmm == Approx(work).epsilon(1e-4));
}

TEST_CASE("On a damper the largest force ends the run where it is reached and not before") {
  const double b = 2, a = 0.8, friction = 0.2, phi = std::atan(friction);
  const double axial = b * kSpeed * std::sin(a) * std::sin(a + phi) / std::cos(phi);
  SteppingScene scene = straight_slide(a, friction, b);
  scene.approach.max_force_n = axial * 1.001;
  CHECK(insert_on_damper(scene, scene.drawn).outcome == InsertionOutcome::Assembled);
  scene.approach.max_force_n = axial * 0.999;
  const Insertion end = insert_on_damper(scene, scene.drawn);
  CHECK(end.outcome == InsertionOutcome::Blocked);
  CHECK(end.travel_mm == Approx(1));
  CHECK(end.depth_mm == Approx(1));
}

TEST_CASE("A damper of different bx and by is left undecided in words") {
  SteppingScene scene = damped_scene(scene_of(PegInHole{}), 2, 10);
  scene.stiffness.ky_n_per_mm = 3;
  const Insertion end = insert_on_damper(scene, scene.drawn);
  CHECK(end.outcome == InsertionOutcome::Undecided);
  CHECK(end.why == "the damper's bx and by differ");
}

TEST_CASE("Random joints on a damper end as backward Euler steps do") {
  Random random(11);
  int decided = 0, compared = 0, beside = 0, seated = 0;
  for (int i = 0; i < 40; ++i) {
    SteppingScene scene = random_joint(random);
    const double gyration = uniform(random, 8, 40);
    scene = damped_scene(scene, 5, gyration);
    const double x = uniform(random, -3, 3), theta = uniform(random, -0.04, 0.04);
    const Configuration start = start_with_errors(JointTask(scene).task, x, 0, theta);
    const Insertion inserted = insert_on_damper(scene, start);
    if (!is_decided(inserted.outcome)) continue;
    ++decided;
    const SteppedInsertion stepped = step_on_damper(scene, start);
    if (!is_decided(stepped.outcome)) continue;
    CAPTURE(i, name(inserted.outcome), name(stepped.outcome), inserted.depth_mm, stepped.depth_mm, inserted.why);
    // Where two ways are consistent and end alike the steps go either.
    const bool branches = inserted.deepest_mm > inserted.depth_mm + 0.05;
    const bool same =
        branches ? std::min(std::abs(inserted.depth_mm - stepped.depth_mm),
                            std::abs(inserted.deepest_mm - stepped.depth_mm)) < 0.05
                 : inserted.outcome == stepped.outcome && std::abs(inserted.depth_mm - stepped.depth_mm) < 0.05;
    if (!same) {  // a boundary is near if either changes a little to a side
      bool changes = false;
      for (const double aside : {-0.02, 0.02}) {
        Configuration moved = start;
        moved.x_mm += aside;
        changes = changes || insert_on_damper(scene, moved).outcome != inserted.outcome ||
                  step_on_damper(scene, moved).outcome != stepped.outcome;
      }
      if (changes) {
        ++beside;
        continue;
      }
    }
    ++compared;
    CHECK(same);
    if (!same || branches) continue;
    seated += inserted.outcome == InsertionOutcome::Assembled;
    CHECK(stepped.peak_axial_n == Approx(inserted.peak_axial_n).epsilon(0.02).margin(0.05));
    CHECK(stepped.work_nmm == Approx(inserted.work_nmm).epsilon(0.02).margin(1));
  }
  CAPTURE(decided, compared, beside, seated);
  CHECK(decided >= 35);
  CHECK(compared >= 33);
  CHECK(seated >= 8);
}

// r' B r <= S a' B r, from v' B v <= v' B v0.
TEST_CASE("No way on a damper leaves the tube of half its carrier's way") {
  Random random(5);
  int seen = 0;
  for (int i = 0; i < 40; ++i) {
    const double g = uniform(random, 5, 40);
    const SteppingScene scene = damped_scene(random_joint(random), 5, g);
    const Configuration start =
        start_with_errors(JointTask(scene).task, uniform(random, -3, 3), 0, uniform(random, -0.04, 0.04));
    InsertionOptions options;
    options.keep_path = true;
    double before = -1e300;
    for (const InsertionMoment& moment : insert_on_damper(scene, start, options).path) {
      const Point r = moment.q.position() - start.position();
      const double turn = moment.q.theta_rad - start.theta_rad;
      const double along = scene.approach.direction.dot(r);
      CHECK(r.squaredNorm() + g * g * turn * turn <= moment.travel_mm * along + 1e-4);
      CHECK(moment.depth_mm >= before - 1e-6);  // the contact slack
      before = moment.depth_mm;
      ++seen;
    }
  }
  CHECK(seen > 200);
}

TEST_CASE("On a damper a peg reaches no depth that is proved to be out of reach") {
  PegInHole joint;
  joint.hole_half_mm = 9.8;
  joint.hole_chamfer_mm = 0;
  joint.above_mm = 3;
  const SteppingScene scene = damped_scene(scene_of(joint), 5, 20);
  JointTask made(scene);
  made.task.damper_speed_mm_s = kSpeed;
  made.task.approach.distance_mm = 12;
  made.task.goal = {7, 1e9, 1e9};
  const StartBox box{-0.5, 0.5, 0, 0, -0.02, 0.02};
  const Exclusion proof = deepest_reachable(made.task, box, 7, {0.125, 2000000});
  REQUIRE(proof.proved);
  double deepest = 0;
  for (int i = 0; i < 5; ++i) {
    for (int k = 0; k < 5; ++k) {
      const Configuration start = start_with_errors(made.task, -0.5 + 0.25 * i, 0, -0.02 + 0.01 * k);
      deepest = std::max(deepest, insert(made.task, start).deepest_mm);
    }
  }
  CHECK(deepest > 2.9);
  CHECK(deepest <= proof.bound_mm);
}
