#include "analysis/contact/contact_curves.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "analysis/contact/trig_roots.hpp"
#include "analysis/geometry/boolean.hpp"
#include "witness/minkowski_scenes.hpp"

using namespace formotion;

namespace {

constexpr double kPi = std::numbers::pi;

ContactState state_at(const witness::ContactScene& scene, const ContactPair& pair, const Configuration& q) {
  return contact_state(scene.part, scene.obstacles, pair, q.position(), std::cos(q.theta_rad), std::sin(q.theta_rad));
}

ContactPair some_pair(witness::Random& random, const std::vector<ContactPair>& pairs) {
  return pairs[static_cast<std::size_t>(witness::below(random, static_cast<int>(pairs.size())))];
}

// Orientations at which the third gap along the curve of the first two changes its sign, by brute force.
std::vector<double> scanned(const witness::ContactScene& scene, const std::array<ContactPair, 3>& pairs, int branch,
                            int samples) {
  const auto gap = [&](double theta) -> std::optional<double> {
    const double c = std::cos(theta), s = std::sin(theta);
    const auto at = two_contact_positions(scene.part, scene.obstacles, pairs[0], pairs[1], c, s);
    if (branch >= at.count || at.position[branch].norm() > 1e5) return std::nullopt;  // a pole is no root
    return contact_state(scene.part, scene.obstacles, pairs[2], at.position[branch], c, s).gap_mm;
  };
  std::vector<double> found;
  for (int i = 0; i < samples; ++i) {
    double a = 2 * kPi * (i + 0.37) / samples, b = 2 * kPi * (i + 1.37) / samples;
    const auto ga = gap(a), gb = gap(b);
    if (!ga || !gb || (*ga < 0) == (*gb < 0)) continue;
    for (int k = 0; k < 60; ++k) {
      const double m = 0.5 * (a + b);
      const auto gm = gap(m);
      if (!gm) break;
      ((*gm < 0) == (*ga < 0) ? a : b) = m;
    }
    const auto there = gap(a);
    if (there && std::abs(*there) < 1e-6) found.push_back(a);
  }
  return found;
}

}  // namespace

TEST_CASE("zeros of trigonometric polynomials are all there and are zeros: 20,000 of them, up to four each") {
  witness::Random random(1);
  std::array<int, 5> counts{};
  for (int i = 0; i < 20000; ++i) {
    const auto u = [&] { return witness::uniform(random, -1, 1); };
    TrigPolynomial f{u(), u(), u(), u(), u()};
    if (i % 5 == 0) f.cos2 = f.sin2 = 0;
    if (i % 5 == 1) f.cos2 *= std::pow(10.0, -witness::below(random, 16)), f.sin2 *= 1e-9;
    const std::vector<double> found = zeros(f);
    ++counts[found.size()];
    for (const double t : found) REQUIRE(std::abs(f(t)) <= 1e-12 * f.size());
    int changes = 0;
    for (int k = 0; k < 720; ++k) changes += (f(2 * kPi * k / 720) < 0) != (f(2 * kPi * (k + 1) / 720) < 0);
    CAPTURE(i, f.constant, f.cos1, f.sin1, f.cos2, f.sin2);
    REQUIRE(static_cast<int>(found.size()) >= changes);
    REQUIRE(found.size() % 2 == 0);
  }
  for (const int even : {0, 2, 4}) CHECK(counts[static_cast<std::size_t>(even)] > 1000);
}

TEST_CASE("touching zeros are found once") {
  for (const double at : {0.0, 0.3, 2.0, 6.0}) {
    // (1 - cos(t - at)) has a double zero, and times (1 + cos(t - at) / 2) no other.
    const TrigPolynomial one{1, -std::cos(at), -std::sin(at)}, other{1, 0.5 * std::cos(at), 0.5 * std::sin(at)};
    for (const TrigPolynomial& f : {one, one * other}) {
      const std::vector<double> found = zeros(f);
      REQUIRE(found.size() == 1);
      CHECK(std::abs(std::remainder(found[0] - at, 2 * kPi)) < 1e-6);
    }
  }
  CHECK(zeros({}).empty());
  CHECK(zeros({1, 0.5}).empty());
}

