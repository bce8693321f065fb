// One design of a problem, as evaluate and query are asked for it.
#pragma once

#include <vector>

#include "commands.hpp"
#include "io/problem_file.hpp"

namespace formotion {

struct ChosenDesign {
  ProblemFile file;  // the design file's design (if any) in place of its own
  int topology = 0;
  std::vector<double> values;  // of all the problem's variables: given ones, else starting values
};

// Throws InputError for what the choice names wrongly.
ChosenDesign chosen_design(const DesignChoice& choice);

}  // namespace formotion
