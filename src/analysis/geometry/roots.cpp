#include "analysis/geometry/roots.hpp"

#include <algorithm>
#include <cmath>

namespace formotion {

double Quadratic::least_coefficient() const { return std::min({b0, b1, b2}); }
double Quadratic::greatest_coefficient() const { return std::max({b0, b1, b2}); }

int roots_in_unit(const Quadratic& q, std::array<double, 2>& roots) {
  if (q.least_coefficient() > 0 || q.greatest_coefficient() < 0) return 0;
  const double a = q.b0 - 2 * q.b1 + q.b2, half_b = q.b1 - q.b0, c = q.b0;  // a t^2 + 2 half_b t + c
  int count = 0;
  const auto keep = [&](double t) {
    if (t > 0 && t < 1) roots[count++] = t;
  };
  const double discriminant = half_b * half_b - a * c;
  if (discriminant < 0) return 0;
  // The stable pair: the root without cancellation, the other by Vieta.
  const double w = -(half_b + std::copysign(std::sqrt(discriminant), half_b));
  if (w == 0) return 0;  // a root at 0 only, or no equation
  if (a != 0) keep(w / a);
  if (discriminant > 0 || a == 0) keep(c / w);
  if (count == 2 && roots[0] > roots[1]) std::swap(roots[0], roots[1]);
  return count;
}

int stationary_in_unit(const Quadratic& numerator, const Quadratic& square, std::array<double, 3>& places) {
  // d(n / sqrt(s)) = 0  <=>  g = 2 n' s - n s' = 0, a cubic. Its derivative is
  // the quadratic 2 n'' s + n' s' - n s''.
  const auto n1 = [&](double t) {
    return 2 * ((numerator.b1 - numerator.b0) * (1 - t) + (numerator.b2 - numerator.b1) * t);
  };
  const auto s1 = [&](double t) { return 2 * ((square.b1 - square.b0) * (1 - t) + (square.b2 - square.b1) * t); };
  const auto g = [&](double t) { return 2 * n1(t) * square(t) - numerator(t) * s1(t); };
  const double n2 = 2 * (numerator.b0 - 2 * numerator.b1 + numerator.b2);
  const double s2 = 2 * (square.b0 - 2 * square.b1 + square.b2);
  const auto g1 = [&](double t) { return 2 * n2 * square(t) + n1(t) * s1(t) - numerator(t) * s2; };
  const double end0 = g1(0), end1 = g1(1), middle = g1(0.5);
  const Quadratic derivative{end0, 2 * middle - 0.5 * (end0 + end1), end1};
  std::array<double, 2> turns;
  const int turn_count = roots_in_unit(derivative, turns);

  int count = 0;
  double low = 0;
  for (int piece = 0; piece <= turn_count; ++piece) {
    const double high = piece < turn_count ? turns[piece] : 1;
    double a = low, b = high;
    const double ga = g(a), gb = g(b);
    if ((ga < 0) != (gb < 0)) {
      for (int i = 0; i < 60 && b - a > 1e-15; ++i) {
        const double m = 0.5 * (a + b);
        ((g(m) < 0) == (ga < 0) ? a : b) = m;
      }
      const double t = 0.5 * (a + b);
      if (t > 0 && t < 1 && count < 3) places[count++] = t;
    }
    low = high;
  }
  return count;
}

}  // namespace formotion
