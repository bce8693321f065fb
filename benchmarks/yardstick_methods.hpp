// The methods that are compared, each until its work is spent, on one thread.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "yardstick_run.hpp"

namespace formotion::bench {

struct Method {
  std::string name;
  std::string text;  // what it is
  bool ours = false;
  // evaluations: what the engine is told to plan with; about as many designs as the work allows.
  YardstickRun (*search)(const Problem& problem, std::int64_t work, std::int64_t evaluations, std::uint64_t seed);
};

// The program's own search comes first.
const std::vector<Method>& methods();

}  // namespace formotion::bench
