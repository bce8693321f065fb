// Polynomials of low degree on [0, 1] in Bernstein form: signs are bounded by the coefficients, and roots are safe.
#pragma once

#include <array>

namespace formotion {

// b0 (1-t)^2 + 2 b1 t (1-t) + b2 t^2. Positive (negative) on [0, 1] if all coefficients are.
struct Quadratic {
  double b0 = 0, b1 = 0, b2 = 0;
  double operator()(double t) const {
    const double s = 1 - t;
    return b0 * s * s + 2 * b1 * s * t + b2 * t * t;
  }
  double least_coefficient() const;
  double greatest_coefficient() const;
};

// Roots of q in (0, 1), ascending; touching roots once. Returns how many (0 to 2).
int roots_in_unit(const Quadratic& q, std::array<double, 2>& roots);

// Places in (0, 1) where numerator / sqrt(square) has a zero derivative: the roots of a cubic, found between the
// zeros of its own derivative by bisection. Returns how many (0 to 3). square must be positive.
int stationary_in_unit(const Quadratic& numerator, const Quadratic& square, std::array<double, 3>& places);

}  // namespace formotion
