// Forward projection in random and in awkward worlds: laws that every path must obey, and a slow time-stepper.
#include "analysis/motion/projection.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "analysis/contact/clearance.hpp"
#include "analysis/geometry/boolean.hpp"
#include "analysis/motion/contact_space.hpp"
#include "witness/contact_lcp.hpp"
#include "witness/random_shapes.hpp"

using namespace formotion;
using namespace formotion::witness;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kFar_mm = 1e5;

Point direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

Polygon centred(Polygon polygon) {
  polygon = normalised(std::move(polygon));
  return placed(polygon, 0, -area_moments(polygon).centroid);
}
double gyration(const Polygon& polygon) {
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

ObstacleShape wall() { return {{{{-kFar_mm, -50}, {kFar_mm, -50}, {kFar_mm, 0}, {-kFar_mm, 0}}, {}}, 0, true}; }
ObstacleShape block(const Loop& loop) { return {{loop, {}}, 0, false}; }
ObstacleShape pin(const Point& centre, double radius) { return {{{centre}, {}}, radius, false}; }

Polygon random_part(Random& random) {
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
Scene random_scene(std::uint64_t seed) {
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

double apart(const Configuration& a, const Configuration& b) {
  return std::hypot(a.x_mm - b.x_mm, a.y_mm - b.y_mm, 10 * (a.theta_rad - b.theta_rad));
}

// What a watch sees of a path.
struct Seen {
  double least_mm = 1e300;     // clearance
  double least_drive = 1e300;  // force . displacement between samples: the work of the drive
  int samples = 0, stretches = 0;
  bool joined = true;  // every stretch begins where the last ended
};

Projection watched(const MovingShape& part, const Obstacles& obstacles, const Scene& scene, Seen& seen,
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

bool same_end(const Projection& a, const Projection& b, double tolerance) {
  if (a.end != b.end) return false;
  return apart(a.last, b.last) <= tolerance && (a.last_twist.linear - b.last_twist.linear).norm() <= tolerance;
}

}  // namespace

TEST_CASE("paths in 600 random worlds stay clear of obstacles, and the drive never works against them") {
  int ends[5] = {}, samples = 0;
  double deepest = 0, deepest_end = 0, least_drive = 0;
  for (std::uint64_t seed = 1; seed <= 600; ++seed) {
    const Scene scene = random_scene(seed);
    const MovingShape part = scene.part();
    const Obstacles obstacles = scene.obstacles();
    if (!is_free(part, obstacles, scene.start)) continue;
    CAPTURE(seed);
    Seen seen;
    const Projection path = watched(part, obstacles, scene, seen);
    ++ends[static_cast<int>(path.end)];
    samples += seen.samples;
    CHECK(seen.joined);
    if (seen.stretches == 0) continue;
    const double end_mm = clearance_mm(part, obstacles, path.last);
    CHECK(seen.least_mm >= -1e-5);
    CHECK(end_mm >= -1e-6);
    // v . D^-1 v = F . v + what friction takes, which is not positive: F . v >= 0 (derived).
    CHECK(seen.least_drive >= -1e-5);
    deepest = std::min(deepest, seen.least_mm);
    deepest_end = std::min(deepest_end, end_mm);
    least_drive = std::min(least_drive, seen.least_drive);
  }
  CAPTURE(deepest, deepest_end, least_drive, ends[0], ends[1], ends[2], ends[3], samples);
  CHECK(ends[static_cast<int>(ProjectionEnd::Steady)] > 150);
  CHECK(ends[static_cast<int>(ProjectionEnd::AtRest)] > 100);
  CHECK(ends[static_cast<int>(ProjectionEnd::Undecided)] <= 3);
  CHECK(samples > 30000);
}

TEST_CASE("legs come in the order of the path: each begins where the watch saw the last one end") {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Scene scene = random_scene(seed);
    const MovingShape part = scene.part();
    const Obstacles obstacles = scene.obstacles();
    if (!is_free(part, obstacles, scene.start)) continue;
    CAPTURE(seed);
    const Projection path = project(part, obstacles, scene.drive, scene.start);
    if (path.legs.empty()) continue;
    CHECK(path.legs.front().event == "start");
    CHECK(apart(path.legs.front().start, scene.start) < 1e-6);
    double before = -1e300;
    for (const Leg& leg : path.legs) {  // the drive's work counts the way
      const double now = scene.drive.force.dot(leg.start.position());
      CHECK(now >= before - 1e-6);
      before = now;
      for (const Configuration& q : leg.between) {
        const double there = scene.drive.force.dot(q.position());
        CHECK(there >= before - 1e-6);
        before = there;
      }
      for (const ActiveContact& contact : leg.contacts) CHECK(contact.normal.norm() == Approx(1));
      CHECK((leg.motion == MotionKind::Free) == leg.contacts.empty());
    }
    CHECK(scene.drive.force.dot(path.last.position()) >= before - 1e-6);
  }
}

TEST_CASE("a world seen in a mirror has mirrored paths, and a world elsewhere the same ones") {
  int compared = 0, moved = 0;
  for (std::uint64_t seed = 1; seed <= 250; ++seed) {
    const Scene scene = random_scene(seed);
    const MovingShape part = scene.part();
    const Obstacles obstacles = scene.obstacles();
    if (!is_free(part, obstacles, scene.start)) continue;
    CAPTURE(seed);
    ProjectionOptions options;
    options.max_branching = 0;
    const Projection path = project(part, obstacles, scene.drive, scene.start, options);

    Scene mirror = scene;
    mirror.outline = mirrored_x(scene.outline);
    for (ObstacleShape& shape : mirror.shapes) {
      if (shape.radius_mm > 0) {
        shape.area.outer.front().x() *= -1;
      } else {
        shape.area = mirrored_x(shape.area);
      }
    }
    mirror.drive.force.x() *= -1;
    mirror.start = {-scene.start.x_mm, scene.start.y_mm, -scene.start.theta_rad};
    Projection other = project(mirror.part(), mirror.obstacles(), mirror.drive, mirror.start, options);
    other.last = {-other.last.x_mm, other.last.y_mm, -other.last.theta_rad};
    other.last_twist.linear.x() *= -1;
    CHECK(same_end(path, other, 1e-6));

    Scene elsewhere = scene;
    const Point by(13.37, scene.grow_mm > 0 ? 0 : -4.2);  // a wall does not grow where its face is y = 0
    for (ObstacleShape& shape : elsewhere.shapes) {
      for (Point& p : shape.area.outer) p += by;
    }
    elsewhere.start = {scene.start.x_mm + by.x(), scene.start.y_mm + by.y(), scene.start.theta_rad + 2 * kPi};
    other = project(elsewhere.part(), elsewhere.obstacles(), elsewhere.drive, elsewhere.start, options);
    other.last = {other.last.x_mm - by.x(), other.last.y_mm - by.y(), other.last.theta_rad - 2 * kPi};
    CHECK(same_end(path, other, 1e-6));
    ++compared;
    moved += path.legs.size() > 5;
  }
  CHECK(compared > 150);
  CHECK(moved > 80);
}

TEST_CASE("funnels, kept legs and watches that never stop leave ends as they are") {
  int many = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Scene scene = random_scene(seed);
    const MovingShape part = scene.part();
    const Obstacles obstacles = scene.obstacles();
    const ContactSpace space(part, obstacles);
    Funnels funnels;
    for (int i = 0; i < 60; ++i) {
      const Configuration start{-90, 45, 2 * kPi * i / 60};
      if (!is_free(part, obstacles, start)) continue;
      CAPTURE(seed, i);
      ProjectionOptions plain, quick, watching;
      plain.keep_path = quick.keep_path = false;
      quick.funnels = &funnels;
      watching.watch = [](const PathStretch&) { return std::nullopt; };
      const Projection a = project(space, scene.drive, start, plain);
      const Projection b = project(space, scene.drive, start, quick);
      const Projection c = project(space, scene.drive, start, watching);
      CHECK(same_end(a, b, 1e-7));
      CHECK(same_end(a, c, 0));
      CHECK(a.funnelled == b.funnelled);
      CHECK(a.history == c.history);
    }
    many += funnels.known.size() > 2;
  }
  CHECK(many > 3);
}

TEST_CASE("a limit of legs gives the answer or none") {
  int undecided = 0, decided = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Scene scene = random_scene(seed);
    const MovingShape part = scene.part();
    const Obstacles obstacles = scene.obstacles();
    if (!is_free(part, obstacles, scene.start)) continue;
    const Projection path = project(part, obstacles, scene.drive, scene.start);
    const int needed = static_cast<int>(path.legs.size());
    for (int most = 1; most <= needed + 1; ++most) {
      ProjectionOptions options;
      options.max_legs = most;
      const Projection cut = project(part, obstacles, scene.drive, scene.start, options);
      CAPTURE(seed, most, needed);
      if (cut.end == ProjectionEnd::Undecided) {
        ++undecided;
        CHECK((most <= needed || path.end == ProjectionEnd::Undecided));
        CHECK_FALSE(cut.why.empty());
      } else {
        ++decided;
        CHECK(same_end(cut, path, 0));
      }
    }
  }
  CHECK(undecided > 100);
  CHECK(decided > 50);
}

