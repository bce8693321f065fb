// Depths that cannot be exceeded, against closed forms and against walks that really get somewhere.
#include "analysis/insertion/exclusion.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "analysis/contact/clearance.hpp"
#include "analysis/insertion/exclusion_scenes.hpp"
#include "witness/random_shapes.hpp"

using namespace formotion;
using namespace formotion::testing;

namespace {

const StartBox kStarts{-0.5, 0.5, 0, 0, -0.02, 0.02};

double depth_of(const InsertionTask& task, const Configuration& q) {
  return task.approach.direction.dot(q.position() - task.drawn.position());
}

// The energy condition for one start at the drawn pose, carrier at the place that allows most.
bool has_energy(const InsertionTask& task, const Configuration& q) {
  const Point r = q.position() - task.drawn.position(), off = r - task.approach.distance_mm * task.approach.direction;
  const Stiffness& k = task.stiffness;
  const double turn = q.theta_rad - task.drawn.theta_rad, s = task.approach.distance_mm;
  const Point a = task.approach.direction;
  return k.kx_n_per_mm * off.x() * off.x() + k.ky_n_per_mm * off.y() * off.y() + k.ktheta_nmm_per_rad * turn * turn <=
         s * s * (k.kx_n_per_mm * a.x() * a.x() + k.ky_n_per_mm * a.y() * a.y());
}

// The deepest place of random walks from the drawn pose: small free steps, more of them down than up.
double deepest_walked(const InsertionTask& task, std::uint64_t seed, int steps) {
  witness::Random random(seed);
  double deepest = 0;
  Configuration q = task.drawn;
  for (int i = 0; i < steps; ++i) {
    if (i % 4000 == 0) q = task.drawn;
    const double size = std::pow(10, witness::uniform(random, -2.5, -0.3));
    const Point move = size * Point(witness::uniform(random, -1, 1), witness::uniform(random, -1, 1)) +
                       0.5 * size * task.approach.direction;
    const Configuration next{q.x_mm + move.x(), q.y_mm + move.y(),
                             q.theta_rad + 0.2 * size * witness::uniform(random, -1, 1)};
    if (!has_energy(task, next) || !is_free(task.space->part, task.space->obstacles, next)) continue;
    q = next;
    deepest = std::max(deepest, depth_of(task, q));
  }
  return deepest;
}

}  // namespace

TEST_CASE("a square peg of 10 gets into a hole of 9 only as deep as its turned corner") {
  const JointScene scene(square_peg(), {block_with_hole(9)}, 10);
  // Between the rims a corner, turned by t: the centre is 5 (sin t + cos t) - 9 sin t cos t above. The energy that
  // remains at this depth bounds t.
  double deepest = 0;
  for (double t = 0; t < 0.78; t += 1e-4) {
    const double depth = 5 - 5 * (std::sin(t) + std::cos(t)) + 9 * std::sin(t) * std::cos(t);
    if (20000 * t * t <= 10 * (2 * 10 * depth - depth * depth)) deepest = std::max(deepest, depth);
  }
  double last = 1e300;
  for (const double cell : {0.25, 0.125}) {
    const Exclusion found = deepest_reachable(scene.task, {}, 5, {cell, 2000000});
    REQUIRE(found.proved);
    CHECK(found.bound_mm >= deepest);
    CHECK(found.bound_mm <= deepest + 6 * cell);
    CHECK(found.bound_mm <= last);
    last = found.bound_mm;
  }
}

TEST_CASE("a stiff peg of 10 gets no deeper into a hole of 9 than a few cells") {
  JointScene scene(square_peg(), {block_with_hole(9)}, 10);
  scene.task.stiffness.ktheta_nmm_per_rad = 1e8;
  const Exclusion found = deepest_reachable(scene.task, {-0.5, 0.5, 0, 0, 0, 0}, 5);
  REQUIRE(found.proved);
  CHECK(found.bound_mm >= 0);
  CHECK(found.bound_mm <= 0.75);
}

TEST_CASE("nothing is proved of a peg of 10 over a hole of 10.2 or of 10") {
  for (const double width : {10.2, 10.0}) {
    const JointScene scene(square_peg(), {block_with_hole(width)}, 10);
    const Exclusion found = deepest_reachable(scene.task, kStarts, 5);
    CHECK_FALSE(found.proved);
    CHECK_FALSE(found.why.empty());
  }
}

