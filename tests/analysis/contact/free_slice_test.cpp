#include "analysis/contact/free_slice.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "analysis/contact/clearance.hpp"
#include "analysis/geometry/boolean.hpp"
#include "witness/minkowski.hpp"
#include "witness/minkowski_scenes.hpp"

using namespace formotion;

namespace {

constexpr double kPi = std::numbers::pi;

Point middle_of(const SlicePiece& piece) {
  if (piece.radius_mm == 0) return (piece.from + piece.to) / 2;
  const double angle = piece.from_rad + piece.width_rad / 2;
  return piece.centre + piece.radius_mm * Point(std::cos(angle), std::sin(angle));
}

double distance_to(const SlicePiece& piece, const Point& p) {
  if (piece.radius_mm == 0) return distance_to_segment(p, piece.from, piece.to);
  const Point off = p - piece.centre;
  if (DirectionRange{piece.from_rad, piece.width_rad}.contains(std::atan2(off.y(), off.x())))
    return std::abs(off.norm() - piece.radius_mm);
  return std::min((p - piece.from).norm(), (p - piece.to).norm());
}

double distance_to(const FreeSlice& slice, const Point& p) {
  double least = 1e300;
  for (const SlicePiece& piece : slice.pieces) least = std::min(least, distance_to(piece, p));
  return least;
}

double distance_to(const std::vector<Polygon>& areas, const Point& p) {
  double least = 1e300;
  for (const Loop& loop : loops_of(areas)) {
    for (std::size_t i = 0; i < loop.size(); ++i)
      least = std::min(least, distance_to_segment(p, loop[i], loop[(i + 1) % loop.size()]));
  }
  return least;
}

std::vector<Polygon> obstacle_at(const witness::ContactScene& scene, double theta) {
  std::vector<Polygon> turned;
  for (const Polygon& body : scene.part.bodies) turned.push_back(placed(body, theta, Point::Zero()));
  return witness::configuration_obstacle(turned, scene.obstacles.areas);
}

double length_of(const std::vector<Polygon>& areas) {
  double length = 0;
  for (const Loop& loop : loops_of(areas)) {
    for (std::size_t i = 0; i < loop.size(); ++i) length += (loop[(i + 1) % loop.size()] - loop[i]).norm();
  }
  return length;
}

double length_of(const FreeSlice& slice) {
  double length = 0;
  for (const SlicePiece& piece : slice.pieces)
    length += piece.radius_mm == 0 ? (piece.to - piece.from).norm() : piece.radius_mm * piece.width_rad;
  return length;
}

}  // namespace

TEST_CASE("slices are the boundaries of exact Minkowski sums, both ways: 250 parts with holes among obstacles") {
  witness::Random random(1);
  int compared = 0;
  for (int i = 0; i < 250; ++i) {
    const witness::ContactScene scene = witness::random_scene(random);
    const double theta = witness::uniform(random, -4, 4);
    const FreeSlice slice = free_slice(scene.part, scene.obstacles, theta);
    const std::vector<Polygon> areas = obstacle_at(scene, theta);
    CAPTURE(i, theta);
    for (const Loop& loop : loops_of(areas)) {
      for (std::size_t k = 0; k < loop.size(); ++k) {
        for (const double t : {0.0, 0.21, 0.5, 0.83}) {
          REQUIRE(distance_to(slice, loop[k] + t * (loop[(k + 1) % loop.size()] - loop[k])) < 1e-7);
        }
      }
    }
    for (const SlicePiece& piece : slice.pieces) {
      for (const Point& p : {piece.from, piece.to, middle_of(piece)}) REQUIRE(distance_to(areas, p) < 1e-7);
      ++compared;
    }
    REQUIRE(length_of(slice) == Approx(length_of(areas)).epsilon(1e-7));
  }
  CHECK(compared > 4000);
}

