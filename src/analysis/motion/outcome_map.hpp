// Forward projection of all starts: the circle of starting orientations, cut into intervals of one outcome each; and
// the outcome of one start for a whole set of frictions and drive directions.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace formotion {

// How one start ends, as far as maps care. Equal outcomes are one; equal histories took the same events to get there.
struct StartOutcome {
  int outcome = 0;
  std::uint64_t history = 0;
};

struct OutcomeInterval {
  double from_rad = 0, to_rad = 0;  // the next interval begins where this one ends, bit for bit; the last one wraps
  int outcome = 0;
  double sample_rad = 0;  // a start inside, really projected
  bool thin = false;      // thinner than the boundary tolerance: its ends say no more than that it exists
};

struct OutcomeMapOptions {
  double grid_rad = 0.034906585039886591;       // 2 degrees: between starts that are always projected
  double boundary_rad = 1.7453292519943296e-8;  // 1e-6 degrees: outcome boundaries are located to this
  // Neighbours of one outcome but different histories are looked between down to this (0.05 degrees).
  double history_rad = 8.7266462599716482e-4;
};

struct OutcomeMap {
  std::vector<OutcomeInterval> intervals;  // ascending from_rad in [0, 2 pi); one that covers the circle: 0 to 2 pi
  int starts = 0;                          // projected
};

// at(theta): the outcome of the start with this orientation, theta in [0, 2 pi). critical: orientations at which
// outcomes are likely to change; both of their sides are projected.
// Between neighbouring starts of the same history all starts are taken to share it: paths on a facet do not cross, so
// two that leave it through the same side enclose others that do too, unless an obstacle's feature lies wholly between
// them. Features that turn less than history_rad of starts aside can be missed.
OutcomeMap outcome_map(const std::function<StartOutcome(double)>& at, std::span<const double> critical,
                       const OutcomeMapOptions& options = {});

// The outcome that all members of a box share, if the members looked at do; `split` otherwise. Corners, middle and the
// middles of faces are looked at; where histories differ the box is halved along each side, depth times.
struct SetOutcome {
  bool is_one = false;
  int outcome = 0;           // if is_one
  std::vector<double> a, b;  // else: two members with different outcomes
  int members = 0;           // looked at
};
SetOutcome outcome_of_set(const std::function<StartOutcome(std::span<const double>)>& at,
                          std::span<const std::pair<double, double>> box, int depth = 2);

}  // namespace formotion
