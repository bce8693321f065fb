#include "analysis/contact/trig_roots.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace formotion {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegreeOne = 1e-11;    // relative: smaller second harmonics move the zeros of the first by no more
constexpr double kOffCircle = 1e-2;     // eigenvalues farther from the unit circle are no zeros, however ill-placed
constexpr double kZero = 1e-13;         // relative
constexpr double kSameZero_rad = 1e-7;  // two of a touching zero

// Newton's steps, halved where they do not help.
double polished(const TrigPolynomial& f, double t) {
  double value = std::abs(f(t));
  for (int i = 0; i < 40 && value > 0; ++i) {
    const double slope = f.slope(t);
    if (slope == 0) break;
    double step = std::clamp(-f(t) / slope, -0.1, 0.1);
    double next = std::abs(f(t + step));
    while (next >= value && std::abs(step) > 1e-17) {
      step /= 2;
      next = std::abs(f(t + step));
    }
    if (next >= value) break;
    t += step;
    value = next;
  }
  return t;
}

}  // namespace

double TrigPolynomial::operator()(double t) const {
  const double c = std::cos(t), s = std::sin(t);
  return constant + cos1 * c + sin1 * s + cos2 * (c * c - s * s) + sin2 * 2 * s * c;
}

double TrigPolynomial::slope(double t) const {
  const double c = std::cos(t), s = std::sin(t);
  return -cos1 * s + sin1 * c + 2 * (sin2 * (c * c - s * s) - cos2 * 2 * s * c);
}

double TrigPolynomial::size() const {
  return std::abs(constant) + std::abs(cos1) + std::abs(sin1) + std::abs(cos2) + std::abs(sin2);
}

TrigPolynomial operator+(const TrigPolynomial& a, const TrigPolynomial& b) {
  return {a.constant + b.constant, a.cos1 + b.cos1, a.sin1 + b.sin1, a.cos2 + b.cos2, a.sin2 + b.sin2};
}

TrigPolynomial operator-(const TrigPolynomial& a, const TrigPolynomial& b) {
  return {a.constant - b.constant, a.cos1 - b.cos1, a.sin1 - b.sin1, a.cos2 - b.cos2, a.sin2 - b.sin2};
}

TrigPolynomial operator*(const TrigPolynomial& a, const TrigPolynomial& b) {
  TrigPolynomial p;
  p.constant = a.constant * b.constant + 0.5 * (a.cos1 * b.cos1 + a.sin1 * b.sin1);
  p.cos1 = a.constant * b.cos1 + a.cos1 * b.constant;
  p.sin1 = a.constant * b.sin1 + a.sin1 * b.constant;
  p.cos2 = a.constant * b.cos2 + a.cos2 * b.constant + 0.5 * (a.cos1 * b.cos1 - a.sin1 * b.sin1);
  p.sin2 = a.constant * b.sin2 + a.sin2 * b.constant + 0.5 * (a.cos1 * b.sin1 + a.sin1 * b.cos1);
  return p;
}

std::vector<double> zeros(const TrigPolynomial& f) {
  const double size = f.size();
  std::vector<double> candidates;
  const double first = std::hypot(f.cos1, f.sin1), second = std::hypot(f.cos2, f.sin2);
  if (second <= kDegreeOne * size) {
    if (!(first > 0)) return {};
    const double middle = std::atan2(f.sin1, f.cos1), ratio = -f.constant / first;
    if (std::abs(ratio) > 1 + kDegreeOne) return {};
    const double off = std::acos(std::clamp(ratio, -1.0, 1.0));
    candidates = {middle - off, middle + off};
  } else {
    using Complex = std::complex<double>;
    const Complex a2(f.cos2 / 2, -f.sin2 / 2), a1(f.cos1 / 2, -f.sin1 / 2);
    // a2 z^4 + a1 z^3 + constant z^2 + conj(a1) z + conj(a2)
    Eigen::Matrix4cd companion = Eigen::Matrix4cd::Zero(), vectors;
    companion.row(0) << -a1 / a2, Complex(-f.constant) / a2, -std::conj(a1) / a2, -std::conj(a2) / a2;
    for (int i = 0; i < 3; ++i) companion(i + 1, i) = 1;
    Eigen::ComplexSchur<Eigen::Matrix4cd> schur(4);
    schur.computeFromHessenberg(companion, vectors, false);
    for (int i = 0; i < 4; ++i) {
      const Complex z = schur.matrixT()(i, i);
      if (std::abs(std::abs(z) - 1) < kOffCircle) candidates.push_back(std::arg(z));
    }
  }
  std::vector<double> found;
  for (const double candidate : candidates) {
    double t = polished(f, candidate);
    if (std::abs(f(t)) > kZero * size) continue;
    t -= 2 * kPi * std::floor(t / (2 * kPi));
    if (t >= 2 * kPi) t = 0;
    const auto same = [&](double other) { return std::abs(std::remainder(t - other, 2 * kPi)) < kSameZero_rad; };
    if (std::none_of(found.begin(), found.end(), same)) found.push_back(t);
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace formotion
