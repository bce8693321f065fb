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
// A residual is what is missing of a target, in the target's unit (mm, N, N mm); 0 where it is met. What must not be
// missed for the sake of others is multiplied: least squares give way where residuals are in each other's way.
class SmoothPieces {
 public:
  virtual ~SmoothPieces() = default;
  virtual int residuals() const = 0;
  // Whether a residual has to be met wherever something else decides: the thing asked for is the least of many pieces.
  virtual bool lasts(int residual) const = 0;
  // values: of the candidate's variables. jacobian: by residuals, then by values; null if it is not wanted.
  // False where the pieces have no meaning (shapes that degenerate) or a derivative that is wanted does not exist.
  virtual bool evaluate(std::span<const double> values, double* residuals, double* jacobian) const = 0;
  // How many steps are worth taking on these pieces before scores say what they are worth: fewer where derivatives cost
  // as much as scores.
  virtual int steps() const { return 20; }
};

// What is asked for besides feasibility: that an objective reach a value. A candidate that is asked for a little more
// than it reaches becomes better.
struct SmoothAim {
  std::optional<std::size_t> objective;  // its place; those that have no residuals are left out
  double value = 0;
  // Per objective: the largest loss that the others may have (problem.hpp); empty or none: any. What has no residuals
  // is left out.
  std::vector<std::optional<double>> at_most = {};
};

class SmoothProblem {
 public:
  virtual ~SmoothProblem() = default;
  // The pieces that decide at the candidate. Null where nothing is missing, or nothing that is missing has derivatives.
  virtual std::unique_ptr<SmoothPieces> pieces(const Candidate& candidate, const SmoothAim& aim) const = 0;
};

}  // namespace formotion
