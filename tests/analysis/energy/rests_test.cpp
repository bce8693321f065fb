// Rests of parts: closed forms, degenerate places, and random scenes against slow judges (rest_scenes.hpp).
#include "analysis/energy/rests.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "analysis/contact/clearance.hpp"
#include "analysis/energy/lowest_positions.hpp"
#include "witness/rest_scenes.hpp"

using namespace formotion;
using namespace formotion::witness;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180;

ObstacleShape block(const Loop& loop) { return {{loop, {}}, 0, false}; }
ObstacleShape disc(const Point& centre, double radius) { return {{{centre}, {}}, radius, false}; }
ObstacleShape floor_shape() { return block(rectangle(-100, -50, 100, 0)); }
Polygon centred(Polygon polygon) {
  polygon = normalised(std::move(polygon));
  return placed(polygon, 0, -area_moments(polygon).centroid);
}
Polygon regular(int n, double radius) {
  Loop loop;
  for (int i = 0; i < n; ++i) {
    loop.emplace_back(radius * std::cos(2 * kPi * i / n), radius * std::sin(2 * kPi * i / n));
  }
  return {loop, {}};
}
std::vector<ObstacleShape> vee() {  // of 90 degrees, its bottom at the origin
  return {block({{0, 0}, {0, -20}, {100, -20}, {100, 100}}), block({{0, 0}, {-100, 100}, {-100, -20}, {0, -20}})};
}
Gravity tilted(double by_rad) { return {{std::sin(by_rad), -std::cos(by_rad)}}; }

std::vector<Rest> rests_of(const Polygon& part, const std::vector<ObstacleShape>& shapes, const Gravity& gravity = {},
                           const RestOptions& options = {}, double grow_mm = 0) {
  const MovingShape moving = MovingShape::of({part}, 5);
  const Obstacles obstacles = *make_obstacles(shapes, grow_mm);
  return rests(ContactSpace(moving, obstacles), gravity, options);
}

std::vector<double> heights(const std::vector<Rest>& all) {
  std::vector<double> out;
  for (const Rest& rest : all) out.push_back(rest.height_mm);
  return out;
}
std::vector<double> angles_deg(const std::vector<Rest>& all) {
  std::vector<double> out;
  for (const Rest& rest : all) out.push_back(rest.at.theta_rad / kDegree);
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace

TEST_CASE("a square on a floor rests on each side as a level set", "[rests]") {
  const auto all = rests_of(centred({rectangle(0, 0, 10, 10), {}}), {floor_shape()});
  REQUIRE(all.size() == 4);
  for (int i = 0; i < 4; ++i) {
    const Rest& rest = all[i];
    CHECK(rest.height_mm == Approx(5).margin(1e-9));
    CHECK(rest.at.theta_rad == Approx(i * kPi / 2).margin(1e-9));
    CHECK(rest.contacts.size() == 2);
    REQUIRE(rest.set.size() == 2);  // its centre of mass over the floor
    CHECK(rest.set[0].x_mm == Approx(-100));
    CHECK(rest.set[1].x_mm == Approx(100));
    CHECK(rest.holds({99, 5, rest.at.theta_rad + 2 * kPi}, 8, 1e-6));
    CHECK_FALSE(rest.holds({99, 5, rest.at.theta_rad + 0.01}, 8, 1e-6));
    CHECK_FALSE(rest.holds({101, 5, rest.at.theta_rad}, 8, 1e-6));
  }
}

TEST_CASE("a floor that slopes holds nothing", "[rests]") {
  CHECK(rests_of(centred({rectangle(0, 0, 10, 10), {}}), {floor_shape()}, tilted(0.1)).empty());
}

TEST_CASE("a rectangle in a vee rests with two sides flat", "[rests]") {
  const double a = GENERATE(10.0, 20.0, 35.0), b = 10;
  const auto all = rests_of(centred({rectangle(0, 0, a, b), {}}), vee());
  REQUIRE(all.size() == 4);
  for (const Rest& rest : all) {
    CHECK(rest.height_mm == Approx((a + b) / 2 / std::sqrt(2)).margin(1e-9));
    CHECK(std::abs(rest.at.x_mm) == Approx((a - b) / 2 / std::sqrt(2)).margin(1e-9));
    CHECK(rest.set.empty());
  }
  const auto angles = angles_deg(all);
  for (int i = 0; i < 4; ++i) CHECK(angles[i] == Approx(45 + 90 * i).margin(1e-7));
}

TEST_CASE("a vee holds a square until gravity leaves its normals", "[rests]") {
  const Polygon square = centred({rectangle(0, 0, 10, 10), {}});
  const auto all = rests_of(square, vee(), tilted(kPi / 6));
  REQUIRE(all.size() == 4);
  for (const Rest& rest : all) {
    CHECK(rest.height_mm == Approx(5 * std::sqrt(2) * std::cos(kPi / 6)).margin(1e-9));
    CHECK(rest.at.position().isApprox(Point(0, 5 * std::sqrt(2)), 1e-9));
  }
  CHECK(rests_of(square, vee(), tilted(50 * kDegree)).empty());
}

TEST_CASE("a regular polygon with an odd number of sides rests twice a side in a vee", "[rests]") {
  // Flat on one side of the vee, on a corner on the other: the corner nearest to the direction 90 degrees off.
  const auto all = rests_of(regular(5, 6), vee());
  REQUIRE(all.size() == 10);
  for (const double h : heights(all)) {
    CHECK(h == Approx((6 * std::cos(36 * kDegree) + 6 * std::cos(18 * kDegree)) / std::sqrt(2)).margin(1e-9));
  }
}

TEST_CASE("a low centre of mass leaves fewer rests", "[rests]") {
  // A side holds if the foot of the perpendicular from the centre of mass lies within it. Sides level at theta 0.
  const double apothem = 6 * std::cos(kPi / 6), low = GENERATE(0.0, 0.3, 0.7, 0.95) * apothem;
  const Polygon part = placed(regular(6, 6), 0, {0, low});
  std::vector<double> expected;
  for (int i = 0; i < 6; ++i) {
    const double side = i * kPi / 3;  // from straight below the centre, as the part is given
    if (std::abs(low * std::sin(side)) < 3) expected.push_back(apothem - low * std::cos(side));
  }
  std::sort(expected.begin(), expected.end());
  const auto found = heights(rests_of(part, {floor_shape()}));
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) CHECK(found[i] == Approx(expected[i]).margin(1e-9));
  CHECK(found.size() == (low > 3 / std::sin(kPi / 3) ? 2 : 6));
}

