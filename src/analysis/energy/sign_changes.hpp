// Zeros of a smooth function between samples.
#pragma once

#include <cmath>
#include <span>
#include <vector>

namespace formotion {

// Adds to `found` where f crosses zero between samples, touches it (a zero that is the extremum of three samples'
// parabola), or begins or ends to be zero. values: f at places (ascending); within tolerance of zero is zero.
template <typename Function>
void add_sign_changes(std::span<const double> places, std::span<const double> values, double tolerance,
                      const Function& f, std::vector<double>& found) {
  const auto sign = [&](double value) { return value > tolerance ? 1 : value < -tolerance ? -1 : 0; };
  const auto crossing = [&](double from, double to, int sign_from) {
    for (int i = 0; i < 60 && to > from; ++i) {
      const double middle = 0.5 * (from + to);
      if (middle <= from || middle >= to) break;
      (sign(f(middle)) == sign_from ? from : to) = middle;
    }
    return 0.5 * (from + to);
  };
  const std::size_t count = places.size();
  for (std::size_t k = 0; k < count; ++k) {
    const int here = sign(values[k]);
    if (here == 0) {
      const bool alone = (k > 0 && sign(values[k - 1]) != 0) || (k + 1 < count && sign(values[k + 1]) != 0);
      if (alone) found.push_back(places[k]);
      continue;
    }
    if (k + 1 < count && here * sign(values[k + 1]) < 0) found.push_back(crossing(places[k], places[k + 1], here));
    // A dip between samples.
    if (k == 0 || k + 1 >= count || sign(values[k - 1]) != here || sign(values[k + 1]) != here) continue;
    const double before = here * values[k - 1], middle = here * values[k], after = here * values[k + 1];
    const double bend = before + after - 2 * middle;
    if (middle > before || middle > after || bend <= 0) continue;
    if (middle - (after - before) * (after - before) / (8 * bend) > 0.3 * bend) continue;
    double low = places[k - 1], high = places[k + 1];
    for (int i = 0; i < 50; ++i) {  // golden sections would save half of this
      const double one = low + (high - low) / 3, other = high - (high - low) / 3;
      (here * f(one) < here * f(other) ? high : low) = here * f(one) < here * f(other) ? other : one;
    }
    const double least = 0.5 * (low + high);
    const int there = sign(f(least));
    if (there == here) continue;
    if (there == 0) {
      found.push_back(least);
      continue;
    }
    found.push_back(crossing(places[k - 1], least, here));
    found.push_back(crossing(least, places[k + 1], there));
  }
}

}  // namespace formotion
