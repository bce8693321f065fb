#include "shaking/shaking.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shaking/shaken_world.hpp"

namespace formotion {
namespace {

// What a start at rest is disturbed by: far below what vibration gives (a rise of about a thousandth of a mm), enough
// for runs to differ.
constexpr double kDisturbance_mm_s = 5;

// The n-th number of a seed in [0, 1): SplitMix64's output function over a mix of both (Steele, Lea, Flood 2014).
std::uint64_t mixed(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}
double uniform(std::uint64_t seed, std::uint64_t n) {
  return static_cast<double>(mixed(mixed(seed) + n) >> 11) * 0x1.0p-53;
}

double reach(const Polygon& part) {
  double reach = 0;
  for (const Point& p : part.outer) reach = std::max(reach, p.norm());
  return reach;
}

}  // namespace

Shaken shake(const ShakenScene& scene, const Configuration& start, const ShakeOptions& options) {
  double from = 1e300, to = -1e300;
  for (const Polygon& solid : scene.nest) {
    for (const Point& p : solid.outer) {
      from = std::min(from, scene.gravity.across_mm(p));
      to = std::max(to, scene.gravity.across_mm(p));
    }
  }
  const auto disturbance = [&](std::uint64_t n) { return kDisturbance_mm_s * (2 * uniform(options.seed, n) - 1); };
  ShakenStart disturbed;
  disturbed.at = start;
  disturbed.phase_rad = 2 * std::numbers::pi * uniform(options.seed, 0);
  disturbed.velocity.linear = Point(disturbance(1), disturbance(2));
  disturbed.velocity.angular = disturbance(3) / reach(scene.part);

  ShakenWorld world(scene, disturbed, options.step_s);
  const double height = scene.gravity.height_mm(start);
  Shaken shaken;
  shaken.last = start;
  const long steps = std::lround(options.seconds / options.step_s);
  const long look_every = std::max(1L, std::lround(options.look_every_s / options.step_s));
  bool was_right = false;
  for (long i = 1; i <= steps; ++i) {
    world.step();
    shaken.last = world.part();
    shaken.highest_mm = std::max(shaken.highest_mm, scene.gravity.height_mm(shaken.last) - height);
    const double across = scene.gravity.across_mm(shaken.last.position());
    if (across < from || across > to) {
      shaken.left_after_s = world.time_s();
      break;
    }
    if (!options.is_right || i % look_every != 0) continue;
    const bool is_right = options.is_right(settled(scene, shaken.last, options.step_s));
    if (is_right && was_right) {
      shaken.right_after_s = world.time_s();
      break;
    }
    was_right = is_right;
  }
  return shaken;
}

Configuration settled(const ShakenScene& scene, const Configuration& from, double step_s) {
  constexpr double kMost_s = 2, kStill_s = 0.03, kStill_mm_s = 2;
  ShakenScene still = scene;
  still.friction = 0;
  still.table = {0, 0, 0};
  ShakenWorld world(still, {from, {}, 0}, step_s);
  const double size = reach(scene.part);
  double moved_s = 0;
  while (world.time_s() < kMost_s && world.time_s() - moved_s < kStill_s) {
    world.step();
    const Twist v = world.velocity();
    if (v.linear.norm() + size * std::abs(v.angular) > kStill_mm_s) moved_s = world.time_s();
  }
  return world.part();
}

ShareInterval wilson_95(int count, int runs) {
  if (runs <= 0) return {};
  const double n = runs, z = 1.959963984540054, p = count / n;
  const double middle = (p + z * z / (2 * n)) / (1 + z * z / n);
  const double half = z / (1 + z * z / n) * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n));
  return {std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

ShakenShare share_that_leaves(const ShakenScene& scene, const Configuration& start, int runs,
                              const ShakeOptions& options) {
  ShakenShare share;
  share.runs = std::max(runs, 0);
  double seconds = 0;
  for (int run = 0; run < runs; ++run) {
    ShakeOptions own = options;
    own.seed = mixed(options.seed) + static_cast<std::uint64_t>(run);
    const Shaken shaken = shake(scene, start, own);
    share.highest_mm = std::max(share.highest_mm, shaken.highest_mm);
    share.left += shaken.left_after_s.has_value();
    share.right += shaken.right_after_s.has_value();
    const double after = shaken.left_after_s.value_or(shaken.right_after_s.value_or(0));
    seconds += after;
    share.last_seconds = std::max(share.last_seconds, after);
  }
  const int gone = share.left + share.right;
  if (gone > 0) share.mean_seconds = seconds / gone;
  if (runs <= 0) return share;
  share.share = static_cast<double>(gone) / runs;
  const ShareInterval interval = wilson_95(gone, runs);
  share.low = interval.low;
  share.high = interval.high;
  return share;
}

}  // namespace formotion
