// Outcomes over a rectangle of start errors, found by their boundaries: rows across the rectangle, each cut into
// intervals whose ends are located, and rows added where neighbours do not predict the row between them.
#pragma once

#include <functional>
#include <vector>

#include "analysis/motion/outcome_map.hpp"

namespace formotion {

struct ErrorBox {
  double u_min = 0, u_max = 0;  // along rows: the lateral error, mm
  double v_min = 0, v_max = 0;  // from row to row: the angular error, rad; both may be a single value
};

struct RegionOptions {
  int starts_a_row = 9;  // projected first on every row
  int rows = 7;          // at first; more between them
  int most_rows = 65;
  double boundary = 1e-7;     // ends of intervals are located to this share of the row
  double history = 1.0 / 64;  // neighbours of one outcome but other histories are looked between down to this share
  // Rows are added until neighbours predict boundaries to this share of the row, and until what differs between rows
  // of other sequences of outcomes is less than this share of the box.
  double row_error = 2e-3;
};

struct RegionInterval {
  double from = 0, to = 0;  // of u; the next one begins where this one ends, bit for bit
  int outcome = 0;
};

struct RegionRow {
  double v = 0;
  std::vector<RegionInterval> intervals;
};

struct OutcomeRegion {
  ErrorBox box;
  std::vector<RegionRow> rows;  // ascending v
  int starts = 0;               // projected
};

// at(u, v): pure. Equal histories of neighbours are taken to mean equal outcomes between them (outcome_map.hpp).
OutcomeRegion outcome_region(const ErrorBox& box, const std::function<StartOutcome(double u, double v)>& at,
                             const RegionOptions& options = {});

// The share of the box (of its length where one side is a single value; 0 or 1 where both are) with this outcome.
double share_of(const OutcomeRegion& region, int outcome);

// The largest k in [0, 1] such that the box scaled by k about its middle has this outcome alone; 0 if its middle has
// another one. Found on the region's rows and between them; then starts on the sides of the scaled box are projected
// with `at`, and for each of another outcome the box shrinks to the change between its middle and this start, to
// options.boundary. Guaranteed: no row of the region and none of 17 starts on each side of it (less options.boundary)
// has another outcome; what is between them is not looked at. A single value's side counts for nothing.
double largest_scaled_box(const OutcomeRegion& region, int outcome,
                          const std::function<StartOutcome(double u, double v)>& at, const RegionOptions& options = {});

}  // namespace formotion
