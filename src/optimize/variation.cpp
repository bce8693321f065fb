#include "optimize/variation.hpp"

#include <algorithm>
#include <cmath>

namespace formotion {
namespace {

constexpr double kSame = 1e-14;  // parents nearer than this have themselves as children

// The exponent is the distribution's index + 1.
double power_16(double x) {
  for (int i = 0; i < 4; ++i) x *= x;
  return x;
}

double root_16(double x) {
  for (int i = 0; i < 4; ++i) x = std::sqrt(x);
  return x;
}

}  // namespace

double crossed(double a, double b, RandomStream& random) {
  const double low = std::min(a, b), high = std::max(a, b), apart = high - low;
  const double u = random.uniform();
  const bool lower = random.below(2) == 0;
  if (apart < kSame) return a;
  const double room = lower ? low : 1 - high;
  const double alpha = 2 - power_16(1 / (1 + 2 * room / apart));
  const double spread = root_16(u * alpha <= 1 ? u * alpha : 1 / (2 - u * alpha));
  return std::clamp(0.5 * (low + high + (lower ? -spread : spread) * apart), 0.0, 1.0);
}

double mutated(double at, RandomStream& random) {
  const double u = random.uniform();
  const double shift = u < 0.5 ? root_16(2 * u + (1 - 2 * u) * power_16(1 - at)) - 1
                               : 1 - root_16(2 * (1 - u) + (2 * u - 1) * power_16(at));
  return std::clamp(at + shift, 0.0, 1.0);
}

double stepped(double at, double by, RandomStream& random) {
  const double u = random.uniform(), to = at + by;
  if (to < 0) return at * u;
  if (to > 1) return at + (1 - at) * u;
  return to;
}

}  // namespace formotion
