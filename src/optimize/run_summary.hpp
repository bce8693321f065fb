// A run as its reports need it.
#pragma once

#include <cstdint>
#include <vector>

#include "optimize/evaluated.hpp"

namespace formotion {

struct RunProgress {
  std::int64_t evaluations = 0;  // so far
  std::int64_t front_size = 0;
  std::vector<double> best;  // per objective, among feasible designs; empty while there is none
};

struct RunSummary {
  std::int64_t evaluations = 0, budget = 0, feasible = 0;
  std::uint64_t seed = 0;
  std::string program_version;
  bool complete = false;
  std::vector<Evaluated> front;      // non-dominated feasible designs; if there is none, the nearest infeasible ones
  std::vector<Evaluated> sample;     // at most 3,000 of all evaluations, evenly spaced over the run
  std::vector<RunProgress> history;  // one entry a batch
};

}  // namespace formotion