TEST_CASE("a part in a slot without clearance rests at its bottom", "[rests]") {
  const auto all =
      rests_of(centred({rectangle(0, 0, 10, 10), {}}),
               {block(rectangle(-30, -5, 30, 0)), block(rectangle(-30, 0, -5, 30)), block(rectangle(5, 0, 30, 30))});
  const auto in_slot = std::count_if(all.begin(), all.end(), [](const Rest& rest) {
    return std::abs(rest.height_mm - 5) < 1e-9 && std::abs(rest.at.x_mm) < 1e-9 && rest.set.empty();
  });
  CHECK(in_slot == 4);
  // Over the mouth on a corner: the two sides at 45 degrees, the corner 5 below.
  const auto in_mouth = std::count_if(all.begin(), all.end(), [](const Rest& rest) {
    return std::abs(rest.height_mm - (30 - 5 + 5 * std::sqrt(2))) < 1e-9 && std::abs(rest.at.x_mm) < 1e-9;
  });
  CHECK(in_mouth == 4);
  const auto on_top = std::count_if(all.begin(), all.end(), [](const Rest& rest) {
    return std::abs(rest.height_mm - 35) < 1e-9 && rest.set.size() == 2;  // from -30 to -5, from 5 to 30
  });
  CHECK(on_top == 8);
  CHECK(all.size() == 16);
}

TEST_CASE("a frame on a peg hangs by the corners of its hole", "[rests]") {
  Polygon frame{rectangle(-10, -10, 10, 10), {{{-7, -7}, {-7, 7}, {7, 7}, {7, -7}}}};
  const auto all = rests_of(frame, {disc({3, 4}, 2)});
  REQUIRE(all.size() == 4);
  for (const Rest& rest : all) {
    CHECK(rest.height_mm == Approx(4 - (7 - 2) * std::sqrt(2)).margin(1e-9));
    CHECK(rest.at.x_mm == Approx(3).margin(1e-9));
    CHECK(rest.contacts.size() == 2);
  }
}

TEST_CASE("an open hook on a peg hangs below it in the corner of the hook", "[rests]") {
  const Polygon hook = centred({{{0, 0}, {20, 0}, {20, 30}, {0, 30}, {0, 25}, {15, 25}, {15, 5}, {0, 5}}, {}});
  const auto all = rests_of(hook, {disc({0, 0}, 2)});
  REQUIRE(all.size() == 2);  // on either arm
  // The peg's centre in the part's frame is 2 from both sides of the corner, and the centre of mass straight below it.
  const Point inner = hook.outer[0] + Point(15, 25) + Point(-2, -2);
  for (const Rest& rest : all) {
    CHECK(rest.height_mm == Approx(-inner.norm()).margin(1e-9));
    CHECK(rest.at.x_mm == Approx(0).margin(1e-8));
  }
}

