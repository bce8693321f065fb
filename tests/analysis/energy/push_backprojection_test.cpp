#include "analysis/energy/push_backprojection.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "analysis/geometry/boolean.hpp"
#include "analysis/motion/projection.hpp"
#include "witness/push_function.hpp"
#include "witness/random_shapes.hpp"

using namespace formotion;
using namespace formotion::witness;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kTurn = 2 * kPi;
using IsGoal = std::function<bool(const Configuration&)>;

Polygon centred(Polygon polygon) {
  polygon = normalised(std::move(polygon));
  return placed(polygon, 0, -area_moments(polygon).centroid);
}

MovingShape shape_of(const Polygon& polygon) {
  const AreaMoments moments = area_moments(polygon);
  return MovingShape::of({polygon}, std::sqrt(moments.second_mm4.trace() / moments.area_mm2));
}

// Its top is y = 0.
Obstacles wall() { return *make_obstacles({{{{{-1e5, -100}, {1e5, -100}, {1e5, 0}, {-1e5, 0}}, {}}, 0, true}}); }

Configuration over_wall(const Polygon& part, double theta, double x = 0) {
  double low = 0;
  for (const Point& p : part.outer) low = std::min(low, rotated(p, theta).y());
  return {x, 1 - low, theta};
}

IsGoal turned_to(double theta_rad) {
  return [=](const Configuration& q) { return std::abs(std::remainder(q.theta_rad - theta_rad, kTurn)) < 1e-6; };
}

const PushSet kPush{-35 * kPi / 180, -25 * kPi / 180, 0.05, 0.3};

std::vector<Polygon> parts() {
  Random random(20261111);
  std::vector<Polygon> list{centred({{{0, 0}, {30, 0}, {30, 10}, {10, 10}, {10, 20}, {0, 20}}, {}}),
                            centred({{{0, 0}, {31, 0}, {0, 17}}, {}}),
                            centred({{{0, 0}, {60, 0}, {61, 3}, {0, 2}}, {}})};
  for (int i = 0; i < 3; ++i) list.push_back(centred(random_polygon(random, 20)));
  return list;
}

// By the push functions of many frictions; the drive's direction does not count (push_function.hpp).
Verdict by_theory(const std::vector<PushFunction>& members, double start, double goal) {
  std::size_t reach = 0;
  for (const PushFunction& push : members) reach += std::abs(std::remainder(push.rest(start) - goal, kTurn)) < 1e-6;
  return reach == members.size() ? Verdict::Certain : reach > 0 ? Verdict::Possible : Verdict::Impossible;
}

std::vector<PushFunction> theory(const Polygon& part, int count) {
  std::vector<PushFunction> members;
  for (int i = 0; i < count; ++i) {
    const double mu = kPush.friction_min + (kPush.friction_max - kPush.friction_min) * i / (count - 1);
    members.push_back(push_function(part.outer, mu));
  }
  return members;
}

}  // namespace

TEST_CASE("starts pushed to a plain wall end for certain or possibly or never as all push functions of the set say") {
  const Obstacles obstacles = wall();
  int compared = 0, certain = 0, possible = 0, impossible = 0;
  for (const Polygon& part : parts()) {
    const MovingShape moving = shape_of(part);
    const ContactSpace space(moving, obstacles);
    const std::vector<PushFunction> members = theory(part, 26);
    const std::vector<double> rests = members.front().rests_rad;
    for (int i = 0; i < 48; ++i) {
      const double start = kTurn * (i + 0.3) / 48;
      const bool marginal = std::any_of(members.begin(), members.end(),
                                        [&](const PushFunction& push) { return push.off_bounds(start) < 1e-3; });
      if (marginal) continue;
      const double goal = rests[i % rests.size()];
      const Verdict expected = by_theory(members, start, i % 2 ? goal : members.front().rest(start));
      const double at = i % 2 ? goal : members.front().rest(start);
      CAPTURE(i, start, at);
      CHECK(name(ends_in(space, kPush, over_wall(part, start), turned_to(at))) == std::string(name(expected)));
      ++compared;
      certain += expected == Verdict::Certain;
      possible += expected == Verdict::Possible;
      impossible += expected == Verdict::Impossible;
    }
  }
  CHECK(compared > 200);
  CHECK(certain > 20);
  CHECK(possible > 5);
  CHECK(impossible > 20);
}

