// Seeded parts among obstacles, and placements of them that touch, nearly touch, and overlap; how the contact queries
// compare with the exact witnesses there.
#pragma once

#include "analysis/contact/clearance.hpp"
#include "witness/random_shapes.hpp"

namespace formotion::witness {

struct ContactScene {
  MovingShape part;
  Obstacles obstacles;
  std::vector<Polygon> drawn;  // the obstacles before growing
  double grow_mm = 0;
  std::vector<std::pair<Point, double>> pins;  // centre, radius
};

// Polygons of up to ten corners, some with a hole, a second body or many reflex corners, about 100 mm apart at most.
ContactScene random_scene(Random& random);
// Everything on a grid of whole mm, parts that fit between obstacles without clearance among them.
ContactScene grid_scene(Random& random);
// Grown polygons and pins beside a random scene's polygons.
ContactScene round_scene(Random& random, bool pins);

// Anywhere; or touching (a random place of a random facet: half of them at an end, so that corners meet corners and
// edges lie on edges); or that, moved along the normal by 10^-k mm, k from 1 to 13.
Configuration random_placement(Random& random, const ContactScene& scene);
// On the grid, turned by a multiple of 90 degrees.
Configuration grid_placement(Random& random, const ContactScene& scene);

struct Agreement {
  long placements = 0, overlapping = 0, touching = 0, distances = 0, depths = 0;
  long unlike = 0;     // answers whose sign is not the exact one
  double band_mm = 0;  // of those: the largest exact distance or depth
  double distance_error_mm = 0, depth_error_mm = 0;
  void add(const Agreement& other);
};

// Compares clearance at a placement. The depth is only asked where `depths` says so (a Minkowski sum each), and where
// the sign is not the exact one.
Agreement compare_clearance(const ContactScene& scene, const Configuration& q, bool depths);

// The signed distance to the boundary of the configuration-space obstacle, > 0 outside. Sharp obstacles only.
double minkowski_clearance(const ContactScene& scene, const Configuration& q);

}  // namespace formotion::witness