TEST_CASE("a part that hangs by one corner on a shelf is at rest", "[rests]") {
  // Of a hook whose tip points down the tip is straight over the centre of mass, as far in as the shank allows.
  const Polygon hook = centred({{{0, 0}, {14, 0}, {14, 40}, {0, 40}, {3, 30}, {6, 36}, {11, 36}, {11, 3}, {0, 3}}, {}});
  const Point tip = hook.outer[4];
  const auto all = rests_of(hook, {block(rectangle(-60, -1, 0, 0))});
  const double turn = kPi / 2 - std::atan2(tip.y(), tip.x());  // the tip straight above
  const auto hangs = std::find_if(all.begin(), all.end(), [&](const Rest& rest) {
    return std::abs(std::remainder(rest.at.theta_rad - turn, 2 * kPi)) < 1e-9;
  });
  REQUIRE(hangs != all.end());
  CHECK(hangs->height_mm == Approx(-tip.norm()).margin(1e-9));
  CHECK(hangs->contacts.size() == 1);
  REQUIRE(hangs->set.size() == 2);
  CHECK(hangs->set[1].x_mm == Approx(0).margin(1e-9));
}

TEST_CASE("two feet on a level floor hold a part as an edge does", "[rests]") {
  const Polygon arch = centred({{{0, 0}, {3, 0}, {3, 8}, {12, 8}, {12, 2}, {15, 2}, {15, 11}, {0, 11}}, {}});
  const auto all = rests_of(arch, {floor_shape()});
  // The foot (3, 0) or (0, 0) and (15, 2): the hull's side from (3, 0) to (15, 2) lies level.
  const double turn = -std::atan2(2, 12);
  const bool found = std::any_of(all.begin(), all.end(), [&](const Rest& rest) {
    return std::abs(std::remainder(rest.at.theta_rad - turn, 2 * kPi)) < 1e-9 && rest.set.size() == 2;
  });
  CHECK(found);
  const Loop hull = convex_hull(arch.outer);  // the sides whose feet of perpendiculars lie within
  int sides = 0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Point a = hull[i], d = hull[(i + 1) % hull.size()] - a;
    sides += -a.dot(d) > 0 && -a.dot(d) < d.squaredNorm();
  }
  CHECK(static_cast<int>(all.size()) == sides);
}

TEST_CASE("a part that would topple is held between a floor and a ceiling", "[rests]") {
  // On its foot, the centre of mass to the left of it; turning that way would raise the top corner into the ceiling.
  const Polygon part = centred({{{0, 0}, {3, 10}, {-20, 5}}, {}});
  const auto all = rests_of(part, {floor_shape(), block(rectangle(-100, 10, 100, 30))});
  const auto held = std::find_if(all.begin(), all.end(), [](const Rest& rest) {
    return std::abs(std::remainder(rest.at.theta_rad, 2 * kPi)) < 1e-9;
  });
  REQUIRE(held != all.end());
  CHECK(held->height_mm == Approx(5).margin(1e-9));
  CHECK(held->set.size() == 2);
}

TEST_CASE("a part balanced on a point is at no rest", "[rests]") {
  CHECK(rests_of(regular(8, 6), {block({{0, 0}, {-20, -30}, {20, -25}})}).empty());
  CHECK(
      rests_of(regular(8, 6), {block({{0, 0}, {-20, -30}, {20, -25}})}, tilted(0.3), {5 * kDegree, 1e-6}, 0.3).empty());
}

TEST_CASE("a part that turns about its centre of mass at one height rests as one set", "[rests]") {
  const Polygon square = placed(Polygon{rectangle(0, 0, 10, 10), {}}, 0, {0, 0});  // centre of mass in a corner
  const auto all = rests_of(square, {floor_shape()});
  REQUIRE(all.size() == 1);
  CHECK(all[0].height_mm == Approx(0).margin(1e-9));
  REQUIRE(all[0].set.size() == 4);
  CHECK(all[0].holds({50, 0, kPi / 5}, 15, 1e-6));
  CHECK(all[0].holds({-50, 0, kPi / 2}, 15, 1e-6));
  CHECK_FALSE(all[0].holds({50, 0, kPi * 0.6}, 15, 1e-6));
}

