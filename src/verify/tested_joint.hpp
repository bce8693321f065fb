// A stored assembly made ready for checks: its values, and what results say of it in detail.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "applications/assembly/assembly_problem.hpp"
#include "optimize/evaluated.hpp"
#include "optimize/random_stream.hpp"

namespace formotion {

struct TestedJoint {
  const assembly::AssemblyProblem& problem;
  const Evaluated& stored;
  int topology = 0;
  std::vector<double> values;               // of all the problem's variables
  assembly::AssemblyEvaluation evaluation;  // in detail, as pareto.json and evaluate give it

  const assembly::AssemblySpec& spec() const { return problem.spec(); }
  std::unique_ptr<assembly::Scene> scene() const { return problem.scene(topology, values, "up", 0); }
  // A part held wrongly, that is done as soon as it is as deep as the goal, wherever it stands.
  std::unique_ptr<assembly::Scene> scene(const assembly::NeverResult& wrong) const;
};

TestedJoint tested_joint(const assembly::AssemblyProblem& problem, const Evaluated& stored);

std::string start_text(double x_mm, double y_mm, double theta_rad);  // "the start x 0.5 mm, y 0 mm, theta -1 deg"
std::string never_text(const assembly::NeverResult& wrong);          // "the part held down at 180 deg"

// Where numbers are written in words: six digits.
std::string number_text(double value);

}  // namespace formotion