TEST_CASE("a watch stops the path where it says") {
  int stopped = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Scene scene = random_scene(seed);
    const MovingShape part = scene.part();
    const Obstacles obstacles = scene.obstacles();
    if (!is_free(part, obstacles, scene.start)) continue;
    ProjectionOptions options;
    options.max_branching = 0;
    const Projection path = project(part, obstacles, scene.drive, scene.start, options);
    if (path.legs.size() < 3) continue;
    // A gate at half of the drive's work that the legs tell of.
    const double from = scene.drive.force.dot(scene.start.position());
    const double gate = (from + scene.drive.force.dot(path.legs.back().start.position())) / 2;
    int seen_after = 0;
    bool shut = false;
    options.watch = [&](const PathStretch& stretch) -> std::optional<double> {
      seen_after += shut;
      const auto beyond = [&](double t) { return scene.drive.force.dot(stretch.at(t).position()) - gate; };
      if (beyond(1) < 0) return std::nullopt;
      double low = 0, high = 1;
      for (int i = 0; i < 100; ++i) (beyond((low + high) / 2) < 0 ? low : high) = (low + high) / 2;
      shut = true;
      return high;
    };
    const Projection cut = project(part, obstacles, scene.drive, scene.start, options);
    CAPTURE(seed);
    if (gate <= from) continue;
    CHECK(cut.end == ProjectionEnd::Stopped);
    CHECK(seen_after == 0);
    CHECK(scene.drive.force.dot(cut.last.position()) == Approx(gate).margin(1e-9));
    ++stopped;
  }
  CHECK(stopped > 50);
}

