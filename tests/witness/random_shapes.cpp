#include "witness/random_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/geometry/boolean.hpp"

namespace formotion::witness {

// Written out, since the standard's distributions differ between libraries.
double uniform(Random& random, double from, double to) {
  return from + (to - from) * static_cast<double>(random() >> 11) * 0x1.0p-53;
}
int below(Random& random, int n) { return static_cast<int>(random() % static_cast<std::uint64_t>(n)); }

Polygon random_polygon(Random& random, double size) {
  const int n = 3 + below(random, 8);
  std::vector<double> angles;
  for (int i = 0; i < n; ++i) angles.push_back((i + uniform(random, 0.05, 0.95)) * 2 * std::numbers::pi / n);
  Loop loop;
  for (const double angle : angles) {
    const double radius = size * uniform(random, 0.3, 1);
    loop.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return normalised({loop, {}});
}

Polygon grid_polygon(Random& random, int size) {
  const double w = 2 + below(random, size), h = 2 + below(random, size);
  const double a = 1 + below(random, static_cast<int>(w) - 1), b = 1 + below(random, static_cast<int>(h) - 1);
  switch (below(random, 4)) {
    case 0:
      return {rectangle(0, 0, w, h), {}};
    case 1:
      return {{{0, 0}, {w, 0}, {w, b}, {a, b}, {a, h}, {0, h}}, {}};  // an el
    case 2:
      return {{{0, 0}, {w + 2, 0}, {w + 2, h}, {w + 1, h}, {w + 1, b}, {1, b}, {1, h}, {0, h}}, {}};  // a channel
    default:
      return {rectangle(0, 0, w + 2, h + 2), {{{1, 1}, {1, 1 + b}, {1 + a, 1 + b}, {1 + a, 1}}}};  // a frame
  }
}

Situation random_situation(Random& random) {
  Situation s;
  s.track.width_mm = uniform(random, 15, 40);
  s.part = placed(random_polygon(random, 15), 0, {uniform(random, 0, 30), uniform(random, 2, 25)});
  if (below(random, 3) == 0) {  // a small hole about the middle of a big part
    Polygon big = random_polygon(random, 20);
    big.holes.push_back({{-1, -1}, {-1, 1}, {1, 1}, {1, -1}});
    const Point offset(uniform(random, 0, 30), uniform(random, 2, 25));
    if (!defect(big)) s.part = placed(big, uniform(random, 0, 6), offset);
  }
  const int voids = 1 + below(random, 3);
  std::vector<Loop> loops;
  for (int i = 0; i < voids; ++i) {
    const Point at(uniform(random, 0, 30), uniform(random, 0, 30));
    loops.push_back(below(random, 2)
                        ? placed(random_polygon(random, 10), 0, at).outer
                        : rectangle(at.x(), at.y(), at.x() + uniform(random, 1, 20), at.y() + uniform(random, 1, 30)));
  }
  s.track.voids = united(loops);
  const Box box = bounding_box(s.part.outer);
  s.supported_point = {uniform(random, box.min.x(), box.max.x()), uniform(random, box.min.y(), box.max.y())};
  return s;
}

Situation degenerate_situation(Random& random) {
  Situation s;
  s.track.width_mm = 8 + below(random, 10);
  const Polygon part = grid_polygon(random, 10);
  s.part = placed(part, 0, Point(below(random, 10), below(random, 6)));
  const int voids = 1 + below(random, 2);
  std::vector<Loop> loops;
  for (int i = 0; i < voids; ++i) {
    loops.push_back(placed(grid_polygon(random, 8), 0, Point(below(random, 12), below(random, 10))).outer);
  }
  s.track.voids = united(loops);
  const Box box = bounding_box(s.part.outer);
  s.supported_point = {box.min.x() + 0.5 * below(random, 20), box.min.y() + 0.5 * below(random, 20)};
  return s;
}

}  // namespace formotion::witness
