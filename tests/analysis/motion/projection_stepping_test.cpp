// Forward projection beside a slow time-stepper of the complementarity problem.
#include <catch2/catch.hpp>

#include "analysis/motion/projection_worlds.hpp"
#include "witness/contact_lcp.hpp"

using namespace formotion;
using namespace formotion::witness;
using namespace formotion::worlds;

namespace {

// The law taken in small steps: contacts within a skin, the motion by Lemke's method, and what overlaps pushed apart.
struct Stepped {
  bool rests = false, leaves = false, lost = false;
  Configuration last;
};
Stepped stepped(const MovingShape& part, const Obstacles& obstacles, const Scene& scene, double step_mm, double most_mm,
                double leave_x) {
  Stepped result;
  Configuration q = scene.start;
  const double skin = 0.2 * step_mm;
  const double size = scene.drive.force.norm();
  std::uint64_t k = 0;
  for (double way = 0; way < most_mm; way += step_mm) {
    const double room = clearance_mm(part, obstacles, q);
    LcpCase lcp;
    lcp.friction = scene.drive.friction;
    lcp.gyration_mm = part.gyration_mm;
    lcp.wrench = {scene.drive.force.x() / size, scene.drive.force.y() / size, 0};
    double h = step_mm;
    if (room > skin) {
      h = std::max(step_mm, 0.9 * room / (1 + part.reach_mm * 0));  // free: it does not turn
    } else {
      for (const Contact& contact : contacts_at(part, obstacles, q, skin)) {
        const LcpContact here{contact.state.normal, contact.state.lever};
        const bool known = std::any_of(lcp.contacts.begin(), lcp.contacts.end(), [&](const LcpContact& c) {
          return (c.normal - here.normal).norm() < 1e-6 && (c.lever - here.lever).norm() < 2 * skin;
        });
        if (!known) lcp.contacts.push_back(here);
      }
    }
    Twist3 twist = lcp.wrench;
    if (!lcp.contacts.empty()) {
      Eigen::VectorXd cover = Eigen::VectorXd::Constant(4 * static_cast<Eigen::Index>(lcp.contacts.size()), 1);
      for (Eigen::Index i = 0; i < cover.size(); ++i) cover[i] += 0.01 * static_cast<double>((++k * 7919) % 97);
      const auto found = twist_by_lemke(lcp, cover);
      if (!found) {
        result.lost = true;
        return result;
      }
      twist = *found;
    }
    const double fast = std::hypot(twist[0], twist[1], part.gyration_mm * twist[2]);
    if (fast < 1e-5) {
      result.rests = true;
      result.last = q;
      return result;
    }
    const double scale = h / std::max(fast, 0.2);
    q = {q.x_mm + scale * twist[0], q.y_mm + scale * twist[1], q.theta_rad + scale * twist[2]};
    for (int i = 0; i < 3; ++i) {
      const Clearance over = clearance(part, obstacles, q);
      if (over.mm >= 0) break;
      const Point out = over.on_obstacles - over.on_part;
      q.x_mm += out.x();
      q.y_mm += out.y();
    }
    if (q.x_mm > leave_x) {
      result.leaves = true;
      result.last = q;
      return result;
    }
  }
  result.lost = true;
  return result;
}

}  // namespace

TEST_CASE("a time-stepper that solves the complementarity problem ends where projection does") {
  int compared = 0, rests = 0, leaves = 0, unsure = 0;
  double worst = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Random random(seed + 500);
    Scene scene;
    scene.outline = centred(random_polygon(random, 9));
    scene.shapes = {wall(), block({{-3, -2}, {14, -2}, {14, uniform(random, 2, 14)}}),
                    pin({uniform(random, 18, 26), uniform(random, 2, 12)}, uniform(random, 1, 3))};
    scene.drive = {direction(uniform(random, -0.9, -0.2)), below(random, 4) ? uniform(random, 0.05, 0.4) : 0};
    scene.start = {-14, 11, uniform(random, -kPi, kPi)};
    const MovingShape part = scene.part();
    const Obstacles obstacles = scene.obstacles();
    if (!is_free(part, obstacles, scene.start)) continue;
    const Projection path = project(part, obstacles, scene.drive, scene.start);
    if (path.end != ProjectionEnd::AtRest && path.end != ProjectionEnd::Steady) continue;
    CAPTURE(seed);
    const Stepped coarse = stepped(part, obstacles, scene, 1e-2, 600, 250);
    const Stepped fine = stepped(part, obstacles, scene, 5e-3, 600, 250);
    // Near a boundary between outcomes, or where contacts come and go, steps of different sizes end differently.
    const bool sure = !coarse.lost && !fine.lost && coarse.rests == fine.rests &&
                      std::abs(coarse.last.theta_rad - fine.last.theta_rad) < 2e-3;
    if (!sure) {
      ++unsure;
      continue;
    }
    ++compared;
    CHECK(fine.rests == (path.end == ProjectionEnd::AtRest));
    if (fine.rests) {
      ++rests;
      const double off = apart(fine.last, path.last);
      worst = std::max(worst, off);
      CHECK(off < 2e-2);
    } else {
      ++leaves;
      CHECK(std::abs(fine.last.theta_rad - path.last.theta_rad) < 2e-3);
      CHECK(std::abs(fine.last.y_mm - path.last.y_mm) < 2e-2);
    }
  }
  CAPTURE(compared, rests, leaves, unsure, worst);
  CHECK(compared > 12);
  CHECK(rests > 3);
  CHECK(leaves > 3);
  CHECK(unsure < compared);
}
