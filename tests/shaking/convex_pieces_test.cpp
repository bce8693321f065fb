#include "shaking/convex_pieces.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "analysis/geometry/boolean.hpp"
#include "witness/random_shapes.hpp"

using namespace formotion;
using namespace formotion::witness;

namespace {

double area_of(const std::vector<Polygon>& areas) {
  double sum = 0;
  for (const Polygon& area : areas) {
    for (const Loop& loop : loops_of(area)) sum += signed_area(loop);
  }
  return sum;
}

void check_pieces(const Polygon& area, int max_corners) {
  Loop corners;
  for (const Loop& loop : loops_of(area)) corners.insert(corners.end(), loop.begin(), loop.end());
  const std::vector<Loop> pieces = convex_pieces(area, max_corners);
  double sum = 0;
  for (const Loop& piece : pieces) {
    CHECK(piece.size() <= static_cast<std::size_t>(max_corners));
    sum += signed_area(piece);
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const Point &a = piece[i], &b = piece[(i + 1) % piece.size()], &c = piece[(i + 2) % piece.size()];
      CHECK(cross(b - a, c - b) >= -1e-9 * (b - a).norm() * (c - b).norm());
      CHECK(std::find(corners.begin(), corners.end(), a) != corners.end());
    }
  }
  // As much area together as apart: no overlaps. The same area: nothing missing, nothing outside.
  CHECK(sum == Approx(area_of({area})).epsilon(1e-9));
  CHECK(area_of(united(pieces)) == Approx(sum).epsilon(1e-6));
  CHECK(area_of(difference(pieces, loops_of(area))) < 1e-6 * sum);
}

}  // namespace

TEST_CASE("Convex pieces cover an area once with corners of its own") {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    for (const Polygon& area : {random_polygon(random, 10), grid_polygon(random, 6)}) {
      const Polygon clean = normalised(area);
      if (!defect(clean)) check_pieces(clean, 3 + i % 6);
    }
  }
}

TEST_CASE("Convex pieces leave holes open") {
  Random random(2);
  int with_holes = 0;
  for (int i = 0; i < 150; ++i) {
    std::vector<Loop> cut;
    for (int k = 0; k < 1 + i % 4; ++k) {
      const Point at(uniform(random, -8, 8), uniform(random, -8, 8));
      const Polygon shape = i % 2 ? random_polygon(random, 3) : grid_polygon(random, 3);
      cut.push_back(placed(shape, 0, i % 2 ? at : Point(at.array().round())).outer);
    }
    for (const Polygon& area : difference({rectangle(-10, -10, 10, 10)}, cut)) {
      const Polygon clean = normalised(area);
      if (defect(clean)) continue;
      with_holes += clean.holes.empty() ? 0 : 1;
      check_pieces(clean, 8);
    }
  }
  CHECK(with_holes > 50);
}
