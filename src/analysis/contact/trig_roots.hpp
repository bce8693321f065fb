// Zeros of trigonometric polynomials of degree two on the circle.
#pragma once

#include <vector>

namespace formotion {

// constant + cos1 cos t + sin1 sin t + cos2 cos 2t + sin2 sin 2t.
struct TrigPolynomial {
  double constant = 0, cos1 = 0, sin1 = 0, cos2 = 0, sin2 = 0;
  double operator()(double t) const;
  double slope(double t) const;
  double size() const;  // sum of the coefficients' sizes: a bound on its values
};

TrigPolynomial operator+(const TrigPolynomial& a, const TrigPolynomial& b);
TrigPolynomial operator-(const TrigPolynomial& a, const TrigPolynomial& b);
// Of factors whose degrees sum up to two at most.
TrigPolynomial operator*(const TrigPolynomial& a, const TrigPolynomial& b);

// All zeros in [0, 2 pi), ascending, at most four; touching ones once. Values below 1e-13 of the size are zero; nothing
// for a polynomial without size. By the eigenvalues on the unit circle of the companion matrix in z = e^(it), polished.
std::vector<double> zeros(const TrigPolynomial& f);

}  // namespace formotion
