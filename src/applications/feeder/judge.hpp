// One design, judged: what every arrival's end means for the goal, what is violated and by how much.
#pragma once

#include <cstdint>
#include <span>

#include "applications/feeder/evaluation.hpp"
#include "applications/feeder/part_model.hpp"

namespace formotion::feeder {

struct DesignCase {
  const FeederSpec& spec;
  const DesignSpec& features;
  const PartModel& part;
  const std::vector<Violation>& part_defects;
  std::span<const double> values;  // of all the problem's variables
};

struct Judged {
  FeederEvaluation evaluation;
  double violation = 0;   // 0 iff feasible
  std::int64_t work = 0;  // pose-feature sweeps, or starts projected
};

// in_detail: also unsupported travel, sentences, the tolerance of infeasible designs and the worst case; they cost more
// than the score needs.
Judged judge(const DesignCase& design, bool in_detail);

std::vector<Violation> defects_of(const PartModel& part);

}  // namespace formotion::feeder
