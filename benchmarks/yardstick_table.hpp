// What many runs of many methods on one problem come to: a table, and the same as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "yardstick_methods.hpp"

namespace formotion::bench {

struct MethodRuns {
  const Method* method = nullptr;
  std::vector<YardstickRun> runs;  // one a seed
};

struct Comparison {
  std::string problem_name;
  const Problem* problem = nullptr;
  std::int64_t work = 0, evaluations = 0;
  std::vector<MethodRuns> methods;  // the program's own search first
};

nlohmann::ordered_json compared(const Comparison& comparison);
std::string as_text(const nlohmann::ordered_json& comparison);

// Of problems whose best tolerance is known in closed form.
std::optional<double> known_best_tolerance_mm(const std::string& problem_name);

}  // namespace formotion::bench
