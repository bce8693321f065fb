// The files of a run's front, written alike for every kind.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "optimize/named_point.hpp"
#include "optimize/run_summary.hpp"
#include "problem/problem.hpp"

namespace formotion {

// Writes a file whole or not at all (a temporary beside it, then a rename). Throws StoreError.
void write_file(const std::string& path, const std::string& text, const NamedPoint& at_point = {});

// pareto.json first, then designs/ID.FORMAT (designs of earlier ends are removed before the first), then report.html.
class FrontFiles {
 public:
  explicit FrontFiles(std::string folder, NamedPoint at_point = {})
      : folder_(std::move(folder)), at_point_(std::move(at_point)) {}
  void pareto(const std::string& name, const Problem& problem, const RunSummary& run, nlohmann::ordered_json designs);
  void design(const std::string& id, const std::string& format, const std::string& text);
  void page(const nlohmann::ordered_json& data);

 private:
  std::string folder_;
  NamedPoint at_point_;
};

// The text of pareto.json.
std::string pareto_text(const std::string& name, const Problem& problem, const RunSummary& run,
                        nlohmann::ordered_json designs);
std::string csv_field(const std::string& text);  // RFC 4180
// Objectives and values of the front, a line a design.
std::string scores_csv(const Problem& problem, const RunSummary& run);

}  // namespace formotion
