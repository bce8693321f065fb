// Everything the report page shows, as one JSON value: the run, and every design of its front judged in detail.
#pragma once

#include <nlohmann/json.hpp>

#include "applications/feeder/feeder_problem.hpp"
#include "io/problem_file.hpp"
#include "optimize/run_summary.hpp"
#include "report/design_files.hpp"

namespace formotion {

// front: run.front, judged.
nlohmann::ordered_json report_data(const ProblemFile& file, const feeder::FeederProblem& problem, const RunSummary& run,
                                   const std::vector<JudgedDesign>& front);

}  // namespace formotion
