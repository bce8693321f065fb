#include "turning_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace formotion::bench {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
// Translations of forward projection that meet nothing over 20 m are taken as endless. Box2D sees the near end only.
constexpr double kWallEnd_mm = 1e5, kBox2dWallEnd_mm = 2000;

Polygon centred(const Loop& outline) {
  const Polygon polygon = normalised({outline, {}});
  return placed(polygon, 0, -area_moments(polygon).centroid);
}

Polygon el() {
  return centred(
      {{0, 0}, {0, -30.491329}, {-10.4514, -30.491329}, {-10.4514, -9.52185}, {-40.62175, -9.52185}, {-40.62175, 0}});
}

Polygon nine_corners() {
  const double radii[] = {18, 14, 21, 16, 12, 19, 15, 22, 17}, degrees[] = {4, 41, 88, 117, 163, 205, 246, 281, 327};
  Loop loop;
  for (int i = 0; i < 9; ++i) {
    loop.emplace_back(radii[i] * std::cos(degrees[i] * kDegree), radii[i] * std::sin(degrees[i] * kDegree));
  }
  return centred(loop);
}

Loop wall(double end_mm) { return {{-end_mm, -50}, {end_mm, -50}, {end_mm, 0}, {-end_mm, 0}}; }

TurningScene scene(const std::string& name, const Polygon& part, double drive_deg) {
  TurningScene made;
  made.name = name;
  made.part = part;
  const AreaMoments moments = area_moments(part);
  made.gyration_mm = std::sqrt(moments.second_mm4.trace() / moments.area_mm2);
  made.drive = {{std::cos(drive_deg * kDegree), std::sin(drive_deg * kDegree)}, 0.2};
  return made;
}

TurningScene ramp_and_pin(const std::string& name, const Polygon& part, double start_x_mm, double pin_mm = 2) {
  TurningScene made = scene(name, part, -30);
  made.obstacles = {{{wall(kWallEnd_mm), {}}, 0, true},
                    {{{{-5, -1.875}, {40, -1.875}, {40, 15}}, {}}, 0, false},
                    {{{{85, 34}}, {}}, pin_mm, false}};
  made.start_x_mm = start_x_mm;
  made.exit_x_mm = start_x_mm + 550;
  return made;
}

TurningScene two_fences(const std::string& name, const Polygon& part) {
  TurningScene made = scene(name, part, 0);
  made.has_wall = false;
  // Rising at 35 degrees over the path of the part, then falling at 50 degrees over the path that the first leaves.
  const auto fence = [](const Point& from, double angle_deg, double length) {
    const Point along(std::cos(angle_deg * kDegree), std::sin(angle_deg * kDegree));
    const double back = angle_deg > 0 ? -1 : 1;
    const Point thick = 8 * back * Point(-along.y(), along.x());
    Loop loop{from, from + length * along, from + length * along + thick, from + thick};
    if (signed_area(loop) < 0) std::reverse(loop.begin(), loop.end());
    return ObstacleShape{{loop, {}}, 0, false};
  };
  made.obstacles = {fence({0, -60}, 35, 220), fence({230, 140}, -50, 200)};
  made.start_x_mm = -20;
  made.exit_x_mm = 520;
  return made;
}

}  // namespace

Configuration start_at(const TurningScene& scene, double theta_rad) {
  double low = 0;
  for (const Point& p : scene.part.outer) low = std::min(low, rotated(p, theta_rad).y());
  return {scene.start_x_mm, scene.has_wall ? 0.5 - low : 0, theta_rad};
}

Box2dTrack box2d_track(const TurningScene& scene) {
  Box2dTrack track{{scene.part}, scene.gyration_mm, scene.obstacles, scene.drive, scene.exit_x_mm};
  if (scene.has_wall) track.obstacles.front().area.outer = wall(kBox2dWallEnd_mm);
  return track;
}

std::vector<TurningScene> turning_scenes() {
  return {ramp_and_pin("L, ramp and pin, settled", el(), -160),
          ramp_and_pin("L, ramp and pin of 1.8, settled", el(), -160, 1.8),
          ramp_and_pin("L, ramp and pin, turning", el(), -36),
          two_fences("L, two fences", el()),
          ramp_and_pin("9-gon, ramp and pin, settled", nine_corners(), -160),
          ramp_and_pin("9-gon, ramp and pin, turning", nine_corners(), -36),
          two_fences("9-gon, two fences", nine_corners())};
}

TurningScene random_scene(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&random](double from, double to) {
    return from + (to - from) * static_cast<double>(random() >> 11) * 0x1.0p-53;
  };
  const auto below = [&random](int n) { return static_cast<int>(random() % static_cast<std::uint64_t>(n)); };
  Loop star;
  const int corners = 3 + below(7);
  for (int i = 0; i < corners; ++i) {
    const double angle = (i + uniform(0.1, 0.9)) * 2 * std::numbers::pi / corners, radius = uniform(6, 20);
    star.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  TurningScene made = scene("random " + std::to_string(seed), centred(star), uniform(-50, -15));
  made.drive.friction = below(4) ? uniform(0.05, 0.4) : 0;
  made.obstacles = {{{wall(kWallEnd_mm), {}}, 0, true}};
  double x = 0;
  const int features = 1 + below(3);
  for (int i = 0; i < features; ++i) {
    const double length = uniform(15, 60), slope = uniform(0.1, 0.7);
    switch (below(3)) {
      case 0:
        made.obstacles.push_back(
            {{{{x - 5, -5 * slope}, {x + length, -5 * slope}, {x + length, slope * length}}, {}}, 0, false});
        break;
      case 1: {  // above the track, falling to the wall
        const double foot = uniform(10, 30);
        made.obstacles.push_back(
            {{{{x, foot + slope * length}, {x + length, foot}, {x + length, foot + slope * length}}, {}}, 0, false});
        break;
      }
      default:
        made.obstacles.push_back({{{{x + uniform(0, 20), uniform(12, 40)}}, {}}, uniform(1, 4), false});
    }
    x += length + uniform(0, 60);
  }
  made.start_x_mm = -60;
  made.exit_x_mm = x + 250;
  return made;
}

}  // namespace formotion::bench
