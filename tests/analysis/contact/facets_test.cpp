#include "analysis/contact/facets.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "witness/minkowski_scenes.hpp"

using namespace formotion;

namespace {

constexpr double kPi = std::numbers::pi;

ContactState state_at(const witness::ContactScene& scene, const ContactPair& pair, const Configuration& q) {
  return contact_state(scene.part, scene.obstacles, pair, q.position(), std::cos(q.theta_rad), std::sin(q.theta_rad));
}

witness::ContactScene any_scene(witness::Random& random, int i) {
  switch (i % 4) {
    case 0:
      return witness::random_scene(random);
    case 1:
      return witness::grid_scene(random);
    default:
      return witness::round_scene(random, i % 4 == 2);
  }
}

// A random configuration on the facet, inside of it.
std::optional<Configuration> on_facet(witness::Random& random, const witness::ContactScene& scene,
                                      const ContactFacet& facet) {
  const double theta =
      facet.orientations.from_rad + witness::uniform(random, 0.01, 0.99) * facet.orientations.width_rad;
  const std::vector<AlongRange> ranges = along_ranges(scene.part, scene.obstacles, facet.pair, theta);
  if (ranges.empty()) return std::nullopt;
  const double along = std::lerp(ranges[0].from_mm, ranges[0].to_mm, witness::uniform(random, 0.01, 0.99));
  return configuration_on(scene.part, scene.obstacles, facet.pair, theta, along);
}

}  // namespace

TEST_CASE("on a facet the gap is zero and its gradient is that of finite differences") {
  witness::Random random(1);
  int checked = 0;
  for (int i = 0; i < 120; ++i) {
    const witness::ContactScene scene = any_scene(random, i);
    for (const ContactFacet& facet : contact_facets(scene.part, scene.obstacles)) {
      const auto q = on_facet(random, scene, facet);
      if (!q) continue;
      const ContactState state = state_at(scene, facet.pair, *q);
      CAPTURE(i, static_cast<int>(facet.pair.kind), facet.pair.moving, facet.pair.fixed);
      REQUIRE(std::abs(state.gap_mm) < 1e-11);
      const double h = 1e-6;
      Eigen::Vector3d numeric;
      for (int k = 0; k < 3; ++k) {
        Configuration more = *q, less = *q;
        (k == 0 ? more.x_mm : k == 1 ? more.y_mm : more.theta_rad) += h;
        (k == 0 ? less.x_mm : k == 1 ? less.y_mm : less.theta_rad) -= h;
        numeric[k] = (state_at(scene, facet.pair, more).gap_mm - state_at(scene, facet.pair, less).gap_mm) / (2 * h);
      }
      REQUIRE((numeric - state.gradient()).norm() < 1e-6 * (1 + state.lever.norm()));
      const Eigen::Vector3d normal = scaled_normal(state, 7);
      REQUIRE(normal.norm() == Approx(1));
      REQUIRE(normal.dot(Eigen::Vector3d(numeric.x(), numeric.y(), numeric.z() / 7)) > 0);
      ++checked;
    }
  }
  CHECK(checked > 10000);
}

TEST_CASE("facets are what both features allow: there are at most 2 n m of sharp ones, none of reflex corners") {
  witness::Random random(2);
  for (int i = 0; i < 200; ++i) {
    const witness::ContactScene scene = i % 2 ? witness::grid_scene(random) : witness::random_scene(random);
    const std::size_t n = scene.part.edges.size(), m = scene.obstacles.edges.size();
    const std::size_t count = contact_facets(scene.part, scene.obstacles).size();
    CHECK(count == scene.part.corners.size() * m + n * scene.obstacles.corners.size());
    CHECK(count <= 2 * n * m);
  }
  // A triangle and a triangle: 18. With a pin: 3 edges and 3 corners on it.
  const Polygon triangle{{{0, 0}, {4, 0}, {0, 3}}, {}};
  const MovingShape part = MovingShape::of({triangle}, 1);
  CHECK(contact_facets(part, *make_obstacles({{triangle, 0, false}})).size() == 18);
  CHECK(contact_facets(part, *make_obstacles({{{{{0, 0}}, {}}, 2, false}})).size() == 6);
}

TEST_CASE("beyond its orientations or its extent a facet's features overlap their neighbours or part") {
  const Polygon square{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, {}};
  const MovingShape part = MovingShape::of({square}, 1);
  const Obstacles obstacles = *make_obstacles({{square, 0, false}});
  for (const ContactFacet& facet : contact_facets(part, obstacles)) {
    const double start = facet.orientations.from_rad, width = facet.orientations.width_rad;
    REQUIRE(width == Approx(kPi / 2));
    for (const double theta : {start + 0.3 * width, start + 0.01, start + width - 0.01}) {
      CHECK(is_free(part, obstacles, configuration_on(part, obstacles, facet.pair, theta, 1)));
    }
    for (const double theta : {start - 0.01, start + width + 0.01}) {
      CHECK_FALSE(is_free(part, obstacles, configuration_on(part, obstacles, facet.pair, theta, 1)));
    }
  }
}

