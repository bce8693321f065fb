// insert() against a simulation by small steps that knows no events and no modes; and that simulation against what is
// known in closed form.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "witness/insertion_scenes.hpp"

using namespace formotion;
using namespace formotion::witness;

namespace {

bool is_decided(InsertionOutcome outcome) {
  return outcome != InsertionOutcome::Ambiguous && outcome != InsertionOutcome::Undecided;
}

// Whether the outcome of either is another one a little to a side.
bool is_near_boundary(const SteppingScene& scene, const InsertionTask& task, const Configuration& start) {
  const InsertionOutcome stepped = step_insertion(scene, start).outcome, inserted = insert(task, start).outcome;
  for (const double aside : {-0.02, 0.02}) {
    Configuration moved = start;
    moved.x_mm += aside;
    if (step_insertion(scene, moved).outcome != stepped || insert(task, moved).outcome != inserted) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("Steps down a chamfer need the force and the work of their closed forms") {
  for (const double degrees : {30.0, 45.0, 60.0}) {
    PointOnSlope joint;
    joint.slope_rad = degrees * std::numbers::pi / 180;
    const SteppedInsertion stepped = step_insertion(scene_of(joint), scene_of(joint).drawn);
    const double u = joint.width_mm, rise = std::tan(joint.slope_rad + std::atan(joint.friction));
    CHECK(stepped.outcome == InsertionOutcome::Assembled);
    CHECK(stepped.peak_axial_n == Approx(joint.stiffness.kx_n_per_mm * u * rise).epsilon(0.02));
    CHECK(stepped.work_nmm ==
          Approx(joint.stiffness.kx_n_per_mm * u * u / 2 * rise / std::tan(joint.slope_rad)).epsilon(0.03));
  }
}

TEST_CASE("Random joints end as the simulation by steps does") {
  Random random(7);
  int compared = 0, decided = 0;
  for (int i = 0; i < 120; ++i) {
    const SteppingScene scene = random_joint(random);
    const JointTask made(scene);
    const double x = uniform(random, -3, 3), theta = uniform(random, -0.04, 0.04);
    const Configuration start = start_with_errors(made.task, x, 0, theta);
    const Insertion inserted = insert(made.task, start);
    const SteppedInsertion stepped = step_insertion(scene, start);
    CHECK(stepped.overlap_mm2 < 1e-3);
    if (!is_decided(inserted.outcome)) continue;
    ++decided;
    if (!is_decided(stepped.outcome)) continue;
    CAPTURE(i, name(inserted.outcome), name(stepped.outcome), inserted.depth_mm, stepped.depth_mm, inserted.why);
    const bool same = inserted.outcome == stepped.outcome && std::abs(inserted.depth_mm - stepped.depth_mm) < 0.05;
    if (!same && is_near_boundary(scene, made.task, start)) continue;
    ++compared;
    CHECK(same);
    if (!same) continue;
    // A peak that falls at once is found to within a step of the carrier.
    const double step_n = SteppingOptions{}.step_mm * scene.stiffness.ky_n_per_mm;
    CHECK(stepped.peak_axial_n == Approx(inserted.peak_axial_n).epsilon(0.01).margin(step_n));
    CHECK(stepped.work_nmm == Approx(inserted.work_nmm).epsilon(0.01).margin(1));
  }
  CHECK(decided >= 90);
  CHECK(compared >= 85);
}
