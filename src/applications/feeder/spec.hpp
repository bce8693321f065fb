// A feeder problem as asked for: the part, the track's environment, the features with expressions in the
// variables, the goal. Filled by io, read by the feeder application. mm, rad, s.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "analysis/contact/configuration.hpp"
#include "analysis/geometry/polygon.hpp"
#include "applications/shared/part_spec.hpp"
#include "problem/affine.hpp"
#include "problem/problem.hpp"

namespace formotion::feeder {

using formotion::AspectSpec;
using formotion::LayerSpec;
using formotion::PartSpec;

struct Environment {
  double track_width_mm = 0;
  double wall_friction = 0.2;
  double drive_rad = -0.52359877559829887;  // -30 degrees
  double conveying_speed_mm_s = 50;
  double tilt_rad = 0;
  std::optional<double> spacing_mm;             // default: the part's diameter
  std::optional<double> radius_of_gyration_mm;  // default: the area's
  double settling_friction = 0;
  // Height of the centre of mass over the wall where parts come in without a pull to the wall; default: the track's
  // middle.
  std::optional<double> start_y_mm;
};

struct Balcony {
  Affine width_mm, length_mm;
};
struct Gap {
  Affine length_mm;
};
struct Canyon {
  Affine from_mm, to_mm, length_mm;
};
struct Slot {
  Affine from_mm, to_mm, length_mm;
};
struct Cutout {
  AffineLoop polygon_mm;
};
struct DishOut {
  Affine depth_mm, length_mm;
};
struct Scallop {
  Affine depth_mm, half_angle_rad;
};
struct Drawing {
  std::string file;  // as written in the problem file
  std::vector<Loop> voids_mm, walls_mm;
};
struct Wiper {
  Affine height_mm;
};
struct HoldDown {
  Affine height_mm, length_mm;
};
struct Fence {
  AffineLoop polygon_mm;
};
// Replaces the wall's face from its first corner's x to its last one's; what lies below 0 is a recess.
struct WallProfile {
  AffineLoop profile_mm;  // an open polyline
};
struct Pin {
  Affine x_mm, y_mm, diameter_mm;
};

struct FeatureSpec {
  std::variant<Balcony, Gap, Canyon, Slot, Cutout, DishOut, Scallop, Drawing, Wiper, HoldDown, Fence, WallProfile, Pin>
      shape;
  std::optional<Affine> at_mm;
};
using DesignSpec = std::vector<FeatureSpec>;

// The contract's name of the feature's type ("balcony", "dish-out", ...).
std::string type_name(const FeatureSpec& feature);

// What a goal may ask of one configuration: to keep at least by_mm away from obstacles, or from tipping, or to overlap
// or to tip by at least that.
enum class Must { Free, Blocked, Supported, Unsupported };
const char* name(Must must);

struct ConfigurationGoal {
  int aspect = 0;
  Configuration q;
  Must must = Must::Free;
  double by_mm = 0;
};

// A contact facet that has to move, at one orientation, from where it is at the variables' starting values.
struct FacetGoal {
  int aspect = 0;
  bool edge_moves = false;       // EV: an edge of the part on a fixed corner; else a corner of the part on a fixed edge
  int moving = 0;                // the number of the part's edge or corner, as written
  int component = 0, fixed = 0;  // likewise of the obstacle
  double theta_rad = 0;
  double outward_mm = 0;  // away from the obstacle, into free space
  // Where the part touches at the facet's middle, at the variables' starting values in the first topology: how far the
  // facet has moved is measured from here.
  Configuration reference = {};
};

struct Goal {
  bool one_pose = false;  // deliver the delivered pose of largest prior, whichever it is
  std::string aspect;     // or this one; "any" for all aspects
  double orientation_rad = 0;
  bool require_tip = false;
  // On a belt, where no wall presses parts flush: how far from the goal's orientation they may leave (0.01 degrees).
  double within_rad = 1.7453292519943296e-4;
  // Goals on the motion constraints themselves.
  std::vector<ConfigurationGoal> configurations;
  std::vector<FacetGoal> facets;
};

struct Manufacture {
  std::optional<double> cutter_radius_mm, min_web_mm;
  std::optional<double> plate_mm;  // the track's thickness; no motion depends on it
};

struct Uncertainty {
  double outline_mm = 0, com_mm = 0, feature_mm = 0;           // half-widths
  std::map<std::string, std::pair<double, double>> intervals;  // as written: "wall_friction", "drive_deg", ...
  bool any() const { return outline_mm > 0 || com_mm > 0 || feature_mm > 0 || !intervals.empty(); }
};

// What feeders can be searched for; the first three unless the problem says otherwise.
std::span<const Objective> known_objectives();

// Sequences of a grammar that are left out of the search, since no values of their numbers can reach the goal.
struct PrunedSequences {
  std::string pattern;  // "only balcony, gap, slot"
  std::string reason;   // one sentence
  std::int64_t count = 0;
};

// Topologies asked for by a catalogue; its expansion fills the designs and the variables.
struct GrammarSpec {
  std::vector<std::string> features;  // as written: types, and "cutout3" to "cutout6"
  int max_features = 1;
  std::int64_t sequences = 0;  // before pruning
  std::vector<PrunedSequences> pruned;
};

struct FeederSpec {
  PartSpec part;
  Environment environment;
  Goal goal;
  Manufacture manufacture;
  Uncertainty uncertainty;
  std::vector<Variable> variables;
  std::vector<DesignSpec> designs;  // one per topology
  std::optional<GrammarSpec> grammar;
  std::vector<Objective> objectives;
  bool robust = false;  // feasibility and objectives of the search are those of the worst case
};

}  // namespace formotion::feeder
