// Everything the report page shows, as one JSON value: the run, and every design of its front judged in detail.
#pragma once

#include <nlohmann/json.hpp>

#include "applications/feeder/feeder_problem.hpp"
#include "io/problem_file.hpp"
#include "optimize/run_summary.hpp"
#include "report/design_files.hpp"
#include "report/run_course.hpp"

namespace formotion {

// front: run.front, judged. other: a run of the same objectives to compare with, or null.
nlohmann::ordered_json report_data(const ProblemFile& file, const feeder::FeederProblem& problem, const RunSummary& run,
                                   const std::vector<JudgedDesign>& front, const ComparedRun* other = nullptr);

}  // namespace formotion
