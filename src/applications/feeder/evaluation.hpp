// What the feeder application says of one design.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/contact/shapes.hpp"

namespace formotion::feeder {

enum class Outcome { Undecided, Delivered, Rejected, Jammed, Ambiguous };
const char* name(Outcome outcome);

struct Violation {
  std::string what, where;
  double by = 0;
};

struct Decision {
  int feature = 0;  // index in the design
  double x_mm = 0;  // the centre of mass's position along the track at the deciding instant
};

struct PoseResult {
  std::string aspect;
  double orientation_rad = 0;
  double prior = 0;
  Outcome outcome = Outcome::Undecided;
  std::optional<double> exit_orientation_rad;  // of delivered poses
  std::optional<double> margin_mm;             // delivered: the least margin; lost: the depth of the loss
  std::optional<double> unsupported_mm;        // lost: travel with negative margin at the deciding feature
  std::optional<double> tip_mm;                // lost: travel in which the nose drops by 1 mm
  std::optional<Decision> decided_by;          // none where the plain track decides
  bool may_catch = false;                      // lost, but the nose may land on the void's far edge
  bool marginal = false;                       // decided by less than kMarginal_mm: the outcome means nothing
  std::string reason;                          // one sentence for people: why this outcome
};

struct Metrics {
  double efficiency = 0;
  std::optional<double> purity;  // none where nothing is delivered
  double jam_probability = 0;
  std::optional<double> tolerance_mm, margin_mm;
  double length_mm = 0;
  int feature_count = 0;
  std::optional<double> feed_rate_per_min;
};

// The track as it would be cut, for drawings.
struct PlacedFeature {
  std::string type;
  double start_mm = 0, end_mm = 0;
  std::vector<Polygon> voids_mm;                           // clipped to the strip, world frame
  std::vector<std::pair<std::string, double>> dimensions;  // literal parameters, contract names
  std::vector<ObstacleShape> obstacles = {};               // world frame, whole
  Loop wall_face_mm = {};                                  // of a wall profile: the face as it is drawn, x ascending
};

// Starting orientations of one outcome. The next interval of the aspect begins where this one ends, bit for bit; the
// last one wraps.
struct MapInterval {
  std::string aspect;
  double from_rad = 0, to_rad = 0;
  Outcome outcome = Outcome::Undecided;
  std::optional<double> exit_orientation_rad;
  bool thin = false;      // thinner than boundaries are located
  double sample_rad = 0;  // a start inside
  double width_rad() const;
};

// A goal on the motion constraints, and what the design makes of it.
struct GoalAnswer {
  std::string must;   // "free", "blocked", "supported", "unsupported", or "outward" of a facet
  std::string where;  // which configuration or facet, in words
  double asked_mm = 0;
  std::optional<double> got_mm;  // none where the facet does not exist, or nothing of the part is on the track
  double lacking_mm = 0;         // 0 iff it is met
};

struct FeederEvaluation {
  bool feasible = false;
  std::vector<Violation> violations;
  std::vector<std::string> warnings;
  Metrics metrics;
  // Where something is uncertain, at the worst: bounds for every member. Arrivals that do not end alike for all of them
  // count as jams.
  std::optional<Metrics> worst_case;
  std::optional<std::string> bites;  // the uncertain value that changes an arrival's end, or costs the most
  bool robust = false;               // feasible as drawn, and for all uncertain values
  std::vector<PoseResult> poses;
  std::vector<MapInterval> outcome_map;  // of designs with obstacles
  std::vector<GoalAnswer> goals;         // in the order of the goal's configurations, then its facets
  int goal_pose = -1;                    // index into poses; -1 where no pose is the goal
};

}  // namespace formotion::feeder
