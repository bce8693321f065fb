// One design of a nest judged.
#pragma once

#include "applications/nest/nest_problem.hpp"

namespace formotion::nest {

struct Judged {
  NestEvaluation evaluation;
  double violation = 0;
  std::int64_t work = 0;  // starts projected, and cells looked at
};
// in_detail: finer, with pictures and limits, as people want them; else what a search needs.
Judged judge(const NestSpec& spec, int topology, std::span<const double> values, bool in_detail);

// The value of an objective; what does not exist counts as the worst one.
double objective(const Metrics& metrics, const std::string& name);

}  // namespace formotion::nest
