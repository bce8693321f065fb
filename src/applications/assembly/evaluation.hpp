// What the assembly application says of one design.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/insertion/insertion.hpp"
#include "analysis/insertion/success_region.hpp"
#include "applications/assembly/spec.hpp"

namespace formotion::assembly {

struct Violation {
  std::string what, where;  // a sentence; a place in the design ("/fixed_mm/0", "never 1")
  double by = 0;
};

struct Metrics {
  double success_fraction = 0;
  std::optional<double> capture_mm, capture_deg;  // half sides of the largest scaled box; none where a side is a point
  double peak_force_n = 0, peak_lateral_force_n = 0, work_nmm = 0;  // the worst of the starts looked at
  std::optional<double> depth_margin_mm;                            // none without never-goals
  double chamfer_mm = 0;
};

struct StartResult {
  double x_mm = 0, y_mm = 0, theta_rad = 0;  // errors
  Insertion insertion;                       // without its path
};

struct NeverResult {
  std::string aspect;
  double orientation_rad = 0;
  StartsSpec box;                  // of its starts
  bool holds = false;              // no start that was projected reaches the goal's depth
  bool proved = false;             // no start can, by free space alone (exclusion.hpp)
  std::optional<double> bound_mm;  // the depth that cannot be exceeded, where proved
  StartResult deepest;             // the start that gets deepest
  int starts = 0;                  // projected
  std::string why;                 // where nothing is proved
};

struct AssemblyEvaluation {
  bool feasible = false;
  std::vector<Violation> violations;
  Metrics metrics;
  std::optional<Metrics> worst_case;
  std::optional<std::string> bites;
  std::vector<StartResult> starts;     // corners, middles and middle of the box; one for a point
  std::vector<OutcomeRegion> regions;  // over (x, theta), one for each of the starts' y that was looked at
  std::vector<double> region_y_mm;
  std::vector<NeverResult> never;
  // The least friction, above the design's own, at which a start of `starts` no longer assembles, and what it does
  // then.
  std::optional<double> fails_at_friction;
  std::optional<InsertionOutcome> fails_as;
};

}  // namespace formotion::assembly
