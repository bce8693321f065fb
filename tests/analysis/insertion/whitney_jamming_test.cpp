// A peg with two contacts against the parallelogram of loads outside which it jams (Whitney 1982).
#include <catch2/catch.hpp>
#include <cmath>

#include "analysis/insertion/ways_on.hpp"
#include "witness/insertion_scenes.hpp"

using namespace formotion;
using namespace formotion::witness;

namespace {

// The compliance centre's place where the tip's right corner touches the right wall and the left side touches the left
// edge of the mouth, at a depth along the peg: 2 r cos + l sin = 2 R.
Configuration two_contacts(const PegInHole& joint, double depth_mm) {
  const double r = joint.peg_half_mm, wide = joint.hole_half_mm;
  const double size = std::hypot(2 * r, depth_mm);
  const double tilt = std::atan2(depth_mm, 2 * r) - std::acos(2 * wide / size);
  const Point along = rotated(Point(0, 1), tilt), aside = rotated(Point(1, 0), tilt);
  const Point tip = Point(-wide, 0) + r * aside - depth_mm * along;
  const Point centre = tip + joint.centre_mm * along;
  return {centre.x(), centre.y(), tilt};
}

}  // namespace

// M / (r Fz) + mu (1 + lambda) Fx / Fz = lambda, lambda = l / (2 r mu), M about the middle of the tip: the edge of the
// parallelogram that belongs to a tip on the right wall. Small play: the tilt turns the normals by next to nothing.
TEST_CASE("A load just outside the jamming parallelogram holds a peg and one just inside pushes it in") {
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    PegInHole joint;
    joint.hole_chamfer_mm = 0;
    joint.hole_half_mm = joint.peg_half_mm + 0.001;
    joint.friction = uniform(random, 0.15, 0.4);
    joint.centre_mm = uniform(random, 0, 40);
    const SteppingScene scene = scene_of(joint);
    const JointTask made(scene);
    const double r = joint.peg_half_mm, mu = joint.friction;
    const double depth = 2 * r * mu * uniform(random, 1.3, 3);  // deep enough not to wedge
    const Configuration q = two_contacts(joint, depth);
    REQUIRE(touches_at(made.space, q).size() == 2);
    const double lambda = depth / (2 * r * mu), lateral = uniform(random, -0.9, 0.9) / mu,
                 axial = uniform(random, 1, 50);
    const Eigen::Vector3d stiffness(joint.stiffness.kx_n_per_mm, joint.stiffness.ky_n_per_mm,
                                    joint.stiffness.ktheta_nmm_per_rad);
    const WaysOn ways(made.space, stiffness, mu);
    const auto carrier = [&](double share) {
      const double at_tip = r * axial * (share * lambda - mu * (1 + lambda) * lateral);
      const Point force(lateral * axial, -axial), arm = rotated(Point(0, joint.centre_mm), q.theta_rad);
      const Eigen::Vector3d load(force.x(), force.y(), at_tip - cross(arm, force));
      return Eigen::Vector3d(vector_of(q) + load.cwiseQuotient(stiffness));
    };
    CAPTURE(i, lambda, lateral * mu, mu);
    CHECK(ways.held(q, carrier(1.03)));
    CHECK_FALSE(ways.held(q, carrier(0.97)));
    const auto motions = ways.first_motions(q, carrier(0.97));
    REQUIRE(motions.size() == 1);
    const Eigen::Vector3d& v = motions.front().velocity;
    CHECK(v[1] < 0);
  }
}
