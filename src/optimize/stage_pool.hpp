// The stages that a search has tried: what composition builds tracks of.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "problem/staged_problem.hpp"

namespace formotion {

struct StageTrial {
  int kind = 0;
  std::vector<double> values;  // of the kind's variables
  StageResult result;
  StageDemand demanded;     // empty: its tolerance was not asked for
  double tolerance_mm = 0;  // up to which the demanded states end as the result says
  std::int64_t work = 0;    // of everything
};

struct StageRecord {
  std::int64_t number = 0;  // 1 is the run's first
  StageTrial trial;
  std::string provenance;
};

}  // namespace formotion
