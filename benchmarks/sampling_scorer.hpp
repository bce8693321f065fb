// The usual way to score a track: samples along the travel. Written as fast as we could: plain doubles, everything
// about a pose and a void's edges prepared once, the support cone instead of a hull where only the outcome is asked
// for, early exit at the first lost sample, no allocation while it samples.
#pragma once

#include "applications/feeder/part_model.hpp"
#include "applications/feeder/track_layout.hpp"

namespace formotion::bench {

struct SampledScore {
  bool lost = false;
  double margin_mm = 0;  // the least over the samples
};

class SamplingScorer {
 public:
  SamplingScorer(const feeder::PartModel& part, double track_width_mm) : part_(part), width_(track_width_mm) {}

  // Every pose of the part past the laid-out voids. stop_when_lost: outcomes alone.
  void score(const feeder::Layout& layout, double step_mm, bool stop_when_lost, std::vector<SampledScore>& scores);
  std::int64_t samples() const { return samples_; }

 private:
  SampledScore travel(const feeder::PoseModel& pose, const std::vector<Loop>& voids, double step, bool stop);

  const feeder::PartModel& part_;
  double width_;
  std::int64_t samples_ = 0;
  std::vector<Point> points_, hull_;
};

}  // namespace formotion::bench
