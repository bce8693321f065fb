// One design, judged: what every arrival's end means for the goal, what is violated and by how much.
#pragma once

#include <cstdint>
#include <span>

#include "applications/feeder/evaluation.hpp"
#include "applications/feeder/part_model.hpp"
#include "applications/feeder/part_spread.hpp"
#include "applications/feeder/passages.hpp"
#include "applications/feeder/turning.hpp"

namespace formotion::feeder {

struct DesignCase {
  const FeederSpec& spec;
  const DesignSpec& features;
  const PartModel& part;
  const std::vector<Violation>& part_defects;
  std::span<const double> values;    // of all the problem's variables
  const Spreads* spreads = nullptr;  // of the part, where something is uncertain
};

struct Judged {
  FeederEvaluation evaluation;
  double violation = 0;   // 0 iff feasible
  std::int64_t work = 0;  // pose-feature sweeps, or starts projected
};

// in_detail: also unsupported travel, sentences, the tolerance of infeasible designs and the worst case; they cost more
// than the score needs. passages: of the design's part, always asked with the same in_detail.
Judged judge(const DesignCase& design, bool in_detail, Passages& passages);

std::vector<Violation> defects_of(const PartModel& part);

double objective(const Metrics& metrics, const std::string& name);  // what does not exist is worth 0

std::string pose_name(const PartModel& part, const StablePose& pose);  // "up 90.00 deg"
// "pose up 90.00 deg", or on a belt "starts up 10.00 to 20.00 deg".
std::string arrival_name(const PartModel& part, const TurningEvaluation& travels, std::size_t i, bool on_belt);
bool named_by_goal(const Goal& goal, const PartModel& part, const StablePose& pose);

}  // namespace formotion::feeder
