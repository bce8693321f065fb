// Forward projection in random worlds: laws that every path must obey.
#include <catch2/catch.hpp>

#include "analysis/motion/projection_worlds.hpp"

using namespace formotion;
using namespace formotion::witness;
using namespace formotion::worlds;

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
