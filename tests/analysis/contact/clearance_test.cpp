#include "analysis/contact/clearance.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "analysis/contact/facets.hpp"
#include "analysis/geometry/boolean.hpp"
#include "witness/minkowski_scenes.hpp"

using namespace formotion;

namespace {

constexpr double kBand_mm = 1.002e-9;  // kTouching_mm, and rounding
constexpr double kPi = std::numbers::pi;

Obstacles obstacles_of(const std::vector<Polygon>& areas) {
  std::vector<ObstacleShape> shapes;
  for (const Polygon& area : areas) shapes.push_back({area, 0, false});
  return *make_obstacles(shapes);
}

MovingShape square(double half) { return MovingShape::of({{rectangle(-half, -half, half, half), {}}}, half); }

template <typename Scene, typename Placement>
witness::Agreement compare_many(std::uint64_t seed, int count, int each_depth, const Scene& scene_of,
                                const Placement& placement_of) {
  witness::Random random(seed);
  witness::Agreement total;
  witness::ContactScene scene;
  for (int i = 0; i < count; ++i) {
    if (i % 20 == 0) scene = scene_of(random);
    const Configuration q = placement_of(random, scene);
    const witness::Agreement one = witness::compare_clearance(scene, q, each_depth > 0 && i % each_depth == 7);
    CAPTURE(i, q.x_mm, q.y_mm, q.theta_rad);
    REQUIRE(one.band_mm <= kBand_mm);
    REQUIRE(one.distance_error_mm <= kBand_mm);
    REQUIRE(one.depth_error_mm <= kBand_mm);
    total.add(one);
  }
  return total;
}

}  // namespace

TEST_CASE("clearance is the exact distance, or minus the exact depth: 20,000 placements that touch, nearly or not") {
  const auto anywhere = [](auto& random, const auto& scene) { return witness::random_placement(random, scene); };
  const witness::Agreement sharp = compare_many(
      11, 8000, 40, [](auto& random) { return witness::random_scene(random); }, anywhere);
  CHECK(sharp.overlapping > 2000);
  CHECK(sharp.touching > 1000);
  CHECK(sharp.distances > 2000);
  CHECK(sharp.depths > 80);
  const witness::Agreement grid = compare_many(
      12, 6000, 0, [](auto& random) { return witness::grid_scene(random); },
      [](auto& random, const auto& scene) { return witness::grid_placement(random, scene); });
  CHECK(grid.touching > 300);
  CHECK(grid.overlapping > 1000);
  for (const bool pins : {false, true}) {
    const witness::Agreement round = compare_many(
        13, 3000, 0, [&](auto& random) { return witness::round_scene(random, pins); }, anywhere);
    CHECK(round.touching > 300);
    CHECK(round.overlapping > 500);
  }
}

TEST_CASE("moving an overlapping part by its depth leaves it in contact, and less does not") {
  witness::Random random(3);
  int moved = 0;
  for (int i = 0; i < 600; ++i) {
    const witness::ContactScene scene = i % 3 == 0   ? witness::round_scene(random, i % 2)
                                        : i % 3 == 1 ? witness::grid_scene(random)
                                                     : witness::random_scene(random);
    const Configuration q =
        i % 3 == 1 ? witness::grid_placement(random, scene) : witness::random_placement(random, scene);
    const Clearance found = clearance(scene.part, scene.obstacles, q);
    REQUIRE(is_free(scene.part, scene.obstacles, q) == (found.mm >= 0));
    if (found.mm > -1e-6) continue;
    ++moved;
    const Point out = found.on_obstacles - found.on_part;
    CAPTURE(i, found.mm);
    REQUIRE(out.norm() == Approx(-found.mm).epsilon(1e-9));
    const auto at = [&](const Point& by) {
      return clearance_mm(scene.part, scene.obstacles, {q.x_mm + by.x(), q.y_mm + by.y(), q.theta_rad});
    };
    REQUIRE(at(out) == 0);
    // No shorter translation helps, in 24 directions.
    for (int k = 0; k < 24; ++k) {
      const double angle = k * kPi / 12;
      REQUIRE(at(0.999 * out.norm() * Point(std::cos(angle), std::sin(angle))) < 0);
    }
  }
  CHECK(moved > 150);
}

