// The space of one topology's candidates, as a unit cube: what drivers search in.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "problem/problem.hpp"

namespace formotion {

// Variables with equal bounds are fixed: NLopt must not see them.
class DesignSpace {
 public:
  DesignSpace(const Problem& problem, int topology);
  // Of variables alone, as those of a kind of stage; its candidates name topology 0.
  explicit DesignSpace(std::span<const Variable> variables);

  int dimensions() const { return static_cast<int>(free_.size()); }
  // unit: dimensions() numbers, clamped to [0, 1].
  Candidate at(std::span<const double> unit) const;
  std::vector<double> unit_of(const Candidate& candidate) const;
  // The user's guess, or the middle.
  std::vector<double> start() const;
  // Point number index (from 0) of a scrambled low-discrepancy sequence (Halton 1960, digits shifted by seed).
  std::vector<double> spread_point(std::uint64_t index, std::uint64_t seed) const;

 private:
  void add(const Variable& variable);

  int topology_ = 0;
  std::vector<double> low_, high_, guess_;  // of the topology's variables
  std::vector<int> free_;                   // which of them can move
};

}  // namespace formotion
