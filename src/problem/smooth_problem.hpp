// A problem that can say what its candidates lack as residuals with derivatives. Types alone; no application is known
// here.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "problem/problem.hpp"

namespace formotion {

// Residuals near one candidate: smooth functions of the candidate's values, as long as what decides them there decides.
// A residual is what is missing of a target, in mm; 0 where it is met.
class SmoothPieces {
 public:
  virtual ~SmoothPieces() = default;
  virtual int residuals() const = 0;
  // Whether a residual has to be met wherever something else decides: the thing asked for is the least of many pieces.
  virtual bool lasts(int residual) const = 0;
  // values: of the candidate's variables. jacobian: by residuals, then by values; null if it is not wanted.
  // False where the pieces have no meaning: shapes that degenerate.
  virtual bool evaluate(std::span<const double> values, double* residuals, double* jacobian) const = 0;
};

// What is asked for besides feasibility: that an objective reach a value. A candidate that is asked for a little more
// than it reaches becomes better.
struct SmoothAim {
  std::optional<std::size_t> objective;  // its place; those that have no residuals are left out
  double value = 0;
};

class SmoothProblem {
 public:
  virtual ~SmoothProblem() = default;
  // The pieces that decide at the candidate. Null where nothing is missing, or nothing that is missing has derivatives.
  virtual std::unique_ptr<SmoothPieces> pieces(const Candidate& candidate, const SmoothAim& aim) const = 0;
};

}  // namespace formotion