TEST_CASE("at the positions of two contacts both gaps vanish, and the tangent is the curve's direction") {
  witness::Random random(2);
  int checked = 0;
  for (int i = 0; i < 4000; ++i) {
    const witness::ContactScene scene =
        i % 3 == 0 ? witness::random_scene(random) : witness::round_scene(random, i % 3 == 1);
    const std::vector<ContactPair> pairs = contact_pairs(scene.part, scene.obstacles);
    const ContactPair one = some_pair(random, pairs), other = some_pair(random, pairs);
    const double theta = witness::uniform(random, 0, 2 * kPi);
    const auto at = [&](double t) {
      return two_contact_positions(scene.part, scene.obstacles, one, other, std::cos(t), std::sin(t));
    };
    const auto here = at(theta);
    for (int branch = 0; branch < here.count; ++branch) {
      const Point& p = here.position[branch];
      if (p.norm() > 500) continue;  // near a pole
      const Configuration q{p.x(), p.y(), theta};
      const ContactState a = state_at(scene, one, q), b = state_at(scene, other, q);
      CAPTURE(i, branch);
      if (a.normal.isApprox(b.normal, 0.1) || a.normal.isApprox(-b.normal, 0.1)) continue;
      REQUIRE(std::abs(a.gap_mm) < 1e-9);
      REQUIRE(std::abs(b.gap_mm) < 1e-9);
      const double h = 1e-6, gyration = 9;
      const auto more = at(theta + h), less = at(theta - h);
      if (more.count != here.count || less.count != here.count) continue;
      const Point slope = (more.position[branch] - less.position[branch]) / (2 * h);
      Eigen::Vector3d numeric(slope.x(), slope.y(), gyration);
      numeric.normalize();
      const Eigen::Vector3d tangent = curve_tangent(a, b, gyration);
      REQUIRE(std::abs(std::abs(tangent.dot(numeric)) - 1) < 1e-6);
      ++checked;
    }
  }
  CHECK(checked > 1500);
}

TEST_CASE("three contacts: every root of a scan over theta is found, and every root found is one") {
  witness::Random random(3);
  int roots = 0, most = 0, round = 0, within = 0;
  for (int i = 0; i < 6000; ++i) {
    const witness::ContactScene scene = i % 2 == 0 ? witness::round_scene(random, true) : witness::random_scene(random);
    const std::vector<ContactPair> pairs = contact_pairs(scene.part, scene.obstacles);
    const std::array<ContactPair, 3> three{some_pair(random, pairs), some_pair(random, pairs),
                                           some_pair(random, pairs)};
    if (three[0] == three[1] || three[1] == three[2] || three[0] == three[2]) continue;
    ThreeContactOptions options;
    options.within_facets = false;
    const std::vector<Configuration> found = three_contacts(scene.part, scene.obstacles, three, options);
    for (const Configuration& q : found) {
      for (const ContactPair& pair : three) REQUIRE(std::abs(state_at(scene, pair, q).gap_mm) < 1e-9);
    }
    roots += static_cast<int>(found.size());
    const bool arcs = std::any_of(three.begin(), three.end(),
                                  [](const ContactPair& p) { return p.kind == ContactKind::CornerOnCorner; });
    round += arcs && !found.empty();
    if (!arcs) most = std::max(most, static_cast<int>(found.size()));
    // Within their facets: those of them at which each pair can touch.
    for (const Configuration& q : three_contacts(scene.part, scene.obstacles, three)) {
      for (const ContactPair& pair : three) {
        const ContactState state = state_at(scene, pair, q);
        REQUIRE(state.along_mm >= -1e-9);
        REQUIRE(state.along_mm <= state.extent_mm + 1e-9);
        REQUIRE(contact_orientations(scene.part, scene.obstacles, pair)->contains(q.theta_rad, 1e-9));
      }
      REQUIRE(std::any_of(found.begin(), found.end(), [&](const Configuration& other) {
        return (q.position() - other.position()).norm() < 1e-9 && std::abs(q.theta_rad - other.theta_rad) < 1e-9;
      }));
      ++within;
    }
    // Triples that touch along a whole curve (edges of one line, that the union's grid has moved by 1e-9 mm).
    const auto at = two_contact_positions(scene.part, scene.obstacles, three[0], three[1], std::cos(1), std::sin(1));
    if (!arcs && at.count == 1 &&
        std::abs(state_at(scene, three[2], {at.position[0].x(), at.position[0].y(), 1}).gap_mm) < 1e-7) {
      continue;
    }
    for (int branch = 0; branch < 2; ++branch) {
      for (const double theta : scanned(scene, three, branch, 360)) {
        CAPTURE(i, theta, arcs);
        REQUIRE(std::any_of(found.begin(), found.end(), [&](const Configuration& q) {
          return std::abs(std::remainder(q.theta_rad - theta, 2 * kPi)) < 1e-5;
        }));
      }
    }
  }
  CHECK(roots > 3000);
  CHECK(most == 4);
  CHECK(within > 10);
  CHECK(within < roots / 2);
  CHECK(round > 50);
}

