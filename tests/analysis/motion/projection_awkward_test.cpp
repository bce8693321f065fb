// Forward projection where geometry or mechanics are degenerate.
#include <catch2/catch.hpp>

#include "analysis/motion/projection_worlds.hpp"

using namespace formotion;
using namespace formotion::witness;
using namespace formotion::worlds;

TEST_CASE("starts that touch: flush on the wall, in a corner, corner on corner, edge on edge") {
  const Polygon box = centred({rectangle(0, 0, 20, 10), {}});
  Scene scene;
  scene.outline = box;
  const MovingShape part = scene.part();
  const Obstacles plain = *make_obstacles({wall()});
  const Obstacles corner = *make_obstacles({wall(), block({{30, -1}, {40, -1}, {40, 60}, {30, 60}})});
  const Drive drive{direction(-kPi / 6), 0.2};
  SECTION("flush on the wall it slides on, whichever edge is down, a full turn on too") {
    for (int side = 0; side < 8; ++side) {
      const double y = side % 2 ? 10 : 5;
      const Projection path = project(part, plain, drive, {0, y, side * kPi / 2});
      CHECK(path.end == ProjectionEnd::Steady);
      CHECK(path.last.theta_rad == Approx(side * kPi / 2).margin(1e-9));
      CHECK(path.last.y_mm == Approx(y));
      CHECK(path.last_twist.linear.x() > 0);
      CHECK(path.legs.size() == 1);
    }
  }
  SECTION("in a corner it stays") {
    const Projection path = project(part, corner, drive, {20, 5, 0});
    CHECK(path.end == ProjectionEnd::AtRest);
    CHECK(apart(path.last, {20, 5, 0}) < 1e-9);
  }
  SECTION("away from the corner it leaves it") {
    const Projection path = project(part, corner, {direction(kPi * 7 / 6), 0.2}, {20, 5, 0});
    CHECK(path.end == ProjectionEnd::Steady);
    CHECK(path.last_twist.linear.x() < 0);
  }
  SECTION("straight down on a corner of a block below one of its own it falls off to its side") {
    // Corner on corner: the block's corner (0, 40), the box's lower left or right one.
    const Obstacles block_below = *make_obstacles({wall(), block({{-30, -1}, {0, -1}, {0, 40}, {-30, 40}})});
    // To the right of it, touching edge on edge: it slides down along the block's side.
    const Projection beside = project(part, block_below, {{0, -1}, 0.2}, {10, 44, 0});
    CHECK(beside.end == ProjectionEnd::AtRest);
    CHECK(beside.last.y_mm == Approx(5));
    CHECK(beside.last.theta_rad == Approx(0).margin(1e-9));
    // On the block, flush, its centre of mass over it: it stays.
    const Projection on_top = project(part, block_below, {{0, -1}, 0.2}, {-9, 45, 0});
    CHECK(on_top.end == ProjectionEnd::AtRest);
    CHECK(apart(on_top.last, {-9, 45, 0}) < 1e-9);
    // Its centre of mass beyond the edge: it tips over to the right and comes down.
    const Projection over = project(part, block_below, {{0, -1}, 0.2}, {1, 45, 0});
    CHECK(over.end == ProjectionEnd::AtRest);
    CHECK(over.last.theta_rad < -0.1);
    CHECK(over.last.y_mm < 20);
    CHECK(clearance_mm(part, block_below, over.last) >= -1e-6);
  }
  SECTION("a corner exactly on a corner, pushed against it") {
    const double diagonal = std::hypot(10, 5), tilt = std::atan2(5, 10);
    const Obstacles spike = *make_obstacles({block({{-5, -60}, {5, -60}, {0, 0}})});
    // Standing on its corner, the centre of mass about straight above. Either corner's edges may carry: whichever way
    // it goes, it falls off the spike.
    const Configuration upright{0, diagonal, kPi / 2 - tilt};  // corner (-10, -5) below
    CHECK(clearance_mm(part, spike, upright) == Approx(0).margin(1e-9));
    for (const double lean : {-1e-2, 1e-2}) {
      const double theta = upright.theta_rad + lean;
      const Point p = -rotated(Point(-10, -5), theta);
      const Projection path = project(part, spike, {{0, -1}, 0.3}, {p.x(), p.y(), theta});
      std::vector<Projection> ends = path.branches;
      if (path.end != ProjectionEnd::Ambiguous) ends = {path};
      REQUIRE_FALSE(ends.empty());
      for (const Projection& end : ends) {
        CHECK(end.end == ProjectionEnd::Steady);
        CHECK(end.last_twist.linear.y() < 0);
        CHECK(clearance_mm(part, spike, end.last) >= -1e-6);
      }
    }
  }
}