TEST_CASE("a key fits one way only: mirrored it stays above the depth that the right way reaches") {
  const JointScene right(plate_with_stem(false), {block_with_pocket()}, 14);
  CHECK_FALSE(deepest_reachable(right.task, kStarts, 12).proved);
  const JointScene wrong(plate_with_stem(true), {block_with_pocket()}, 14);
  const Exclusion found = deepest_reachable(wrong.task, kStarts, 12);
  CHECK(found.proved);
  CHECK(found.bound_mm >= 10);  // moved aside by 6 the stem finds its hole
  CHECK(found.bound_mm <= 11.5);
  // Where the support lets it not move aside the stem stands in the pocket.
  JointScene stiff(plate_with_stem(true), {block_with_pocket()}, 14);
  stiff.task.stiffness = {100, 10, 200000};
  const Exclusion sooner = deepest_reachable(stiff.task, kStarts, 12);
  CHECK(sooner.proved);
  CHECK(sooner.bound_mm >= 4);
  CHECK(sooner.bound_mm <= 5);
}

TEST_CASE("no random walk gets deeper than the bound, and what walks reach is never excluded") {
  for (int i = 0; i < 6; ++i) {
    const double width = 8 + 0.3 * i;
    JointScene scene(square_peg(), {block_with_hole(width)}, 10, 0, 1);
    scene.task.stiffness.ktheta_nmm_per_rad = 500;
    const Exclusion found = deepest_reachable(scene.task, {}, 5);
    const double walked = deepest_walked(scene.task, 100 + i, 40000);
    CAPTURE(width, walked, found.bound_mm);
    CHECK(walked > 1);
    CHECK(found.proved);
    CHECK(walked <= found.bound_mm);
    CHECK(walked > found.bound_mm - 2);
  }
  const JointScene wide(square_peg(), {block_with_hole(11.5)}, 10);
  CHECK(deepest_walked(wide.task, 7, 40000) > 4);
  CHECK_FALSE(deepest_reachable(wide.task, {}, 4).proved);
}

TEST_CASE("turning the whole joint changes nothing where the support is alike in all directions") {
  const Exclusion upright = deepest_reachable(JointScene(square_peg(), {block_with_hole(8.5)}, 10).task, kStarts, 5);
  for (const double turned : {0.4, 1.5707963267948966, -2.2}) {
    JointScene scene(square_peg(), {block_with_hole(8.5)}, 10, turned);
    const Exclusion found = deepest_reachable(scene.task, kStarts, 5);
    CHECK(found.proved == upright.proved);
    CHECK(std::abs(found.bound_mm - upright.bound_mm) <= 0.25 + 1e-9);
    scene.task.stiffness.kx_n_per_mm = 5;  // axes are coupled now: less is known, never more than is true
    const Exclusion coupled = deepest_reachable(scene.task, kStarts, 5);
    if (coupled.proved) CHECK(coupled.bound_mm >= deepest_walked(scene.task, 5, 20000));
  }
}

TEST_CASE("a small largest force keeps a part from moving aside to the hole") {
  // The hole is 6 aside of the start.
  const Polygon block = placed(block_with_hole(11), 0, Point(6, 0));
  const JointScene scene(square_peg(), {block}, 12, 0, 4);
  CHECK_FALSE(deepest_reachable(scene.task, {}, 7).proved);
  JointScene weak(square_peg(), {block}, 12, 0, 4);
  weak.task.approach.max_force_n = 8;  // at depth 4 at most 2.5 aside: 5.5 are needed
  const Exclusion found = deepest_reachable(weak.task, {}, 7);
  CHECK(found.proved);
  CHECK(found.bound_mm >= 4);
  CHECK(found.bound_mm <= 5.5);
}

TEST_CASE("starts that are deep already and too many cells prove nothing, and starts in the block stay there") {
  const JointScene scene(square_peg(), {block_with_hole(9)}, 10);
  CHECK_FALSE(deepest_reachable(scene.task, {0, 0, -6, 0, 0, 0}, 5).proved);
  CHECK_FALSE(deepest_reachable(scene.task, kStarts, 5, {0.25, 100}).proved);
  const Exclusion inside = deepest_reachable(scene.task, {0, 0, -3, -2.5, 0, 0}, 5);
  CHECK(inside.proved);
  CHECK(inside.bound_mm >= 3);
  CHECK(deepest_reachable(scene.task, kStarts, 5).cells == deepest_reachable(scene.task, kStarts, 5).cells);
}
