// How a run went, for the report: its history with the hypervolume that its front dominated, alone or beside another
// run of the same objectives.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "optimize/run_summary.hpp"

namespace formotion {

// Another run, to compare with.
struct ComparedRun {
  std::string name;                 // of its problem, and its folder
  std::vector<std::string> labels;  // of its topologies
  RunSummary run;
};

// The box in which hypervolumes are measured: from the least to the greatest losses of feasible designs, of both runs.
// Empty while there are none.
struct CourseBox {
  std::vector<double> least, most;
};
CourseBox course_box(const RunSummary& run, const ComparedRun* other);

// [{evaluations, work, front, best, hypervolume}], one entry a batch.
nlohmann::ordered_json course_json(const RunSummary& run, const CourseBox& box);
nlohmann::ordered_json compared_json(const ComparedRun* other, const CourseBox& box);  // null without

}  // namespace formotion
