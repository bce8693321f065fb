// One design of a run as files: the entry of pareto.json, the drawings.
#pragma once

#include <string>
#include <vector>

#include "applications/feeder/feeder_problem.hpp"
#include "io/feeder_json.hpp"
#include "optimize/evaluated.hpp"

namespace formotion {

// A design judged in detail, once for all that is written of it.
struct JudgedDesign {
  Evaluated design;            // number 0: of no run
  std::vector<double> values;  // of all the problem's variables
  feeder::FeederEvaluation evaluation;
};

JudgedDesign judged(const feeder::FeederProblem& problem, const Evaluated& design);
std::vector<JudgedDesign> judged(const feeder::FeederProblem& problem, const std::vector<Evaluated>& designs);

// A valid design file that also says where it comes from and what it scored.
OrderedJson design_json(const feeder::FeederProblem& problem, const JudgedDesign& judged);
// name: the problem's.
std::string design_svg(const std::string& name, const feeder::FeederProblem& problem, const JudgedDesign& judged);
std::string design_dxf(const std::string& name, const feeder::FeederProblem& problem, const JudgedDesign& judged);
std::string design_stl(const std::string& name, const feeder::FeederProblem& problem, const JudgedDesign& judged);

}  // namespace formotion
