// One design of a problem, as evaluate and query are asked for it.
#pragma once

#include <memory>
#include <vector>

#include "applications/feeder/feeder_problem.hpp"
#include "commands.hpp"
#include "io/problem_file.hpp"

namespace formotion {

struct ChosenDesign {
  std::string name;  // of the problem
  std::unique_ptr<feeder::FeederProblem> problem;
  int topology = 0;
  std::vector<double> values;  // of all the problem's variables: given ones, else starting values
};

// As read_problem_file; InputError for problems of kinds that are not scored yet.
ProblemFile read_feeder_problem(const std::string& path);

// Throws InputError for what the choice names wrongly.
ChosenDesign chosen_design(const DesignChoice& choice);

}  // namespace formotion
