// A stored fixture or pallet made ready for checks.
#pragma once

#include <vector>

#include "applications/nest/nest_problem.hpp"
#include "optimize/evaluated.hpp"

namespace formotion {

struct TestedNest {
  const nest::NestProblem& problem;
  const Evaluated& stored;
  int topology = 0;
  std::vector<double> values;       // of all the problem's variables
  nest::NestEvaluation evaluation;  // in detail, as pareto.json and evaluate give it

  const nest::NestSpec& spec() const { return problem.spec(); }
};

}  // namespace formotion