// Its corner between stem and bar fits the rim's, and edges there are nearly parallel: the place is found to 4e-10 mm.
TEST_CASE("a tee hangs in a slot whose corners are a little off", "[rests]") {
  const Polygon tee = centred({{{0, 0}, {16, 0}, {16, 6}, {10.5, 6}, {10.5, 15}, {5.5, 15}, {5.5, 6}, {0, 6}}, {}});
  const Loop slot{{-12.019729817174918, -20.003276326333616}, {11.99489287304903, -19.983814312900712},
                  {11.986600045120102, -0.0148472626843028},  {2.8832158851525342, 0.004003057030665252},
                  {2.8978199253773473, -10.817523377021868},  {-2.8841095046389746, -10.783446259729732},
                  {-2.8969133845067576, 0.01597648056931509}, {-12.006793192911545, -0.0024472945566691596}};
  const auto off = [](const Rest& rest) {
    return std::hypot(rest.at.x_mm - 0.384477127, rest.at.y_mm - 0.615564683, 15 * (rest.at.theta_rad - 3.1395215598));
  };
  for (const double grid : {kDegree, 5 * kDegree}) {
    const std::vector<Rest> found = rests_of(tee, {block(slot)}, tilted(5 * kDegree), {grid});
    CHECK(std::any_of(found.begin(), found.end(), [&](const Rest& rest) { return off(rest) < 1e-6; }));
  }
}

TEST_CASE("rests turn with the world", "[rests]") {
  const double by = GENERATE(0.4, 2.0, 4.1);
  for (std::uint64_t seed = 900; seed < 904; ++seed) {
    const RestScene scene = random_rest_scene(seed);
    const auto before = rests_of(scene.outline, scene.shapes, scene.gravity, {0.05, 1e-6}, scene.grow_mm);
    std::vector<ObstacleShape> turned = scene.shapes;
    for (ObstacleShape& shape : turned) shape.area = placed(shape.area, by, {3, -2});
    const Gravity gravity{rotated(scene.gravity.down, by)};
    const auto after = rests_of(scene.outline, turned, gravity, {0.05, 1e-6}, scene.grow_mm);
    const double raised = gravity.height_mm(Point(3, -2));
    REQUIRE(before.size() == after.size());
    for (std::size_t i = 0; i < before.size(); ++i) {
      CHECK(after[i].height_mm == Approx(before[i].height_mm + raised).margin(1e-7));
    }
  }
}

TEST_CASE("nothing near a rest is lower and drops end in rests", "[rests]") {
  Random random(7);
  int dropped_count = 0, listed = 0, all_rests = 0, ends = 0;
  for (std::uint64_t seed = 500; seed < 512; ++seed) {
    const RestScene scene = random_rest_scene(seed);
    const MovingShape part = MovingShape::of({scene.outline}, 5);
    const Obstacles obstacles = *make_obstacles(scene.shapes, scene.grow_mm);
    const ContactSpace space(part, obstacles);
    const auto all = rests(space, scene.gravity, {5 * kDegree, 1e-6});
    all_rests += static_cast<int>(all.size());
    for (const Rest& rest : all) {
      INFO("seed " << seed << " height " << rest.height_mm << " theta " << rest.at.theta_rad);
      CHECK(is_free(part, obstacles, rest.at));
      CHECK(lower_places(random, space, scene.gravity, rest, 1e-2, 60) == 0);
      CHECK(lower_places(random, space, scene.gravity, rest, 1e-3, 60) == 0);
      for (const Configuration& q : rest.set) CHECK(scene.gravity.height_mm(q) == Approx(rest.height_mm).margin(1e-6));
    }
    for (int i = 0; i < 16; ++i) {
      const double height = i % 2 == 0 ? 60 : uniform(random, -20, 30), across = uniform(random, -40, 40);
      const Point p = across * turned_left(scene.gravity.down) - height * scene.gravity.down;
      const Configuration start{p.x(), p.y(), uniform(random, 0, 2 * kPi)};
      if (!is_free(part, obstacles, start)) continue;
      ++dropped_count;
      const auto end = dropped(random, space, scene.gravity, all, start);
      if (!end) continue;
      ++ends;
      INFO("seed " << seed << " end " << end->x_mm << " " << end->y_mm << " " << end->theta_rad);
      const int which = rest_of(all, *end, part.reach_mm);
      CHECK(which >= 0);
      listed += which >= 0;
    }
  }
  CHECK(all_rests > 100);
  CHECK(ends > 60);
  CHECK(listed == ends);
}

TEST_CASE("a coarse grid finds what a fine one does", "[rests]") {
  for (std::uint64_t seed = 600; seed < 606; ++seed) {
    const RestScene scene = random_rest_scene(seed);
    const auto coarse = rests_of(scene.outline, scene.shapes, scene.gravity, {5 * kDegree, 1e-6}, scene.grow_mm);
    const auto fine = rests_of(scene.outline, scene.shapes, scene.gravity, {kDegree, 1e-6}, scene.grow_mm);
    INFO("seed " << seed);
    REQUIRE(coarse.size() == fine.size());
    for (std::size_t i = 0; i < fine.size(); ++i) CHECK(coarse[i].height_mm == Approx(fine[i].height_mm).margin(1e-7));
  }
}
