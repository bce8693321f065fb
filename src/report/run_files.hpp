// A run's folder as users see it: problem.json, pareto.json, report.html and the designs, all made from the store.
#pragma once

#include <string>

#include "applications/feeder/feeder_problem.hpp"
#include "io/problem_file.hpp"
#include "optimize/named_point.hpp"
#include "optimize/run_store.hpp"
#include "optimize/run_summary.hpp"
#include "report/design_files.hpp"
#include "report/front_files.hpp"

namespace formotion {

// The problem as run: a problem file with the program's version and options beside it.
std::string problem_json_text(const ProblemFile& file, const RunIdentity& identity);
std::string designs_csv(const feeder::FeederProblem& problem, const std::vector<JudgedDesign>& front);

// pareto.json, report.html and designs/ID.{json,svg,dxf,stl} of the whole front; designs of earlier ends are removed.
void write_run_files(const std::string& folder, const ProblemFile& file, const feeder::FeederProblem& problem,
                     const RunSummary& run, const NamedPoint& at_point = {});

}  // namespace formotion
