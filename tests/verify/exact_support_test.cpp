#include "verify/exact_support.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "witness/exact_support.hpp"
#include "witness/random_shapes.hpp"

using namespace formotion;

namespace {

// On the grid, so that both look at the same shapes, bit for bit.
Loop on_grid(Loop loop) {
  for (Point& p : loop) p = {on_exact_grid(p.x()), on_exact_grid(p.y())};
  return loop;
}

Polygon on_grid(Polygon polygon) {
  polygon.outer = on_grid(polygon.outer);
  for (Loop& hole : polygon.holes) hole = on_grid(hole);
  return polygon;
}

struct Counts {
  int held = 0, lost = 0, marginal = 0;
};

void compare(const witness::Situation& situation, Counts& counts) {
  const Polygon part = on_grid(situation.part);
  Track track{on_exact_grid(situation.track.width_mm), {}};
  std::vector<Loop> voids;
  for (const Polygon& hole : situation.track.voids) {
    track.voids.push_back(on_grid(hole));
    voids.push_back(track.voids.back().outer);
    for (const Loop& island : track.voids.back().holes) voids.push_back(island);
  }
  const Point supported(on_exact_grid(situation.supported_point.x()), on_exact_grid(situation.supported_point.y()));
  const ExactSupport answer = ExactTrack(track.width_mm, voids).support(part, supported, 0);
  const std::optional<double> margin = witness::margin_by_exact_generators(part, track, supported);
  if (margin && std::abs(*margin) <= 2 * kExactMarginal_mm) {
    ++counts.marginal;
    return;
  }
  const bool held = margin && *margin > 0;
  CHECK(answer == (held ? ExactSupport::Held : ExactSupport::Lost));
  ++(held ? counts.held : counts.lost);
}

}  // namespace

TEST_CASE("exact support is the witness's on random situations") {
  witness::Random random(11);
  Counts counts;
  for (int i = 0; i < 200; ++i) compare(witness::random_situation(random), counts);
  CHECK(counts.held > 20);
  CHECK(counts.lost > 20);
}

TEST_CASE("exact support is the witness's where corners lie on edges and edges on edges") {
  witness::Random random(12);
  Counts counts;
  for (int i = 0; i < 200; ++i) compare(witness::degenerate_situation(random), counts);
  CHECK(counts.held > 20);
  CHECK(counts.lost > 20);
}

TEST_CASE("voids that share an edge leave no metal between them, an island is metal") {
  const Polygon part{{{-5, 0}, {5, 0}, {5, 10}, {-5, 10}}, {}};
  const Loop left{{-20, -1}, {0, -1}, {0, 30}, {-20, 30}}, right{{0, -1}, {20, -1}, {20, 30}, {0, 30}};
  CHECK(ExactTrack(20, {left, right}).support(part, {0, 5}, 0) == ExactSupport::Lost);
  const Loop island{{-1, 4}, {-1, 6}, {1, 6}, {1, 4}};  // clockwise
  CHECK(ExactTrack(20, {left, right, island}).support(part, {0, 5}, 0) == ExactSupport::Held);
  CHECK(ExactTrack(20, {left, right, island}).support(part, {0, 6}, 0) == ExactSupport::Marginal);
  CHECK(ExactTrack(20, {left, right, island}).support(part, {0, 5}, 3) == ExactSupport::Lost);
}