TEST_CASE("rectangles among rectangles: edges, corners and gaps all on the grid") {
  int rests = 0, leaves = 0, ambiguous = 0, undecided = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    Random random(seed);
    Scene scene;
    scene.outline = centred(grid_polygon(random, 10));
    const Point offset = scene.outline.outer.front();
    scene.shapes = {wall()};
    for (int i = 0, n = 1 + below(random, 3); i < n; ++i) {
      const double x = 12 + below(random, 25), y = below(random, 16) - 1.0;
      scene.shapes.push_back(block(rectangle(x, y, x + 2 + below(random, 10), y + 1 + below(random, 8))));
    }
    scene.drive = {direction(-kPi / 4 * below(random, 3)), 0.1 * below(random, 5)};
    const int quarter = below(random, 4);
    // On the grid as well.
    const Point corner = rotated(offset, quarter * kPi / 2);
    scene.start = {-10 + below(random, 20) - corner.x(), 6 + below(random, 10) - corner.y(), quarter * kPi / 2};
    const MovingShape part = scene.part();
    const Obstacles obstacles = scene.obstacles();
    if (!is_free(part, obstacles, scene.start)) continue;
    CAPTURE(seed);
    Seen seen;
    const Projection path = watched(part, obstacles, scene, seen);
    if (seen.stretches) {
      CHECK(seen.least_mm >= -1e-5);
      CHECK(seen.least_drive >= -1e-5);
    }
    CHECK(seen.joined);
    CHECK(clearance_mm(part, obstacles, path.last) >= -1e-6);
    rests += path.end == ProjectionEnd::AtRest;
    leaves += path.end == ProjectionEnd::Steady;
    ambiguous += path.end == ProjectionEnd::Ambiguous;
    undecided += path.end == ProjectionEnd::Undecided;
    if (path.end == ProjectionEnd::Undecided) WARN("undecided " << seed << " " << path.why);
  }
  CAPTURE(rests, leaves, ambiguous, undecided);
  CHECK(rests > 40);
  CHECK(leaves > 40);
  CHECK(undecided == 0);
}

TEST_CASE("a channel of the part's own width: it slides through without friction, with friction it may stick") {
  const Polygon box = centred({rectangle(0, 0, 20, 10), {}});
  Scene scene;
  scene.outline = box;
  const MovingShape part = scene.part();
  const Obstacles channel = *make_obstacles(
      {block({{-100, -10}, {100, -10}, {100, 0}, {-100, 0}}), block({{-100, 10}, {100, 10}, {100, 20}, {-100, 20}})});
  const Projection smooth = project(part, channel, {{1, 0}, 0}, {0, 5, 0});
  CHECK(smooth.end == ProjectionEnd::Steady);
  CHECK(smooth.last_twist.linear.x() == Approx(1));
  const Projection rough = project(part, channel, {{1, 0}, 0.2}, {0, 5, 0});
  CHECK(rough.end == ProjectionEnd::Ambiguous);
  CHECK(rough.may_rest);
  REQUIRE(rough.branches.size() == 2);
  CHECK(rough.branches[0].end == ProjectionEnd::AtRest);
  // From outside it may go in where it fits exactly, or stop at the lip: corner on corner, both are consistent.
  const Obstacles mouth = *make_obstacles({wall(), block({{0, 10}, {kFar_mm, 10}, {kFar_mm, 20}, {0, 20}})});
  const Projection path = project(part, mouth, {direction(-0.3), 0}, {-60, 5, 0});
  REQUIRE(path.end == ProjectionEnd::Ambiguous);
  CHECK(path.last.x_mm == Approx(-10));
  bool enters = false;
  for (const Projection& branch : path.branches) {
    CHECK(clearance_mm(part, mouth, branch.last) >= -1e-6);
    enters = enters || (branch.end == ProjectionEnd::Steady && branch.last.theta_rad == Approx(0).margin(1e-9));
  }
  CHECK(enters);
  // Narrower by a hair it does not fit.
  const Obstacles narrow = *make_obstacles(
      {block({{-100, -10}, {100, -10}, {100, 0}, {-100, 0}}), block({{0, 9.999}, {100, 9.999}, {100, 20}, {0, 20}})});
  const Projection blocked = project(part, narrow, {direction(-0.3), 0.2}, {-60, 5, 0});
  CHECK(blocked.end == ProjectionEnd::AtRest);
  CHECK(blocked.last.x_mm == Approx(-10));
}

