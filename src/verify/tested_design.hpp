// A stored design made ready for checks: its part, its track as one plain layout, what it claims; and how arrivals end
// on another track than that.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "applications/feeder/pose_travel.hpp"
#include "applications/feeder/turning.hpp"
#include "optimize/evaluated.hpp"

namespace formotion {

struct TestedDesign {
  const feeder::FeederProblem& problem;
  const Evaluated& stored;
  std::vector<double> values;  // of all the problem's variables
  feeder::PartModel part;
  feeder::Layout layout;  // as scored
  feeder::Layout plain;   // the same track: united voids and obstacles in place of features
  feeder::FeederEvaluation evaluation;
  bool turns = false, belt = false, has_voids = false;
  std::vector<feeder::PoseTravel> arrivals = {};  // nominal; poses, or on a belt the map's intervals
  double claimed_mm = 0;                          // the tolerance, as stored

  const feeder::Environment& environment() const { return problem.spec().environment; }
  std::string pose_name(const feeder::PoseTravel& arrival) const;  // "pose down 90.00 deg"
};

TestedDesign tested_design(const feeder::FeederProblem& problem, const Evaluated& stored);

// The voids of the layout (united where they meet) as one feature a group, then everything that stands on the track.
feeder::Layout plain_layout(const feeder::Layout& layout);
// Gives a feature these voids (in the world's frame, void on the left).
void set_voids(feeder::LaidFeature& feature, std::vector<Loop> voids);
// The layout as features with literal numbers; none where a void has an island.
std::optional<feeder::DesignSpec> literal_features(const feeder::Layout& plain);

// How arrivals end on a track that is nearly the design's.
struct Comparison {
  std::optional<std::string> difference;  // the first arrival that ends otherwise
  int newly_jammed = 0;                   // lost as before, but stuck (of passive tracks)
  double least_margin_mm = 1e300;         // of what is delivered
  double least_depth_mm = 1e300;          // of what is lost, where a depth is known
};
struct CompareOptions {
  feeder::TrackErrors errors;  // where parts turn
  // Which arrivals: those delivered, those lost, or both.
  bool delivered = true, lost = true;
};
Comparison compare_ends(const TestedDesign& design, const feeder::Layout& other, const CompareOptions& options = {});

}  // namespace formotion
