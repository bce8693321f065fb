// Parts in pockets and random nests, for tests of escape heights.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/contact/clearance.hpp"
#include "analysis/energy/escape.hpp"
#include "analysis/geometry/boolean.hpp"
#include "witness/random_shapes.hpp"

namespace formotion::testing {

inline Polygon block(double x_min, double y_min, double x_max, double y_max) {
  return {rectangle(x_min, y_min, x_max, y_max), {}};
}
// Material about a pocket of this width and depth, its floor on y = 0.
inline Polygon pocket(double width, double depth, double half_extent = 40) {
  const double w = width / 2, e = half_extent;
  return {{{-e, -10}, {e, -10}, {e, depth}, {w, depth}, {w, 0}, {-w, 0}, {-w, depth}, {-e, depth}}, {}};
}
// With a flat below.
inline Polygon regular(int corners, double inradius) {
  Loop loop;
  const double radius = inradius / std::cos(std::numbers::pi / corners);
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.5) / corners - std::numbers::pi / 2;
    loop.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return {loop, {}};
}

// Not to be copied: the space points into it.
struct Nest {
  MovingShape part;
  Obstacles obstacles;
  ContactSpace space;
  Gravity gravity;

  Nest(const Polygon& drawn, const std::vector<ObstacleShape>& fixed, double grow_mm = 0, double turned_rad = 0)
      : part(MovingShape::of({drawn}, 5)), obstacles(made(fixed, grow_mm, turned_rad)), space(part, obstacles) {
    gravity.down = rotated(gravity.down, turned_rad);
  }
  Nest(const Polygon& drawn, const Polygon& fixed) : Nest(drawn, std::vector<ObstacleShape>{{fixed, 0, false}}) {}
  Nest(const Nest&) = delete;
  Nest& operator=(const Nest&) = delete;

  bool is_free(const Configuration& q) const { return formotion::is_free(part, obstacles, q); }
  EscapeBracket escape(const Configuration& start, const EscapeOptions& options = {}) const {
    return formotion::escape(space, gravity, start, beyond(obstacles, gravity), options);
  }

  // Sampled places of the path that overlap, and steps that end elsewhere than the next begins.
  int overlaps_on(const std::vector<Configuration>& path, int samples = 60) const {
    int overlaps = 0;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      for (int k = 0; k <= samples; ++k) {
        const double h = static_cast<double>(k) / samples;
        overlaps +=
            !is_free({std::lerp(path[i].x_mm, path[i + 1].x_mm, h), std::lerp(path[i].y_mm, path[i + 1].y_mm, h),
                      std::lerp(path[i].theta_rad, path[i + 1].theta_rad, h)});
      }
    }
    return overlaps;
  }
  double highest_on(const std::vector<Configuration>& path) const {
    double highest = -1e300;
    for (const Configuration& q : path) highest = std::max(highest, gravity.height_mm(q));
    return highest;
  }
  bool is_out(const Configuration& q) const {
    const EscapeGoal goal = beyond(obstacles, gravity);
    const double across = gravity.across_mm(q.position());
    return across <= goal.from_mm + 1e-9 || across >= goal.to_mm - 1e-9;
  }

 private:
  static Obstacles made(const std::vector<ObstacleShape>& fixed, double grow_mm, double turned_rad) {
    std::vector<ObstacleShape> turned = fixed;
    for (ObstacleShape& shape : turned) shape.area = placed(shape.area, turned_rad, Point::Zero());
    return *make_obstacles(turned, grow_mm);
  }
};

// A floor with random shapes on it, pins and grown shapes among them; a random free start between them. The random
// engine decides all.
struct RandomNest {
  Polygon part;
  std::vector<ObstacleShape> fixed;
  double grow_mm = 0;
  Configuration start;
  explicit RandomNest(std::uint64_t seed) {
    witness::Random random(seed);
    const bool grid = seed % 4 == 1;
    part = grid ? witness::grid_polygon(random, 8) : witness::random_polygon(random, 10);
    part = placed(part, 0, -area_moments(part).centroid);
    fixed.push_back({block(-40, -30, 40, -20), 0, false});
    for (int k = 0; k < 4; ++k) {
      const Point at(-33 + 22 * k + witness::uniform(random, -6, 6), witness::uniform(random, -20, -5));
      const Polygon shape = grid ? witness::grid_polygon(random, 12) : witness::random_polygon(random, 14);
      fixed.push_back({placed(shape, 0, grid ? Point(at.array().round()) : at), 0, false});
    }
    if (seed % 3 == 0) {
      const Point at(witness::uniform(random, -20, 20), witness::uniform(random, -10, 10));
      fixed.push_back({{{at}, {}}, witness::uniform(random, 1, 4), false});
    }
    if (seed % 5 == 4) grow_mm = 0.3;
    const Nest nest(part, fixed, grow_mm);
    for (int i = 0; i < 500; ++i) {
      start = {witness::uniform(random, -25, 25), witness::uniform(random, -20, 5), witness::uniform(random, 0, 6)};
      if (nest.is_free(start)) return;
    }
  }
};

}  // namespace formotion::testing
