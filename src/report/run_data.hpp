// What the report page shows of a run whatever its kind: the search, its course, the head of every design.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "io/problem_file.hpp"
#include "optimize/evaluated.hpp"
#include "optimize/run_summary.hpp"
#include "problem/problem.hpp"
#include "report/run_course.hpp"

namespace formotion {

// Rounded to 1e-6; null for what is not finite.
nlohmann::ordered_json fine(double value);
// Every measured number of a value; what must be exact (values, shapes) is put in afterwards.
void round_all(nlohmann::ordered_json& json);

// Into the page's `problem`: objectives, variables, topologies, the file's text.
void add_search_space(nlohmann::ordered_json& json, const ProblemFile& file, const Problem& problem,
                      const RunSummary& run);
// Into the page: run, history, compared, findings, sample, knee.
void add_run(nlohmann::ordered_json& json, const Problem& problem, const RunSummary& run, const ComparedRun* other);

// A design's id, number, topology, label, provenance, scores and stamp. stamps: by id.
nlohmann::ordered_json design_head(const Problem& problem, const Evaluated& design,
                                   const std::map<std::string, std::string>& stamps);
// The commands that judge and export it.
nlohmann::ordered_json commands_json(const ProblemFile& file, const std::string& id);

}  // namespace formotion
