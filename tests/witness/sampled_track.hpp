// A second opinion on whole designs: the contract's sentences written out as plainly as possible. Every pose's travel
// is sampled, voids are built and grown in another way than the feeder's, and nothing is shared with its sweep.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "applications/feeder/feeder_problem.hpp"

namespace formotion::witness {

struct ConfirmOptions {
  double step_mm = 0.5;   // between samples of a travel, before zooming in on its lowest places
  bool tolerance = true;  // also check that tolerance_mm is the largest one
};

struct Confirmation {
  std::vector<std::string> disagreements;
  int outcomes = 0, margins = 0, tolerances = 0, falls = 0;  // how many of each were compared
};

// Scores the design by samples and compares: survive or lost, rejected or jammed (where the slow rule is sure), margin
// or depth, first place of loss, and that all poses hold at 0.999 of the tolerance while one fails at 1.001 of it.
// Decisions by less than the sampler's accuracy are not compared. values: of all the problem's variables.
Confirmation compare(const feeder::FeederProblem& problem, int topology, std::span<const double> values,
                     const ConfirmOptions& options = {});

// The disagreements alone.
std::vector<std::string> confirm(const feeder::FeederProblem& problem, int topology, std::span<const double> values);

// Whether a rectangle of this length along direction and this width fits into the polygon, by trying places on a grid:
// 1 yes, 0 no, -1 too close to tell.
int fits_by_trying(const Polygon& polygon, const Point& direction, double length, double width);

// Voids with every edge off by e (grown: e > 0), with the arcs about corners replaced by chords (outer false) or
// tangents (outer true) of a regular polygon.
std::vector<Loop> moved_edges(const std::vector<Loop>& voids, double e, bool outer, int disc_corners);

}  // namespace formotion::witness