TEST_CASE("boundaries lie on their facets, and on each neighbour's own boundary where they are said to") {
  witness::Random random(4);
  int helices = 0, lines = 0, round = 0;
  for (int i = 0; i < 60; ++i) {
    const witness::ContactScene scene = any_scene(random, i);
    const std::vector<ContactFacet> facets = contact_facets(scene.part, scene.obstacles);
    for (std::size_t f = 0; f < facets.size(); ++f) {
      for (const FacetSide side :
           {FacetSide::AlongStart, FacetSide::AlongEnd, FacetSide::ThetaStart, FacetSide::ThetaEnd}) {
        const FacetBoundary& boundary = facets[f].boundary[static_cast<std::size_t>(side)];
        const auto points = boundary_points(scene.part, scene.obstacles, facets[f], side, 5);
        REQUIRE(points.size() == (boundary.exists ? 5u : 0u));
        if (!boundary.exists) continue;
        CAPTURE(i, f, static_cast<int>(side));
        REQUIRE((points.front().position() - boundary.from.position()).norm() < 1e-12);
        REQUIRE((points.back().position() - boundary.to.position()).norm() < 1e-9);
        for (const Configuration& q : points) REQUIRE(std::abs(state_at(scene, facets[f].pair, q).gap_mm) < 1e-10);
        for (const FacetNeighbour& neighbour : boundary.neighbours) {
          const ContactFacet& other = facets[static_cast<std::size_t>(neighbour.facet)];
          // Mutual.
          const auto& back = other.boundary[static_cast<std::size_t>(neighbour.side)].neighbours;
          REQUIRE(std::any_of(back.begin(), back.end(), [&](const FacetNeighbour& b) {
            return static_cast<std::size_t>(b.facet) == f && b.side == side;
          }));
          // The common stretch is on both: gaps vanish along this boundary where it is said to.
          for (int k = 0; k <= 40; ++k) {
            const double t = k / 40.0;
            const double theta = std::lerp(boundary.from.theta_rad, boundary.to.theta_rad, t);
            if (!boundary.horizontal && !neighbour.orientations.contains(theta)) continue;
            const Configuration q = configuration_on(scene.part, scene.obstacles, facets[f].pair, theta,
                                                     std::lerp(boundary.along_from_mm, boundary.along_to_mm, t));
            const ContactState state = state_at(scene, other.pair, q);
            REQUIRE(std::abs(state.gap_mm) < 1e-9);
            if (boundary.horizontal && (state.along_mm < -1e-9 || state.along_mm > state.extent_mm + 1e-9)) continue;
            if (other.pair.kind != ContactKind::CornerOnCorner) {
              REQUIRE(state.along_mm > -1e-9);
              REQUIRE(state.along_mm < state.extent_mm + 1e-9);
            }
            REQUIRE(contact_orientations(scene.part, scene.obstacles, other.pair)->contains(theta, 1e-9));
          }
          if (boundary.horizontal) {
            ++lines;
          } else if (other.pair.kind == ContactKind::CornerOnCorner ||
                     facets[f].pair.kind == ContactKind::CornerOnCorner) {
            ++round;
          } else {
            ++helices;
          }
        }
      }
    }
  }
  CHECK(helices > 3000);
  CHECK(lines > 3000);
  CHECK(round > 500);
}

TEST_CASE("a square on a square has neighbours across each boundary") {
  const Polygon square{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, {}};
  const MovingShape part = MovingShape::of({square}, 1);
  for (const ContactFacet& facet : contact_facets(part, *make_obstacles({{square, 0, false}}))) {
    // Along a helix the other kind's facets of the two corners. On a line the edges are of one length: two facets have
    // the one half of it in common, two the other.
    CHECK(facet.boundary[0].neighbours.size() >= 1);
    CHECK(facet.boundary[1].neighbours.size() >= 1);
    CHECK(facet.boundary[2].neighbours.size() == 1);
    CHECK(facet.boundary[3].neighbours.size() == 1);
  }
}

TEST_CASE("a pin's facets have no ends along it and go over into the edges' facets") {
  const Polygon square{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, {}};
  const MovingShape part = MovingShape::of({square}, 1);
  const auto facets = contact_facets(part, *make_obstacles({{{{{3, 4}}, {}}, 0.5, false}}));
  REQUIRE(facets.size() == 8);
  for (const ContactFacet& facet : facets) {
    const bool corner = facet.pair.kind == ContactKind::CornerOnCorner;
    const FacetSide open[] = {corner ? FacetSide::AlongStart : FacetSide::ThetaStart,
                              corner ? FacetSide::AlongEnd : FacetSide::ThetaEnd};
    const FacetSide joined[] = {corner ? FacetSide::ThetaStart : FacetSide::AlongStart,
                                corner ? FacetSide::ThetaEnd : FacetSide::AlongEnd};
    for (const FacetSide side : open) CHECK_FALSE(facet.boundary[static_cast<std::size_t>(side)].exists);
    for (const FacetSide side : joined) {
      const FacetBoundary& boundary = facet.boundary[static_cast<std::size_t>(side)];
      REQUIRE(boundary.neighbours.size() == 1);
      CHECK(boundary.to.theta_rad - boundary.from.theta_rad == Approx(2 * kPi));
    }
  }
}
