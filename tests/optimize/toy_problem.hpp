// Problems with known answers for the search.
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>

#include "problem/problem.hpp"

namespace formotion {

// Two topologies. "line": x in [0, 10], gain = 3 - |x - 7| feasible where positive, cost = x.
// "plane": x in [0, 10] and y in [-1, 1], gain = 4 - |x - 2| - |y - 0.5|, feasible where above 3, cost = 20 + y.
class ToyProblem final : public Problem {
 public:
  std::span<const Variable> variables() const override { return variables_; }
  std::span<const Topology> topologies() const override { return topologies_; }
  std::span<const Objective> objectives() const override { return objectives_; }
  Score score(const Candidate& c, Memory* = nullptr) const override {
    ++scored;
    const double x = c.values[0];
    const double gain = c.topology == 0 ? 3 - std::abs(x - 7) : 4 - std::abs(x - 2) - std::abs(c.values[1] - 0.5);
    const double lacking = (c.topology == 0 ? 0 : 3) - gain;
    Score score;
    score.feasible = lacking < 0;
    score.violation = std::max(0.0, lacking) + (score.feasible ? 0 : 1e-9);
    score.objectives = {gain, c.topology == 0 ? x : 20 + c.values[1]};
    score.worst_case = score.objectives;
    score.work = 1;
    return score;
  }

  mutable std::atomic<int> scored{0};

 private:
  std::vector<Variable> variables_{{"x", 0, 10, std::nullopt}, {"y", -1, 1, std::nullopt}};
  std::vector<Topology> topologies_{{"line", {0}}, {"plane", {0, 1}}};
  std::vector<Objective> objectives_{{"gain", true, 1e-9, false}, {"cost", false, 1e-9, false}};
};

}  // namespace formotion