TEST_CASE("the nearest points are on part and obstacles, clearance apart") {
  const MovingShape part = square(5);
  const Obstacles obstacles = obstacles_of({{rectangle(20, -3, 30, 3), {}}});
  const Clearance found = clearance(part, obstacles, {0, 0, 0});
  CHECK(found.mm == Approx(15));
  CHECK(found.on_part.x() == 5);
  CHECK(found.on_obstacles.x() == 20);
  CHECK(clearance_mm(part, obstacles, {24, 0, 0}) == Approx(-8));  // out upwards, not back
  CHECK(std::isinf(clearance_mm(part, Obstacles{}, {0, 0, 0})));
}

TEST_CASE("a part inside a frame's hole is free, over its bar it is not") {
  Loop hole = rectangle(-10, -10, 10, 10);
  std::reverse(hole.begin(), hole.end());
  const Obstacles frame = obstacles_of({{rectangle(-20, -20, 20, 20), {hole}}});
  CHECK(clearance_mm(square(5), frame, {0, 0, 0}) == Approx(5));
  CHECK(clearance_mm(square(5), frame, {15, 0, 0}) == Approx(-10));
  CHECK(clearance_mm(square(15), frame, {0, 0, 0}) == Approx(-35));
  // The part is the frame, the obstacle a hub in it.
  const MovingShape ring = MovingShape::of({{rectangle(-20, -20, 20, 20), {hole}}}, 20);
  const Obstacles hub = obstacles_of({{rectangle(-4, -4, 4, 4), {}}});
  CHECK(clearance_mm(ring, hub, {0, 0, 0}) == Approx(6));
  CHECK(clearance_mm(ring, hub, {6, 0, 0}) == 0);
  CHECK(clearance_mm(ring, hub, {7, 0, 0}) == Approx(-1));
}

TEST_CASE("zero clearance is free: in a slot, in a pocket, at every coincidence of edges") {
  const Obstacles slot = obstacles_of({{rectangle(-50, 5, 50, 20), {}}, {rectangle(-50, -20, 50, -5), {}}});
  CHECK(clearance_mm(square(5), slot, {3.3, 0, 0}) == 0);
  CHECK(clearance_mm(square(5), slot, {3.3, 0, kPi / 2}) == 0);
  CHECK(clearance_mm(square(5), slot, {3.3, 1e-6, 0}) == Approx(-1e-6));  // back into the slot
  CHECK(clearance_mm(square(5), slot, {3.3, 0, 1e-3}) < -1);              // only out of the slot
  Loop hole = rectangle(-5, -5, 5, 5);
  std::reverse(hole.begin(), hole.end());
  const Obstacles pocket = obstacles_of({{rectangle(-40, -40, 40, 40), {hole}}});
  CHECK(clearance_mm(square(5), pocket, {0, 0, 0}) == 0);
  CHECK(clearance_mm(square(5), pocket, {3, 4, 0}) == Approx(-5));  // to the only place where it fits
  CHECK(clearance_mm(square(5), obstacles_of({{rectangle(-5, -5, 5, 5), {}}}), {0, 0, 0}) == Approx(-10));
}

TEST_CASE("a wall of 20 m decides as finely as a short one, anywhere along it") {
  witness::Random random(8);
  const Obstacles wall = obstacles_of({{rectangle(-10000, -500, 10000, 0), {}}});
  for (int i = 0; i < 2000; ++i) {
    const MovingShape part = MovingShape::of({witness::random_polygon(random, 50)}, 20);
    const double theta = witness::uniform(random, -4, 4), x = witness::uniform(random, -9900, 9900);
    double low = 1e300;
    for (const MovingEdge& edge : part.edges) low = std::min(low, rotated(edge.from, theta).y());
    CHECK(clearance_mm(part, wall, {x, -low, theta}) == 0);
    CHECK(clearance_mm(part, wall, {x, -low + 3e-9, theta}) == Approx(3e-9).margin(1e-10));
    CHECK(clearance_mm(part, wall, {x, -low - 3e-9, theta}) == Approx(-3e-9).margin(1e-10));
  }
}