TEST_CASE("on a grid slices hold the regularised boundary, and what is more of them touches on both sides") {
  witness::Random random(2);
  int slots = 0, alone = 0;
  for (int i = 0; i < 400; ++i) {
    const witness::ContactScene scene = witness::grid_scene(random);
    const double theta = witness::below(random, 4) * kPi / 2;
    const FreeSlice slice = free_slice(scene.part, scene.obstacles, theta);
    const std::vector<Polygon> areas = obstacle_at(scene, theta);
    CAPTURE(i, theta);
    for (const Loop& loop : loops_of(areas)) {
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const Point span = loop[(k + 1) % loop.size()] - loop[k];
        if (span.norm() < 1e-6) continue;  // slivers that rounding of the turned part leaves
        for (const double t : {0.21, 0.5, 0.83}) REQUIRE(distance_to(slice, loop[k] + t * span) < 1e-6);
      }
    }
    for (const SlicePiece& piece : slice.pieces) {
      const Point p = middle_of(piece);
      REQUIRE(clearance_mm(scene.part, scene.obstacles, {p.x(), p.y(), theta}) == 0);
      const bool lone = piece.from == piece.to;
      alone += lone;
      if (lone || distance_to(areas, p) < 1e-6) continue;
      ++slots;
      const auto contacts = contacts_at(scene.part, scene.obstacles, {p.x(), p.y(), theta}, 1e-7);
      REQUIRE(std::any_of(contacts.begin(), contacts.end(),
                          [&](const Contact& c) { return c.state.normal.dot(contacts[0].state.normal) < -0.999; }));
    }
  }
  CHECK(slots > 50);
  CHECK(alone > 20);
}

TEST_CASE("each piece touches by its own contact, is free, and has its free side on the right") {
  witness::Random random(3);
  int arcs = 0;
  for (int i = 0; i < 150; ++i) {
    const witness::ContactScene scene =
        i % 3 == 0 ? witness::random_scene(random) : witness::round_scene(random, i % 3 == 1);
    const double theta = witness::uniform(random, -4, 4), c = std::cos(theta), s = std::sin(theta);
    const FreeSlice slice = free_slice(scene.part, scene.obstacles, theta);
    REQUIRE_FALSE(slice.pieces.empty());
    for (const SlicePiece& piece : slice.pieces) {
      const Point p = middle_of(piece);
      arcs += piece.radius_mm > 0;
      const ContactState state = contact_state(scene.part, scene.obstacles, piece.pair, p, c, s);
      CAPTURE(i, static_cast<int>(piece.pair.kind));
      REQUIRE(std::abs(state.gap_mm) < 1e-10);
      const double along = 0.5 * (piece.along.from_mm + piece.along.to_mm);
      REQUIRE((configuration_on(scene.part, scene.obstacles, piece.pair, theta, along).position() - p).norm() < 1e-9);
      REQUIRE(clearance_mm(scene.part, scene.obstacles, {p.x(), p.y(), theta}) == 0);
      const double length = (piece.to - piece.from).norm();
      if (length < 1e-3) continue;
      const Point step = 1e-6 * state.normal;
      REQUIRE(cross(piece.to - piece.from, state.normal) < 0);
      REQUIRE(is_free(scene.part, scene.obstacles, {p.x() + step.x(), p.y() + step.y(), theta}));
      REQUIRE_FALSE(is_free(scene.part, scene.obstacles, {p.x() - step.x(), p.y() - step.y(), theta}));
    }
  }
  CHECK(arcs > 100);
}

