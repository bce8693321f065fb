// Random parts over random nests, and slow judges of rests that know nothing of slices: places tried at random about a
// rest, and drops without friction, followed by forward projection.
#pragma once

#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "analysis/contact/clearance.hpp"
#include "analysis/energy/rests.hpp"
#include "analysis/geometry/boolean.hpp"
#include "analysis/motion/projection.hpp"
#include "witness/random_shapes.hpp"

namespace formotion::witness {

struct RestScene {
  Polygon outline;  // about the centre of mass
  std::vector<ObstacleShape> shapes;
  double grow_mm = 0;
  Gravity gravity;
};

// Convex, star-shaped and grid parts, a third of them with the centre of mass off the centroid; stars, pins, a bent
// floor, perhaps walls, a third grown; gravity up to half a radian from -y. Every eighth on the grid throughout.
inline RestScene random_rest_scene(std::uint64_t seed) {
  Random random(seed);
  RestScene scene;
  const int kind = below(random, 4);
  const bool on_grid = kind == 3 && below(random, 2) == 0;
  Polygon part = kind == 3 ? grid_polygon(random, 12) : random_polygon(random, 10);
  if (kind == 0) part = {convex_hull(part.outer), {}};
  part = placed(part, 0, -area_moments(part).centroid);
  if (below(random, 3) == 0) part = placed(part, 0, {uniform(random, -2, 2), uniform(random, -2, 2)});
  scene.outline = part;
  const int count = 1 + below(random, 3);
  for (int i = 0; i < count; ++i) {
    const Polygon block =
        on_grid ? placed(grid_polygon(random, 14), 0, Point(below(random, 40) - 20, below(random, 14) - 7))
                : placed(random_polygon(random, 16), 0, Point(uniform(random, -22, 22), uniform(random, -8, 8)));
    scene.shapes.push_back({block, 0, false});
  }
  if (below(random, 3) == 0) {
    const Point centre(uniform(random, -15, 15), uniform(random, 0, 10));
    scene.shapes.push_back({{{centre}, {}}, uniform(random, 0.5, 4), false});
  }
  Loop floor = rectangle(-45, -30, 45, -10);
  if (!on_grid) {
    floor = {{-45, -30},
             {45, -30},
             {45, uniform(random, -14, -6)},
             {uniform(random, -10, 10), uniform(random, -18, -14)},
             {-45, uniform(random, -14, -6)}};
  }
  scene.shapes.push_back({{floor, {}}, 0, false});
  if (below(random, 2) == 0) {
    scene.shapes.push_back({{rectangle(-50, -30, -40, 40), {}}, 0, false});
    scene.shapes.push_back({{rectangle(40, -30, 50, 40), {}}, 0, false});
  }
  if (below(random, 3) == 0) scene.grow_mm = 0.25;
  const double tilt = on_grid ? 0 : uniform(random, -0.5, 0.5);
  scene.gravity.down = {std::sin(tilt), -std::cos(tilt)};
  return scene;
}

inline Configuration disturbed(Random& random, const Configuration& q, double by_mm, double reach_mm) {
  return {q.x_mm + uniform(random, -by_mm, by_mm), q.y_mm + uniform(random, -by_mm, by_mm),
          q.theta_rad + uniform(random, -by_mm, by_mm) / reach_mm};
}

// How many of `tries` free places within about by_mm of a rest are lower.
inline int lower_places(Random& random, const ContactSpace& space, const Gravity& gravity, const Rest& rest,
                        double by_mm, int tries) {
  int lower = 0;
  for (int i = 0; i < tries; ++i) {
    const Configuration q = disturbed(random, rest.at, by_mm, space.part.reach_mm);
    if (gravity.height_mm(q) < rest.height_mm - 1e-7 && is_free(space.part, space.obstacles, q)) ++lower;
  }
  return lower;
}

inline int rest_of(const std::vector<Rest>& rests, const Configuration& q, double reach_mm) {
  for (std::size_t i = 0; i < rests.size(); ++i) {
    if (rests[i].holds(q, reach_mm, 1e-4)) return static_cast<int>(i);
  }
  return -1;
}

// Where a part let go at a free place comes to rest; none where it leaves. An end that is not listed is disturbed a few
// times: it may be a saddle.
inline std::optional<Configuration> dropped(Random& random, const ContactSpace& space, const Gravity& gravity,
                                            const std::vector<Rest>& rests, const Configuration& start) {
  const Drive drive{gravity.down, 0};
  ProjectionOptions options;
  options.keep_path = false;
  Projection path = project(space, drive, start, options);
  for (int shake = 0; shake < 4; ++shake) {
    if (path.end == ProjectionEnd::Steady || path.end == ProjectionEnd::Undecided) break;
    if (path.end == ProjectionEnd::AtRest && rest_of(rests, path.last, space.part.reach_mm) >= 0) break;
    for (int i = 0; i < 50; ++i) {
      const Configuration q = disturbed(random, path.last, 2e-4, space.part.reach_mm);
      if (!is_free(space.part, space.obstacles, q)) continue;
      path = project(space, drive, q, options);
      break;
    }
  }
  if (path.end != ProjectionEnd::AtRest) return std::nullopt;
  return path.last;
}

}  // namespace formotion::witness