namespace {

// The law taken in small steps: contacts within a skin, the motion by Lemke's method, and what overlaps pushed apart.
struct Stepped {
  bool rests = false, leaves = false, lost = false;
  Configuration last;
};
Stepped stepped(const MovingShape& part, const Obstacles& obstacles, const Scene& scene, double step_mm, double most_mm,
                double leave_x) {
  Stepped result;
  Configuration q = scene.start;
  const double skin = 0.2 * step_mm;
  const double size = scene.drive.force.norm();
  std::uint64_t k = 0;
  for (double way = 0; way < most_mm; way += step_mm) {
    const double room = clearance_mm(part, obstacles, q);
    LcpCase lcp;
    lcp.friction = scene.drive.friction;
    lcp.gyration_mm = part.gyration_mm;
    lcp.wrench = {scene.drive.force.x() / size, scene.drive.force.y() / size, 0};
    double h = step_mm;
    if (room > skin) {
      h = std::max(step_mm, 0.9 * room / (1 + part.reach_mm * 0));  // free: it does not turn
    } else {
      for (const Contact& contact : contacts_at(part, obstacles, q, skin)) {
        const LcpContact here{contact.state.normal, contact.state.lever};
        const bool known = std::any_of(lcp.contacts.begin(), lcp.contacts.end(), [&](const LcpContact& c) {
          return (c.normal - here.normal).norm() < 1e-6 && (c.lever - here.lever).norm() < 2 * skin;
        });
        if (!known) lcp.contacts.push_back(here);
      }
    }
    Twist3 twist = lcp.wrench;
    if (!lcp.contacts.empty()) {
      Eigen::VectorXd cover = Eigen::VectorXd::Constant(4 * static_cast<Eigen::Index>(lcp.contacts.size()), 1);
      for (Eigen::Index i = 0; i < cover.size(); ++i) cover[i] += 0.01 * static_cast<double>((++k * 7919) % 97);
      const auto found = twist_by_lemke(lcp, cover);
      if (!found) {
        result.lost = true;
        return result;
      }
      twist = *found;
    }
    const double fast = std::hypot(twist[0], twist[1], part.gyration_mm * twist[2]);
    if (fast < 1e-5) {
      result.rests = true;
      result.last = q;
      return result;
    }
    const double scale = h / std::max(fast, 0.2);
    q = {q.x_mm + scale * twist[0], q.y_mm + scale * twist[1], q.theta_rad + scale * twist[2]};
    for (int i = 0; i < 3; ++i) {
      const Clearance over = clearance(part, obstacles, q);
      if (over.mm >= 0) break;
      const Point out = over.on_obstacles - over.on_part;
      q.x_mm += out.x();
      q.y_mm += out.y();
    }
    if (q.x_mm > leave_x) {
      result.leaves = true;
      result.last = q;
      return result;
    }
  }
  result.lost = true;
  return result;
}

}  // namespace

