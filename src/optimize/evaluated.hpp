// What a run keeps of every candidate that it scored.
#pragma once

#include <cstdint>
#include <string>

#include "problem/problem.hpp"

namespace formotion {

struct Evaluated {
  std::int64_t number = 0;  // 1 is the run's first evaluation
  Candidate candidate;
  Score score;
  std::string provenance;  // which driver proposed it, in words
};

// A design's name in files and on the command line: "d" and the number of its evaluation.
inline std::string design_id(const Evaluated& evaluated) { return "d" + std::to_string(evaluated.number); }

}  // namespace formotion
