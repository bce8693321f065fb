#include "witness/minkowski_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/contact/facets.hpp"
#include "analysis/geometry/boolean.hpp"
#include "witness/minkowski.hpp"

namespace formotion::witness {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRounding_mm = 1e-12;
constexpr double kSlot_mm = 1e-3;  // slivers are not that deep, but in slots

Polygon gear(Random& random, double size) {
  const int n = 2 * (3 + below(random, 3));
  Loop loop;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * kPi * (i + uniform(random, -0.2, 0.2)) / n, r = size * (i % 2 ? 0.4 : 1);
    loop.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  return normalised({loop, {}});
}

Polygon some_polygon(Random& random, double size) {
  if (below(random, 3) == 0) return gear(random, size);
  Polygon polygon = random_polygon(random, size);
  if (below(random, 3) == 0) {
    polygon.holes.push_back(placed(random_polygon(random, 0.2 * size), 0, {0, 0}).outer);
    std::reverse(polygon.holes[0].begin(), polygon.holes[0].end());
    if (defect(polygon)) polygon.holes.clear();
  }
  return polygon;
}

std::vector<Polygon> placed_bodies(const ContactScene& scene, const Configuration& q) {
  std::vector<Polygon> bodies;
  for (const Polygon& body : scene.part.bodies) bodies.push_back(placed(body, q.theta_rad, q.position()));
  return bodies;
}

double boundary_distance(const std::vector<Polygon>& areas, const Point& p) {
  double least = 1e300;
  for (const Loop& loop : loops_of(areas)) {
    for (std::size_t i = 0; i < loop.size(); ++i)
      least = std::min(least, distance_to_segment(p, loop[i], loop[(i + 1) % loop.size()]));
  }
  return least;
}

}  // namespace

ContactScene random_scene(Random& random) {
  ContactScene scene;
  std::vector<Polygon> bodies{some_polygon(random, uniform(random, 5, 50))};
  if (below(random, 5) == 0) {
    const Box box = bounding_box(bodies[0].outer);
    bodies.push_back(placed(random_polygon(random, 10), 0, {box.max.x() + uniform(random, 5, 15), 0}));
  }
  scene.part = MovingShape::of(bodies, 10);
  std::vector<ObstacleShape> shapes;
  for (int i = 1 + below(random, 3); i > 0; --i) {
    const Point at(uniform(random, -50, 50), uniform(random, -50, 50));
    shapes.push_back({placed(some_polygon(random, uniform(random, 5, 50)), 0, at), 0, false});
  }
  scene.obstacles = *make_obstacles(shapes);
  scene.drawn = scene.obstacles.areas;
  return scene;
}

ContactScene grid_scene(Random& random) {
  ContactScene scene;
  const int size = 2 + below(random, 8);
  const Polygon drawn = grid_polygon(random, size);
  const Polygon part =
      placed(drawn, 0, {-static_cast<double>(below(random, 4)), -static_cast<double>(below(random, 4))});
  scene.part = MovingShape::of({part}, 5);
  std::vector<ObstacleShape> shapes;
  if (below(random, 3) == 0) {  // a block with the part's own shape cut out of it
    const Box box = bounding_box(part.outer);
    Loop around = rectangle(box.min.x() - 2, box.min.y() - 2, box.max.x() + 2, box.max.y() + 2);
    Loop cut = part.outer;
    std::reverse(cut.begin(), cut.end());
    shapes.push_back({{around, {cut}}, 0, false});
    if (below(random, 2)) {  // a slot of the part's width instead
      around = rectangle(box.min.x() - 9, box.min.y() - 2, box.max.x() + 9, box.min.y());
      shapes[0].area = {around, {}};
      shapes.push_back({{rectangle(box.min.x() - 9, box.max.y(), box.max.x() + 9, box.max.y() + 2), {}}, 0, false});
    }
  } else {
    for (int i = 1 + below(random, 3); i > 0; --i) {
      const Point at(below(random, 14) - 7, below(random, 14) - 7);
      shapes.push_back({placed(grid_polygon(random, 8), 0, at), 0, false});
    }
  }
  scene.obstacles = *make_obstacles(shapes);
  scene.drawn = scene.obstacles.areas;
  return scene;
}

ContactScene round_scene(Random& random, bool pins) {
  ContactScene scene = random_scene(random);
  std::vector<ObstacleShape> shapes;
  if (pins) {
    scene.drawn.clear();
    for (int i = 1 + below(random, 2); i > 0; --i) {
      const Point at(uniform(random, -50, 50), uniform(random, -50, 50));
      scene.pins.emplace_back(at, uniform(random, 1, 20));
      shapes.push_back({{{at}, {}}, scene.pins.back().second, false});
    }
  } else {
    for (const Polygon& area : scene.drawn) shapes.push_back({area, 0, false});
    scene.grow_mm = uniform(random, 0.1, 5);
  }
  scene.obstacles = *make_obstacles(shapes, scene.grow_mm);
  return scene.obstacles.round_exactly ? scene
                                       : round_scene(random, pins);  // boundaries that growing shuts are not exact
}

