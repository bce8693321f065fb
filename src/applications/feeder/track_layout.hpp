// Features placed along the track: what is cut away where, before clipping to the strip.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "applications/feeder/evaluation.hpp"
#include "applications/feeder/spec.hpp"

namespace formotion::feeder {

struct LaidFeature {
  std::string type;
  double start_mm = 0, end_mm = 0;
  std::vector<Loop> voids;         // counter-clockwise; features that are open to the free edge go on beyond it
  double x_min = 0, x_max = 0;     // of the voids
  std::vector<Loop> obstacles;     // what stands on the track
  std::optional<double> blade_mm;  // wiper, hold-down: height over the track
  bool holds_down = false;
};

struct Layout {
  std::vector<LaidFeature> features;
  std::vector<Violation> invalid;  // shapes that the variables made impossible; the others are laid all the same
  double length_mm = 0;
};

// Voids that can act on the part at the same time: all of a track's that lie nearer to each other than reach_mm.
struct VoidGroup {
  std::vector<int> features;  // indices, by position
  std::vector<Loop> loops;    // disjoint, the void to the left
};

Layout lay_out(const DesignSpec& design, const Environment& environment, const Manufacture& manufacture,
               double part_diameter_mm, std::span<const double> values);
std::vector<VoidGroup> grouped(const Layout& layout, double reach_mm);

}  // namespace formotion::feeder