TEST_CASE("the backprojection of a resting orientation is bounded by the push functions' bounds at the set's ends") {
  const Obstacles obstacles = wall();
  const Polygon part = parts()[1];
  const MovingShape moving = shape_of(part);
  const ContactSpace space(moving, obstacles);
  const std::vector<PushFunction> members = theory(part, 26);
  const double goal = members.front().rests_rad.front();
  const ErrorBox box{-2, 2, goal - 1.9, goal + 1.9};
  RegionOptions options;
  options.starts_a_row = 3;
  options.most_rows = 45;
  const auto start = [&](double across, double theta) { return over_wall(part, theta, across); };
  const OutcomeRegion region = backprojection(space, kPush, box, start, turned_to(goal), options);
  for (const RegionRow& row : region.rows) {
    // Nothing depends on where along the wall it starts.
    REQUIRE(row.intervals.size() == 1);
    const bool marginal = std::any_of(members.begin(), members.end(),
                                      [&](const PushFunction& push) { return push.off_bounds(row.v) < 1e-3; });
    if (!marginal) CHECK(row.intervals[0].outcome == static_cast<int>(by_theory(members, row.v, goal)));
  }
  double certain = 0, reached = 0;
  for (int i = 0; i < 4000; ++i) {
    const Verdict verdict = by_theory(members, box.v_min + (box.v_max - box.v_min) * (i + 0.5) / 4000, goal);
    certain += (verdict == Verdict::Certain) / 4000.0;
    reached += (verdict != Verdict::Impossible) / 4000.0;
  }
  CHECK(certain > 0.1);
  CHECK(reached < 0.9);
  CHECK(share_of(region, static_cast<int>(Verdict::Certain)) == Approx(certain).margin(0.03));
  CHECK(share_of(region, static_cast<int>(Verdict::Impossible)) == Approx(1 - reached).margin(0.03));
}

TEST_CASE("starts that overlap never end in a goal and a push into free space ends nowhere") {
  const Obstacles obstacles = wall();
  const Polygon part = parts()[1];
  const MovingShape moving = shape_of(part);
  const ContactSpace space(moving, obstacles);
  const IsGoal anywhere = [](const Configuration&) { return true; };
  CHECK(ends_in(space, kPush, {0, -1, 0}, anywhere) == Verdict::Impossible);
  CHECK(ends_in(space, kPush, over_wall(part, 0.3), anywhere) == Verdict::Certain);
  // A goal that the part only passes on its way.
  const IsGoal here = [](const Configuration& q) { return std::abs(q.x_mm) < 50; };
  CHECK(ends_in(space, {0.5, 0.6, 0.1, 0.2}, over_wall(part, 0.3), here) == Verdict::Impossible);
}

TEST_CASE("a block let down into a corner is certain to end there: in no other place and not where it may stick") {
  const MovingShape part = MovingShape::of({{rectangle(-5, -5, 5, 5), {}}}, 4);
  const Obstacles corner =
      *make_obstacles({{{rectangle(-100, -20, 0, 100), {}}, 0, false}, {{rectangle(0, -20, 200, 0), {}}, 0, false}});
  const ContactSpace space(part, corner);
  const IsGoal in_corner = [](const Configuration& q) {
    return std::hypot(q.x_mm - 5, q.y_mm - 5) < 1e-4 && std::abs(std::remainder(q.theta_rad, kPi / 2)) < 1e-6;
  };
  // It slides on the floor iff the force leans more than atan mu.
  const double lean = std::atan(0.3);
  const auto verdict = [&](double least_lean, double most_lean, const Configuration& start) {
    return ends_in(space, {-kPi / 2 - most_lean, -kPi / 2 - least_lean, 0.3, 0.3}, start, in_corner);
  };
  for (const double y : {5.0, 12.0}) {  // in contact, and free
    CHECK(verdict(lean + 0.05, lean + 0.2, {40, y, 0}) == Verdict::Certain);
    CHECK(verdict(lean - 0.05, lean + 0.2, {40, y, 0}) == Verdict::Possible);
    CHECK(verdict(lean - 0.2, lean - 0.05, {40, y, 0}) == Verdict::Impossible);
  }
  CHECK(verdict(0, lean - 0.05, {5, 5, 0}) == Verdict::Certain);
}

TEST_CASE("of an ambiguous start no more is certain than that every way of it leads to the goal") {
  // Between two walls a peg that is wedged can stay, or go on down.
  const MovingShape part = MovingShape::of({{rectangle(-5, -20, 5, 20), {}}}, 12);
  const Obstacles slot =
      *make_obstacles({{{rectangle(-50, -80, -5.1, 0), {}}, 0, false}, {{rectangle(5.1, -80, 50, 0), {}}, 0, false}});
  const ContactSpace space(part, slot);
  const double down = -kPi / 2, mu = 0.8;
  int ambiguous = 0;
  for (const EquilibriumSet& set : equilibria(space, {down, down, mu, mu})) {
    for (const Configuration& q : set.samples) {
      const Projection path = project(space, {{std::cos(down), std::sin(down)}, mu}, q);
      if (path.end != ProjectionEnd::Ambiguous || !path.may_rest) continue;
      ++ambiguous;
      const IsGoal stays = [&](const Configuration& at) {
        return (at.position() - q.position()).norm() < 1e-3 && std::abs(at.theta_rad - q.theta_rad) < 1e-3;
      };
      CHECK(ends_in(space, {down, down, mu, mu}, q, stays) == Verdict::Possible);
      CHECK(ends_in(space, {down, down, mu, mu}, q, [&](const Configuration& at) { return !stays(at); }) !=
            Verdict::Certain);
    }
  }
  CHECK(ambiguous > 0);
}