TEST_CASE("a time-stepper that solves the complementarity problem ends where projection does") {
  int compared = 0, rests = 0, leaves = 0, unsure = 0;
  double worst = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Random random(seed + 500);
    Scene scene;
    scene.outline = centred(random_polygon(random, 9));
    scene.shapes = {wall(), block({{-3, -2}, {14, -2}, {14, uniform(random, 2, 14)}}),
                    pin({uniform(random, 18, 26), uniform(random, 2, 12)}, uniform(random, 1, 3))};
    scene.drive = {direction(uniform(random, -0.9, -0.2)), below(random, 4) ? uniform(random, 0.05, 0.4) : 0};
    scene.start = {-14, 11, uniform(random, -kPi, kPi)};
    const MovingShape part = scene.part();
    const Obstacles obstacles = scene.obstacles();
    if (!is_free(part, obstacles, scene.start)) continue;
    const Projection path = project(part, obstacles, scene.drive, scene.start);
    if (path.end != ProjectionEnd::AtRest && path.end != ProjectionEnd::Steady) continue;
    CAPTURE(seed);
    const Stepped coarse = stepped(part, obstacles, scene, 1e-2, 600, 250);
    const Stepped fine = stepped(part, obstacles, scene, 5e-3, 600, 250);
    // Near a boundary between outcomes, or where contacts come and go, steps of different sizes end differently.
    const bool sure = !coarse.lost && !fine.lost && coarse.rests == fine.rests &&
                      std::abs(coarse.last.theta_rad - fine.last.theta_rad) < 2e-3;
    if (!sure) {
      ++unsure;
      continue;
    }
    ++compared;
    CHECK(fine.rests == (path.end == ProjectionEnd::AtRest));
    if (fine.rests) {
      ++rests;
      const double off = apart(fine.last, path.last);
      worst = std::max(worst, off);
      CHECK(off < 2e-2);
    } else {
      ++leaves;
      CHECK(std::abs(fine.last.theta_rad - path.last.theta_rad) < 2e-3);
      CHECK(std::abs(fine.last.y_mm - path.last.y_mm) < 2e-2);
    }
  }
  CAPTURE(compared, rests, leaves, unsure, worst);
  CHECK(compared > 12);
  CHECK(rests > 3);
  CHECK(leaves > 3);
  CHECK(unsure < compared);
}

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