TEST_CASE("moving everything, and mirroring everything, changes no clearance") {
  witness::Random random(9);
  for (int i = 0; i < 400; ++i) {
    const witness::ContactScene scene = i % 2 ? witness::random_scene(random) : witness::grid_scene(random);
    const Configuration q = i % 2 ? witness::random_placement(random, scene) : witness::grid_placement(random, scene);
    const double here = clearance_mm(scene.part, scene.obstacles, q);
    const double turn = witness::uniform(random, -3, 3);
    const Point offset(witness::uniform(random, -80, 80), witness::uniform(random, -80, 80));
    std::vector<ObstacleShape> moved, mirrored;
    for (const Polygon& area : scene.obstacles.areas) {
      moved.push_back({placed(area, turn, offset), 0, false});
      mirrored.push_back({mirrored_x(area), 0, false});
    }
    const Point p = rotated(q.position(), turn) + offset;
    std::vector<Polygon> bodies;
    for (const Polygon& body : scene.part.bodies) bodies.push_back(mirrored_x(body));
    CAPTURE(i, here);
    // The union's grid moves corners by 1e-9 mm; in slots without clearance that shuts them.
    if (here == 0 || std::abs(here) < 1e-8 || i % 2 == 0) {
      REQUIRE(clearance_mm(MovingShape::of(bodies, 1), *make_obstacles(mirrored), {-q.x_mm, q.y_mm, -q.theta_rad}) ==
              Approx(here).margin(5e-9));
      continue;
    }
    REQUIRE(clearance_mm(scene.part, *make_obstacles(moved), {p.x(), p.y(), q.theta_rad + turn}) ==
            Approx(here).margin(5e-9));
  }
}

TEST_CASE("contacts are listed once for each place and normal") {
  const MovingShape part = square(5);
  const Obstacles floor = obstacles_of({{rectangle(-100, -50, 100, 0), {}}});
  const std::vector<Contact> flat = contacts_at(part, floor, {0, 5, 0}, 1e-6);
  REQUIRE(flat.size() == 2);  // both ends of the common stretch
  for (const Contact& contact : flat) {
    CHECK(contact.point.y() == Approx(0).margin(1e-9));
    CHECK(std::abs(contact.point.x()) == Approx(5));
    CHECK(contact.state.normal.y() == Approx(1));
  }
  const Obstacles step = obstacles_of({{rectangle(-3, -50, 100, 0), {}}});
  const std::vector<Contact> overhang = contacts_at(part, step, {0, 5, 0}, 1e-6);
  REQUIRE(overhang.size() == 2);
  CHECK(std::min(overhang[0].point.x(), overhang[1].point.x()) == Approx(-3));
  // Corner against corner: the facets on both sides, two normals.
  const std::vector<Contact> corners = contacts_at(part, step, {-8, 5, 0}, 1e-6);
  REQUIRE(corners.size() == 2);
  CHECK(corners[0].point.isApprox(corners[1].point));
  CHECK(std::abs(corners[0].state.normal.dot(corners[1].state.normal)) < 1e-9);
  const std::vector<Contact> pin = contacts_at(part, *make_obstacles({{{{{10, 0}}, {}}, 2, false}}), {3, 0.5, 0}, 1e-6);
  REQUIRE(pin.size() == 1);
  CHECK(pin[0].pair.kind == ContactKind::EdgeOnCorner);
  CHECK(pin[0].point.isApprox(Point(8, 0)));
  CHECK(contacts_at(part, floor, {0, 5.1, 0}, 1e-6).empty());
}

TEST_CASE("every touching placement lists the contact it was placed by") {
  witness::Random random(21);
  int placed_count = 0;
  for (int i = 0; i < 3000; ++i) {
    const witness::ContactScene scene =
        i % 2 ? witness::random_scene(random) : witness::round_scene(random, i % 4 == 0);
    const std::vector<ContactPair> pairs = contact_pairs(scene.part, scene.obstacles);
    const ContactPair pair = pairs[static_cast<std::size_t>(witness::below(random, static_cast<int>(pairs.size())))];
    const DirectionRange range = *contact_orientations(scene.part, scene.obstacles, pair);
    const double theta = range.from_rad + witness::uniform(random, 0.01, 0.99) * range.width_rad;
    const std::vector<AlongRange> ranges = along_ranges(scene.part, scene.obstacles, pair, theta);
    if (ranges.empty()) continue;
    const double along = std::lerp(ranges[0].from_mm, ranges[0].to_mm, witness::uniform(random, 0.01, 0.99));
    const Configuration q = configuration_on(scene.part, scene.obstacles, pair, theta, along);
    const std::vector<Contact> contacts = contacts_at(scene.part, scene.obstacles, q, 1e-7);
    CAPTURE(i);
    REQUIRE(std::any_of(contacts.begin(), contacts.end(), [&](const Contact& c) { return c.pair == pair; }));
    ++placed_count;
  }
  CHECK(placed_count > 2900);
}
