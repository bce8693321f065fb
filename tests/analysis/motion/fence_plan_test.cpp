// Fences planned in theory orient parts in the forward projection.
#include "witness/fence_plan.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "analysis/motion/contact_space.hpp"
#include "analysis/motion/projection.hpp"
#include "witness/random_shapes.hpp"

using namespace formotion;
using namespace formotion::witness;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kTurn = 2 * kPi;
// A part whose resting edge ends close behind the foot of its centre of mass turns slowly on the last facets of a tip,
// and leaves it not quite along the belt.
constexpr double kTipLeaves_rad = 0.07;

Polygon centred(Polygon polygon) {
  polygon = normalised(std::move(polygon));
  return placed(polygon, 0, -area_moments(polygon).centroid);
}

MovingShape moving(const Polygon& part) {
  const AreaMoments moments = area_moments(part);
  return MovingShape::of({part}, std::sqrt(moments.second_mm4.trace() / moments.area_mm2));
}

double reach(const Polygon& part) {
  double farthest = 0;
  for (const Point& p : part.outer) farthest = std::max(farthest, p.norm());
  return farthest;
}

Polygon random_convex(Random& random) {
  for (;;) {
    Polygon part = centred({convex_hull(random_polygon(random, 15).outer), {}});
    if (part.outer.size() > 3) return part;
  }
}

// One that keeps its rest on the facets of a tip.
Polygon random_steady(Random& random) {
  for (;;) {
    Polygon part = random_convex(random);
    double nearest = kPi;
    for (const double friction : {-0.1, 0.0, 0.1}) {
      const PushFunction push = push_function(part.outer, friction);
      for (const double rest : push.rests_rad) nearest = std::min(nearest, push.off_bounds(rest));
    }
    if (nearest > 1.2 * kTipFacet_rad) return part;
  }
}

// With which orientations do all starts leave the belt?
std::vector<double> leaving(const Polygon& part, const std::vector<Fence>& fences, double friction, int starts) {
  std::vector<ObstacleShape> shapes;
  for (const Polygon& fence : belt(fences, reach(part), 30 * reach(part)).fences) shapes.push_back({fence, 0, false});
  const auto obstacles = make_obstacles(shapes);
  REQUIRE(obstacles);
  const MovingShape shape = moving(part);
  const ContactSpace space(shape, *obstacles);
  Funnels funnels;
  ProjectionOptions alone, options;
  alone.keep_path = options.keep_path = false;
  options.funnels = &funnels;
  std::vector<double> orientations;
  for (int i = 0; i < starts; ++i) {
    // A third of a degree beside whole ones, in which symmetric parts are exactly unstable.
    const Projection went = project(space, {{1, 0}, friction}, {0, 0, kTurn * (i + 0.37) / starts}, options);
    CAPTURE(i, went.why, went.last.x_mm, went.last.y_mm, went.last.theta_rad);
    REQUIRE(went.end == ProjectionEnd::Steady);
    REQUIRE(went.last_twist.angular == 0);
    if (i % 12 == 0) {  // what starts know of each other changes nothing
      const Projection by_itself = project(space, {{1, 0}, friction}, {0, 0, kTurn * (i + 0.37) / starts}, alone);
      REQUIRE(by_itself.end == ProjectionEnd::Steady);
      REQUIRE(by_itself.last.theta_rad == Approx(went.last.theta_rad).margin(1e-6));
    }
    orientations.push_back(went.last.theta_rad);
  }
  return orientations;
}

double apart(double a, double b, int symmetry) { return std::abs(std::remainder(a - b, kTurn / symmetry)); }

}  // namespace

