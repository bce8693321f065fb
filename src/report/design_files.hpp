// One design of a run as files: the entry of pareto.json, the drawings.
#pragma once

#include <string>
#include <vector>

#include "applications/feeder/feeder_problem.hpp"
#include "io/feeder_json.hpp"
#include "io/problem_file.hpp"
#include "optimize/evaluated.hpp"

namespace formotion {

// A valid design file that also says where it comes from and what it scored.
OrderedJson design_json(const feeder::FeederProblem& problem, const Evaluated& design);
std::string design_svg(const ProblemFile& file, const feeder::FeederProblem& problem, const Evaluated& design);
std::string design_dxf(const ProblemFile& file, const feeder::FeederProblem& problem, const Evaluated& design);

}  // namespace formotion
