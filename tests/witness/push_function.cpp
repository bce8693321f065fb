#include "witness/push_function.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace formotion::witness {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

double in_turn(double angle) {
  const double a = std::fmod(angle, kTurn);
  return a < 0 ? a + kTurn : a;
}

// The hull by wrapping, counter-clockwise: the next corner is the one that all others are to the left of.
Loop wrapped_hull(const Loop& corners) {
  std::size_t lowest = 0;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const Point &a = corners[i], &b = corners[lowest];
    if (a.y() < b.y() || (a.y() == b.y() && a.x() > b.x())) lowest = i;
  }
  Loop hull;
  std::size_t at = lowest;
  do {
    hull.push_back(corners[at]);
    std::size_t next = at == 0 ? 1 : 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Point to = corners[i] - corners[at], best = corners[next] - corners[at];
      const double side = cross(best, to), slack = 1e-12 * best.norm() * to.norm();
      if (side < -slack || (side <= slack && to.norm() > best.norm())) next = i;
    }
    at = next;
  } while (at != lowest && hull.size() <= corners.size());
  return hull;
}

}  // namespace

double PushFunction::rest(double start_rad) const {
  // The rest that lies in the same basin: between the same two bounds.
  const double start = in_turn(start_rad);
  for (const double rest : rests_rad) {
    const double up = in_turn(rest - start), down = in_turn(start - rest);
    const auto between = [](double from, double bound, double width) { return in_turn(bound - from) < width; };
    const bool barred_up =
        std::any_of(bounds_rad.begin(), bounds_rad.end(), [&](double bound) { return between(start, bound, up); });
    const bool barred_down =
        std::any_of(bounds_rad.begin(), bounds_rad.end(), [&](double bound) { return between(rest, bound, down); });
    if (!barred_up || !barred_down) return rest;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

double PushFunction::off_bounds(double start_rad) const {
  double least = std::numeric_limits<double>::infinity();
  for (const double bound : bounds_rad) least = std::min(least, std::abs(std::remainder(start_rad - bound, kTurn)));
  return least;
}

PushFunction push_function(const Loop& corners, double friction) {
  const Loop hull = wrapped_hull(corners);
  const std::size_t n = hull.size();
  const double lean = std::atan(friction);
  // While corner k is lowest the turning torque is |a_k| cos(arg a_k + theta - lean). Edge k (from corner k to the
  // next) lies on the wall at theta = -arg(edge k); from there to the left corner k is lowest.
  const auto flush = [&](std::size_t k) {
    const Point along = hull[(k + 1) % n] - hull[k % n];
    return -std::atan2(along.y(), along.x());
  };
  const auto torque = [&](std::size_t k, double theta) {
    const Point& a = hull[k % n];
    return a.norm() * std::cos(std::atan2(a.y(), a.x()) + theta - lean);
  };
  PushFunction push;
  for (std::size_t k = 0; k < n; ++k) {
    const double at = flush(k);
    if (torque(k + 1, at) > 0 && torque(k, at) < 0) push.rests_rad.push_back(in_turn(at));
    // The torque changes from right-turning to left-turning over corner k: a maximum of the work.
    const double width = in_turn(flush(k + n - 1) - at);
    const double balance = lean - std::numbers::pi / 2 - std::atan2(hull[k].y(), hull[k].x());
    if (in_turn(balance - at) < width) push.bounds_rad.push_back(in_turn(balance));
  }
  std::sort(push.bounds_rad.begin(), push.bounds_rad.end());
  std::sort(push.rests_rad.begin(), push.rests_rad.end());
  return push;
}

}  // namespace formotion::witness