TEST_CASE("two parallel lines meet at two orientations at most, in a horizontal line") {
  // A bar of length 10 between walls 6 apart, both of its ends touching: cos theta = 6 / 10 turned by 90 degrees.
  const MovingShape bar = MovingShape::of({{rectangle(-5, -0.001, 5, 0.001), {}}}, 3);
  const Obstacles walls =
      *make_obstacles({{{rectangle(-50, -13, 50, -3), {}}, 0, false}, {{rectangle(-50, 3, 50, 13), {}}, 0, false}});
  int found = 0;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      for (int low = 0; low < static_cast<int>(walls.edges.size()); ++low) {
        for (int high = 0; high < static_cast<int>(walls.edges.size()); ++high) {
          const FixedEdge &a = walls.edges[low], &b = walls.edges[high];
          if (a.normal.y() < 0.5 || b.normal.y() > -0.5 || a.from.y() > 0 || b.from.y() < 0) continue;
          const ContactPair one{ContactKind::CornerOnEdge, i, low}, other{ContactKind::CornerOnEdge, j, high};
          for (const double theta : horizontal_orientations(bar, walls, one, other)) {
            // With the one corner on the lower wall the other is on the upper one, wherever the bar is along them.
            const Point lever = rotated(bar.corners[i].at, theta), across = rotated(bar.corners[j].at, theta);
            CHECK(across.y() - lever.y() == Approx(6).margin(1e-9));
            ++found;
          }
        }
      }
    }
  }
  CHECK(found == 16);  // two orientations for each of the 8 pairs of corners at opposite ends
}

TEST_CASE("a ladder's middle moves on a circle") {
  const MovingShape ladder = MovingShape::of({{rectangle(-5, -1e-6, 5, 1e-6), {}}}, 3);
  const Obstacles corner =
      *make_obstacles({{{rectangle(-60, -10, 50, 0), {}}, 0, false}, {{rectangle(-60, 0, 0, 50), {}}, 0, false}});
  int floor = -1, wall = -1;
  for (int i = 0; i < static_cast<int>(corner.edges.size()); ++i) {
    const FixedEdge& edge = corner.edges[i];
    if (edge.normal.y() > 0.9 && std::abs(edge.from.y()) < 1e-9) floor = i;
    if (edge.normal.x() > 0.9 && std::abs(edge.from.x()) < 1e-9) wall = i;
  }
  REQUIRE(floor >= 0);
  REQUIRE(wall >= 0);
  int right = 0, left = 0;
  for (int i = 0; i < 4; ++i) {
    if (ladder.corners[i].at.x() > 0 && ladder.corners[i].at.y() < 0) right = i;
    if (ladder.corners[i].at.x() < 0 && ladder.corners[i].at.y() < 0) left = i;
  }
  for (const double theta : {-0.1, -0.7, -1.4}) {
    const auto at = two_contact_positions(ladder, corner, {ContactKind::CornerOnEdge, right, floor},
                                          {ContactKind::CornerOnEdge, left, wall}, std::cos(theta), std::sin(theta));
    REQUIRE(at.count == 1);
    CHECK(at.position[0].norm() == Approx(5).epsilon(1e-5));
  }
}