TEST_CASE("a single fence turns a part as the push function says, and its tip turns it along the belt") {
  Random random(20261121);
  for (int k = 0; k < 6; ++k) {
    const Polygon part = random_steady(random);
    for (const double friction : {0.0, 0.1}) {
      const Fence fence{k % 2 ? FenceSide::Left : FenceSide::Right, uniform(random, 0.3, 1.1)};
      const std::vector<double> left = leaving(part, {fence}, friction, 40);
      for (int i = 0; i < 40; ++i) {
        CAPTURE(k, friction, i);
        CHECK(apart(left[i], after_fence(part.outer, friction, fence, kTurn * (i + 0.37) / 40), 1) < kTipLeaves_rad);
      }
    }
  }
}

TEST_CASE("a planned belt brings all of 360 orientations into one, from fence to fence in one world") {
  Random random(20261122);
  int planned = 0, longest = 0;
  for (int k = 0; k < 5; ++k) {
    const Polygon part = k == 0 ? centred({{{0, 0}, {31, 0}, {0, 17}}, {}}) : random_steady(random);
    for (const double friction : {0.0, 0.1}) {
      const auto plan = fence_plan(part.outer, friction, 1, {0.2, 1.2, kTipLeaves_rad});
      CAPTURE(k, friction);
      REQUIRE(plan);
      CAPTURE(plan->fences.size());
      REQUIRE(plan->fences.size() > 1);
      ++planned;
      longest = std::max(longest, static_cast<int>(plan->fences.size()));
      const std::vector<double> left = leaving(part, plan->fences, friction, k == (friction > 0) ? 360 : 36);
      for (const double orientation : left) {
        CHECK(apart(orientation, plan->orientation_rad, 1) < kTipLeaves_rad);
        CHECK(apart(orientation, left.front(), 1) < 1e-6);
      }
    }
  }
  CHECK(planned == 10);
  CHECK(longest > 2);
}

TEST_CASE("a plan without its last fence leaves more than one orientation: fences are needed") {
  Random random(20261122);
  const Polygon part = random_steady(random);
  const auto plan = fence_plan(part.outer, 0.1, 1, {0.2, 1.2, kTipLeaves_rad});
  REQUIRE(plan);
  std::vector<Fence> fences = plan->fences;
  fences.pop_back();
  const std::vector<double> left = leaving(part, fences, 0.1, 90);
  CHECK(std::any_of(left.begin(), left.end(), [&](double angle) { return apart(angle, left.front(), 1) > 0.1; }));
}

TEST_CASE("parts with rotational symmetry are oriented up to it") {
  const Polygon rectangle = centred({{{0, 0}, {26, 0}, {26, 14}, {0, 14}}, {}});
  for (const double friction : {0.0, 0.1}) {
    CHECK_FALSE(fence_plan(rectangle.outer, friction, 1));  // what looks the same cannot be told apart
    const auto plan = fence_plan(rectangle.outer, friction, 2, {0.2, 1.2, kTipLeaves_rad});
    REQUIRE(plan);
    for (const double orientation : leaving(rectangle, plan->fences, friction, 36)) {
      CHECK(apart(orientation, plan->orientation_rad, 2) < kTipLeaves_rad);
    }
  }
}

TEST_CASE("every convex polygon has a plan: 60 of 3 to 10 corners, checked fence by fence in theory") {
  Random random(20261123);
  std::size_t longest = 0;
  for (int k = 0; k < 60; ++k) {
    const Polygon part = random_convex(random);
    const double friction = k % 2 ? 0.1 : 0;
    FencePlanOptions options;
    options.margin_rad = 1e-4;
    options.least_angle_rad = 0.01;
    options.greatest_angle_rad = kPi / 2 - 0.11;
    const auto plan = fence_plan(part.outer, friction, 1, options);
    CAPTURE(k, part.outer.size());
    REQUIRE(plan);
    longest = std::max(longest, plan->fences.size());
    for (int i = 0; i < 36; ++i) {
      double orientation = kTurn * (i + 0.37) / 36;
      for (const Fence& fence : plan->fences) orientation = after_fence(part.outer, friction, fence, orientation);
      CHECK(apart(orientation, plan->orientation_rad, 1) < 1e-9);
    }
  }
  CHECK(longest < 10);
}