TEST_CASE("a part in an obstacle's hole stays in it") {
  Random random(20261221);
  int rests = 0;
  for (int i = 0; i < 60; ++i) {
    Scene scene;
    scene.outline = centred(random_polygon(random, 8));
    Loop hole = placed(random_polygon(random, 40), 0, Point::Zero()).outer;
    std::reverse(hole.begin(), hole.end());
    const Obstacles frame = *make_obstacles({{{rectangle(-60, -60, 60, 60), {hole}}, 0, false}});
    const MovingShape part = scene.part();
    const Configuration start{0, 0, uniform(random, -kPi, kPi)};
    if (!is_free(part, frame, start)) continue;
    scene.drive = {direction(uniform(random, -kPi, kPi)), uniform(random, 0, 0.5)};
    scene.start = start;
    Seen seen;
    const Projection path = watched(part, frame, scene, seen);
    CAPTURE(i);
    CHECK(path.end != ProjectionEnd::Steady);
    CHECK(path.end != ProjectionEnd::Undecided);
    CHECK(seen.least_mm >= -1e-5);
    CHECK(locate(hole, path.last.position(), 0) != Side::Outside);
    rests += path.end == ProjectionEnd::AtRest;
  }
  CHECK(rests > 20);
}

TEST_CASE("where a contact has several motions the branches are all followed") {
  // A long rod that leans on a rough floor: with this friction it may fall over its foot, stick or dig in.
  const Polygon rod = centred({rectangle(0, 0, 60, 2), {}});
  Scene scene;
  scene.outline = rod;
  const MovingShape part = scene.part();
  const Obstacles plain = *make_obstacles({wall()});
  Random random(20261222);
  int ambiguous = 0;
  for (int i = 0; i < 400; ++i) {
    const double theta = uniform(random, 0.2, kPi - 0.2), friction = uniform(random, 1.5, 4);
    double low = 0;
    for (const Point& p : rod.outer) low = std::min(low, rotated(p, theta).y());
    scene.drive = {direction(uniform(random, -0.5, 0.5)), friction};
    const Configuration start{0, -low, theta};
    const Projection path = project(part, plain, scene.drive, start);
    if (path.end != ProjectionEnd::Ambiguous) continue;
    ++ambiguous;
    CHECK(path.branches.size() >= 2);
    CHECK_FALSE(path.why.empty());
    for (const Projection& branch : path.branches) {
      CHECK(branch.legs.empty());
      CHECK((branch.end != ProjectionEnd::Undecided || branch.branches.empty()));
    }
    ProjectionOptions none;
    none.max_branching = 0;
    const Projection unfollowed = project(part, plain, scene.drive, start, none);
    CHECK(unfollowed.end == ProjectionEnd::Ambiguous);
    CHECK(unfollowed.branches.empty());
  }
  CHECK(ambiguous > 5);
}
