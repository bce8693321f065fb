#include "applications/feeder/swept_obstacle.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/geometry/boolean.hpp"
#include "analysis/geometry/offset.hpp"

namespace formotion::feeder {
namespace {

// The precision's shares: every point of the part comes by a sample within kStep / 2, so growing by that covers what
// lies between samples; another kRoom is left for making outlines simpler. With tangents for arcs (a factor of 1.005)
// the sum stays below 1.
constexpr double kStep = 0.9, kRoom = 0.25;
constexpr double kArcStep_rad = 0.2;
constexpr std::size_t kBlock = 16;  // shapes that are united at once

using Loops = std::vector<Loop>;

// A tree of unions: each is of few shapes.
Loops united_all(std::vector<Loops> shapes) {
  while (shapes.size() > 1) {
    std::vector<Loops> next;
    for (std::size_t i = 0; i < shapes.size(); i += kBlock) {
      Loops block;
      for (std::size_t k = i; k < std::min(i + kBlock, shapes.size()); ++k)
        block.insert(block.end(), shapes[k].begin(), shapes[k].end());
      next.push_back(loops_of(united(block)));
    }
    shapes = std::move(next);
  }
  return shapes.empty() ? Loops() : shapes.front();
}

Loops placed_loops(const std::vector<Polygon>& bodies, const Configuration& q) {
  Loops loops;
  for (const Polygon& body : bodies) {
    for (Loop& loop : loops_of(placed(body, q.theta_rad, q.position()))) loops.push_back(std::move(loop));
  }
  return loops;
}

// What a translation sweeps besides both of its ends: a parallelogram an edge.
void add_translation(const Loops& from, const Point& way, std::vector<Loops>& shapes) {
  for (const Loop& loop : from) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Point &a = loop[k], &b = loop[(k + 1) % loop.size()];
      Loop quad{a, b, b + way, a + way};
      if (signed_area(quad) < 0) std::reverse(quad.begin(), quad.end());
      shapes.push_back({std::move(quad)});
    }
  }
}

// Corners left out while the outline moves by less than tolerance_mm (Douglas, Peucker 1973), between two that stay.
void thin_out(const Loop& loop, std::size_t first, std::size_t last, double tolerance_mm, Loop& kept) {
  std::size_t farthest = first;
  double away = tolerance_mm;
  for (std::size_t k = first + 1; k < last; ++k) {
    const double off = distance_to_segment(loop[k], loop[first], loop[last % loop.size()]);
    if (off > away) {
      away = off;
      farthest = k;
    }
  }
  if (farthest == first) {
    kept.push_back(loop[first]);
    return;
  }
  thin_out(loop, first, farthest, tolerance_mm, kept);
  thin_out(loop, farthest, last, tolerance_mm, kept);
}

Loop simpler(const Loop& loop, double tolerance_mm) {
  std::size_t opposite = 0;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    if ((loop[k] - loop[0]).norm() > (loop[opposite] - loop[0]).norm()) opposite = k;
  }
  Loop kept;
  thin_out(loop, 0, opposite, tolerance_mm, kept);
  thin_out(loop, opposite, loop.size(), tolerance_mm, kept);
  return kept;
}

double area_of(const Polygon& polygon) {
  double area = 0;
  for (const Loop& loop : loops_of(polygon)) area += signed_area(loop);
  return area;
}

}  // namespace

SweptObstacle swept_obstacle(const std::vector<Polygon>& bodies, const std::vector<Configuration>& path,
                             const Loop& region, double precision_mm) {
  double reach = 0;
  for (const Polygon& body : bodies) {
    for (const Point& p : body.outer) reach = std::max(reach, p.norm());
  }
  std::vector<Loops> shapes{placed_loops(bodies, path.front())};
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    const Configuration &a = path[k], &b = path[k + 1];
    const Point way = b.position() - a.position();
    const double turn = b.theta_rad - a.theta_rad;
    const int steps =
        turn == 0 ? 1 : static_cast<int>(std::ceil((way.norm() + reach * std::abs(turn)) / (kStep * precision_mm)));
    for (int i = 1; i <= steps; ++i) {
      const double t = static_cast<double>(i) / steps;
      shapes.push_back(placed_loops(bodies, {a.x_mm + t * way.x(), a.y_mm + t * way.y(), a.theta_rad + t * turn}));
    }
    if (turn == 0) add_translation(placed_loops(bodies, a), way, shapes);
  }
  OffsetOptions options;
  options.arc_step_rad = kArcStep_rad;
  const Loops sweep = united_all(std::move(shapes));
  const Loops covered = offset(sweep, kStep / 2 * precision_mm, options);
  const Loop outline = signed_area(region) < 0 ? Loop(region.rbegin(), region.rend()) : region;
  Loops simple;
  for (const Loop& loop : loops_of(difference({outline}, offset(covered, kRoom * precision_mm, options)))) {
    Loop thinned = simpler(loop, kRoom * precision_mm);
    if (thinned.size() >= 3) simple.push_back(std::move(thinned));
  }
  // Thin places may have come to overlap the sweep: what does is taken away again.
  SweptObstacle result{difference(loops_of(intersection(simple, {outline})), covered)};
  std::stable_sort(result.pieces.begin(), result.pieces.end(),
                   [](const Polygon& a, const Polygon& b) { return area_of(a) > area_of(b); });
  return result;
}

}  // namespace formotion::feeder