TEST_CASE("slices among pins and grown polygons lie between those of polygons inside and outside of them") {
  witness::Random random(4);
  for (int i = 0; i < 40; ++i) {
    const witness::ContactScene scene = witness::round_scene(random, true);
    const double theta = witness::uniform(random, -4, 4);
    const FreeSlice slice = free_slice(scene.part, scene.obstacles, theta);
    const int n = 96;
    const auto polygons = [&](double stretch) {
      std::vector<Polygon> turned, discs;
      for (const Polygon& body : scene.part.bodies) turned.push_back(placed(body, theta, Point::Zero()));
      for (const auto& [centre, radius] : scene.pins) {
        Loop disc;
        for (int k = 0; k < n; ++k)
          disc.push_back(centre + stretch * radius * Point(std::cos(2 * kPi * k / n), std::sin(2 * kPi * k / n)));
        discs.push_back({disc, {}});
      }
      return witness::configuration_obstacle(turned, discs);
    };
    const std::vector<Polygon> inner = polygons(1), outer = polygons(1 / std::cos(kPi / n));
    const auto is_in = [](const std::vector<Polygon>& areas, const Point& p, double tolerance) {
      return std::any_of(areas.begin(), areas.end(),
                         [&](const Polygon& area) { return locate(area, p, tolerance) == Side::Inside; });
    };
    CAPTURE(i, theta);
    for (const SlicePiece& piece : slice.pieces) {
      for (const Point& p : {piece.from, piece.to, middle_of(piece)}) {
        REQUIRE_FALSE(is_in(inner, p, 1e-9));
        REQUIRE((is_in(outer, p, 0) || distance_to(outer, p) < 1e-9));
      }
    }
    // Nothing of the boundary is missing: it passes every corner of the inner polygons as near as these err.
    for (const Loop& loop : loops_of(inner)) {
      for (const Point& p : loop) REQUIRE(distance_to(slice, p) < 0.5);
    }
  }
}

TEST_CASE("the nearest boundary is the whole slice's nearest point") {
  witness::Random random(5);
  for (int i = 0; i < 400; ++i) {
    const witness::ContactScene scene = i % 4 == 0   ? witness::random_scene(random)
                                        : i % 4 == 1 ? witness::grid_scene(random)
                                                     : witness::round_scene(random, i % 4 == 2);
    const double theta = i % 4 == 1 ? witness::below(random, 4) * kPi / 2 : witness::uniform(random, -4, 4);
    const Point p(witness::uniform(random, -60, 60), witness::uniform(random, -60, 60));
    const auto nearest = nearest_boundary(scene.part, scene.obstacles, theta, p);
    REQUIRE(nearest);
    const FreeSlice slice = free_slice(scene.part, scene.obstacles, theta);
    CAPTURE(i);
    REQUIRE((nearest->position - p).norm() == Approx(distance_to(slice, p)).margin(1e-7));
  }
  CHECK_FALSE(nearest_boundary(witness::random_scene(random).part, Obstacles{}, 0, {0, 0}));
}

TEST_CASE("a bar passes a right-angled corner of corridors iff it is shorter than (a^(2/3) + b^(2/3))^(3/2)") {
  // The middle of the bar with both ends on the outer walls, over all turns: free all the way, or not.
  const double a = 3, b = 5, longest = std::pow(std::pow(a, 2.0 / 3) + std::pow(b, 2.0 / 3), 1.5);
  const Obstacles corridors = *make_obstacles({{{rectangle(-90, -20, 100, 0), {}}, 0, false},
                                               {{rectangle(-90, 0, 0, 100), {}}, 0, false},
                                               {{rectangle(a, b, 100, 100), {}}, 0, false}});
  const double thin = 1e-7;
  for (const double length : {longest - 1e-4, longest + 1e-4}) {
    const MovingShape bar = MovingShape::of({{rectangle(-length / 2, -thin, length / 2, thin), {}}}, 3);
    bool passes = true;
    for (int i = 1; i < 4000 && passes; ++i) {
      const double theta = -kPi / 2 * i / 4000;
      const Point middle = 0.5 * length * Point(std::cos(theta), -std::sin(theta)) + Point(thin, thin) * 2;
      passes = is_free(bar, corridors, {middle.x(), middle.y(), theta});
    }
    CHECK(passes == (length < longest));
  }
}
