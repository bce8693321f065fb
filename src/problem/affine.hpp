// Expressions affine in the problem's variables: the numbers of a design.
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

namespace formotion {

// constant + sum of coefficient * variable; a plain number has no terms.
struct Affine {
  double constant = 0;
  std::vector<std::pair<int, double>> terms;  // (index of the problem's variable, coefficient), ascending indices

  bool is_literal() const { return terms.empty(); }
  double operator()(std::span<const double> variables) const {
    double value = constant;
    for (const auto& [index, coefficient] : terms) value += coefficient * variables[index];
    return value;
  }
};

using AffinePoint = std::array<Affine, 2>;
using AffineLoop = std::vector<AffinePoint>;

}  // namespace formotion
