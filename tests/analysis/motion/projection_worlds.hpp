// Worlds for tests of forward projection, and what a watch sees of paths in them.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/contact/clearance.hpp"
#include "analysis/geometry/boolean.hpp"
#include "analysis/motion/contact_space.hpp"
#include "analysis/motion/projection.hpp"
#include "witness/random_shapes.hpp"

namespace formotion::worlds {

using namespace formotion::witness;

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kFar_mm = 1e5;

inline Point direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

inline Polygon centred(Polygon polygon) {
  polygon = normalised(std::move(polygon));
  return placed(polygon, 0, -area_moments(polygon).centroid);
}
inline double gyration(const Polygon& polygon) {
  const AreaMoments moments = area_moments(polygon);
  return std::sqrt(moments.second_mm4.trace() / moments.area_mm2 + moments.centroid.squaredNorm());
}

struct Scene {
  Polygon outline;  // about the centre of mass
  std::vector<ObstacleShape> shapes;
  double grow_mm = 0;
  Drive drive;
  Configuration start;

  MovingShape part() const { return MovingShape::of({outline}, gyration(outline)); }
  Obstacles obstacles() const { return *make_obstacles(shapes, grow_mm); }
};

inline ObstacleShape wall() { return {{{{-kFar_mm, -50}, {kFar_mm, -50}, {kFar_mm, 0}, {-kFar_mm, 0}}, {}}, 0, true}; }
inline ObstacleShape block(const Loop& loop) { return {{loop, {}}, 0, false}; }
inline ObstacleShape pin(const Point& centre, double radius) { return {{{centre}, {}}, radius, false}; }

inline Polygon random_part(Random& random) {
  switch (below(random, 4)) {
    case 0:
      return centred(grid_polygon(random, 18));
    case 1: {  // its centre of mass away from the centroid, perhaps outside
      const Polygon star = random_polygon(random, 18);
      return placed(star, 0, -area_moments(star).centroid + Point(uniform(random, -6, 6), uniform(random, -6, 6)));
    }
    default:
      return centred(random_polygon(random, 18));
  }
}

// A wall with ramps, stars and pins in the way, some of which stand into each other.
inline Scene random_scene(std::uint64_t seed) {
  Random random(seed);
  Scene scene;
  scene.outline = random_part(random);
  scene.shapes = {wall()};
  const int count = 1 + below(random, 4);
  double x = 0;
  for (int i = 0; i < count; ++i) {
    switch (below(random, 4)) {
      case 0: {
        const double length = uniform(random, 15, 60), slope = uniform(random, 0.1, 0.9);
        scene.shapes.push_back(block({{x - 5, -5 * slope}, {x + length, -5 * slope}, {x + length, slope * length}}));
        break;
      }
      case 1:
        scene.shapes.push_back(pin({x + uniform(random, 0, 20), uniform(random, 4, 40)}, uniform(random, 0.5, 5)));
        break;
      default:
        scene.shapes.push_back({placed(random_polygon(random, 16), 0, {x + 10, uniform(random, -5, 45)}), 0, false});
    }
    x += uniform(random, 10, 60);
  }
  if (below(random, 3) == 0) scene.grow_mm = uniform(random, 0.05, 1);
  scene.drive = {direction(uniform(random, -1.2, 0.1)), below(random, 4) ? uniform(random, 0.05, 0.7) : 0};
  const double theta = uniform(random, -kPi, kPi);
  double low = 0;
  for (const Point& p : scene.outline.outer) low = std::min(low, rotated(p, theta).y());
  scene.start = {-70, uniform(random, 0.5, 30) - low, theta};
  return scene;
}

inline double apart(const Configuration& a, const Configuration& b) {
  return std::hypot(a.x_mm - b.x_mm, a.y_mm - b.y_mm, 10 * (a.theta_rad - b.theta_rad));
}

// What a watch sees of a path.
struct Seen {
  double least_mm = 1e300;     // clearance
  double least_drive = 1e300;  // force . displacement between samples: the work of the drive
  int samples = 0, stretches = 0;
  bool joined = true;  // every stretch begins where the last ended
};

inline Projection watched(const MovingShape& part, const Obstacles& obstacles, const Scene& scene, Seen& seen,
                          int samples = 20) {
  ProjectionOptions options;
  options.max_branching = 0;  // branches would begin anew
  std::optional<Configuration> before;
  options.watch = [&](const PathStretch& stretch) -> std::optional<double> {
    ++seen.stretches;
    Configuration last = stretch.at(0);
    if (before && apart(*before, last) > 1e-6) seen.joined = false;
    for (int i = 0; i <= samples; ++i) {
      const Configuration q = stretch.at(static_cast<double>(i) / samples);
      ++seen.samples;
      seen.least_mm = std::min(seen.least_mm, clearance_mm(part, obstacles, q));
      seen.least_drive = std::min(seen.least_drive, scene.drive.force.dot(q.position() - last.position()));
      last = q;
    }
    before = last;
    return std::nullopt;
  };
  return project(part, obstacles, scene.drive, scene.start, options);
}

inline bool same_end(const Projection& a, const Projection& b, double tolerance) {
  if (a.end != b.end) return false;
  return apart(a.last, b.last) <= tolerance && (a.last_twist.linear - b.last_twist.linear).norm() <= tolerance;
}

}  // namespace formotion::worlds
