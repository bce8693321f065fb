// What commands need of a problem whatever its kind: judged designs as JSON and drawings, a run's files, its report.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "io/problem_file.hpp"
#include "optimize/evaluated.hpp"
#include "optimize/run_summary.hpp"
#include "problem/problem.hpp"
#include "report/run_course.hpp"

namespace formotion {

class Kind {
 public:
  virtual ~Kind() = default;
  virtual const Problem& problem() const = 0;
  // Below, values are of all the problem's variables, in order. A design's shapes with literal numbers (`features`,
  // `fixed_mm`) and its `values`: keys of a design file.
  virtual nlohmann::ordered_json design_keys(int topology, std::span<const double> values) const = 0;
  // The answer of `evaluate`; as a drawing: format svg, dxf or stl.
  virtual nlohmann::ordered_json evaluation(int topology, std::span<const double> values) const = 0;
  virtual std::string drawing(int topology, std::span<const double> values, const std::string& format) const = 0;

  // One design of a run; format: json, svg, dxf or stl.
  virtual std::string design_file(const Evaluated& design, const std::string& format) const = 0;
  virtual std::string front_csv(const RunSummary& run) const = 0;
  virtual nlohmann::ordered_json report(const RunSummary& run, const ComparedRun* other) const = 0;
  virtual void write_files(const std::string& folder, const RunSummary& run) const = 0;
};

std::unique_ptr<Kind> feeder_kind(ProblemFile file);
std::unique_ptr<Kind> assembly_kind(ProblemFile file);
std::unique_ptr<Kind> nest_kind(ProblemFile file);
inline std::unique_ptr<Kind> kind_of(ProblemFile file) {
  return file.assembly ? assembly_kind(std::move(file))
         : file.nest   ? nest_kind(std::move(file))
                       : feeder_kind(std::move(file));
}

}  // namespace formotion