Configuration random_placement(Random& random, const ContactScene& scene) {
  Configuration q{uniform(random, -110, 110), uniform(random, -110, 110), uniform(random, -10, 10)};
  const std::vector<ContactPair> pairs = contact_pairs(scene.part, scene.obstacles);
  const int way = below(random, 4);
  if (way == 0) return q;
  const ContactPair& pair = pairs[static_cast<std::size_t>(below(random, static_cast<int>(pairs.size())))];
  const DirectionRange range = *contact_orientations(scene.part, scene.obstacles, pair);
  const auto fraction = [&] { return below(random, 2) ? uniform(random, 0, 1) : below(random, 2); };
  q.theta_rad = range.from_rad + fraction() * range.width_rad;
  const std::vector<AlongRange> ranges = along_ranges(scene.part, scene.obstacles, pair, q.theta_rad);
  if (ranges.empty()) return q;
  const double along = std::lerp(ranges[0].from_mm, ranges[0].to_mm, fraction());
  q = configuration_on(scene.part, scene.obstacles, pair, q.theta_rad, along);
  if (way == 1) return q;
  const ContactState state =
      contact_state(scene.part, scene.obstacles, pair, q.position(), std::cos(q.theta_rad), std::sin(q.theta_rad));
  const double off = std::pow(10.0, -1 - below(random, 13)) * (way == 2 ? 1 : -1);
  q.x_mm += off * state.normal.x();
  q.y_mm += off * state.normal.y();
  return q;
}

Configuration grid_placement(Random& random, const ContactScene&) {
  const double places[] = {0, 0, 0, 0.5, 0.25};
  const double fine = places[below(random, 5)];
  return {below(random, 19) - 9 + fine, below(random, 19) - 9.0, below(random, 4) * kPi / 2};
}

void Agreement::add(const Agreement& other) {
  placements += other.placements;
  overlapping += other.overlapping;
  touching += other.touching;
  distances += other.distances;
  depths += other.depths;
  unlike += other.unlike;
  band_mm = std::max(band_mm, other.band_mm);
  distance_error_mm = std::max(distance_error_mm, other.distance_error_mm);
  depth_error_mm = std::max(depth_error_mm, other.depth_error_mm);
}

double minkowski_clearance(const ContactScene& scene, const Configuration& q) {
  std::vector<Polygon> turned;
  for (const Polygon& body : scene.part.bodies) turned.push_back(placed(body, q.theta_rad, Point::Zero()));
  const std::vector<Polygon> areas = configuration_obstacle(turned, scene.obstacles.areas);
  const bool in = std::any_of(areas.begin(), areas.end(),
                              [&](const Polygon& area) { return locate(area, q.position(), 0) == Side::Inside; });
  return (in ? -1 : 1) * boundary_distance(areas, q.position());
}

Agreement compare_clearance(const ContactScene& scene, const Configuration& q, bool depths) {
  Agreement result;
  result.placements = 1;
  const double found = clearance_mm(scene.part, scene.obstacles, q);
  const std::vector<Polygon> bodies = placed_bodies(scene, q);
  double distance = 1e300;
  bool overlap = false;
  if (!scene.drawn.empty()) {
    overlap = interiors_meet(bodies, scene.drawn);
    distance = overlap ? 0 : exact_distance(bodies, scene.drawn) - scene.grow_mm;
  }
  for (const auto& [centre, radius] : scene.pins) {
    const bool in = std::any_of(bodies.begin(), bodies.end(),
                                [&, at = centre](const Polygon& body) { return locate(body, at, 0) == Side::Inside; });
    overlap = overlap || in;
    distance = std::min(distance, boundary_distance(bodies, centre) - radius);
  }
  overlap = overlap || distance < 0;
  result.overlapping = overlap;
  result.touching = std::abs(found) <= 1e-9;
  const bool sharp = scene.grow_mm == 0 && scene.pins.empty();
  if (overlap != (found < 0)) {
    result.unlike = 1;
    // Grown shapes and pins: how far the boundaries pass each other bounds the depth from above, and is it where a
    // round corner dips in.
    double off = std::abs(distance);
    if (overlap && sharp) {
      // In a slot without clearance rounding alone makes an overlap from which only the slot's end leads out: the
      // sliver's width then says how wrong the answer is.
      off = overlap_width(bodies, scene.drawn);
      const double depth = off > kRounding_mm ? -minkowski_clearance(scene, q) : 0;
      if (depth < kSlot_mm) off = std::max(off, depth);
    }
    result.band_mm = std::max({0.0, off, -found});
  } else if (!overlap) {
    result.distances = 1;
    result.distance_error_mm = std::abs(found - distance);
  } else if (depths && sharp) {
    result.depths = 1;
    result.depth_error_mm = std::abs(found - minkowski_clearance(scene, q));
  }
  return result;
}

}  // namespace formotion::witness
