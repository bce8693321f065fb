// Where a rest may be: configurations at which two or three contacts hold the height to first order, found from the
// locally lowest positions of slices. Not all of them are rests, or free.
#pragma once

#include <array>
#include <vector>

#include "analysis/energy/gravity.hpp"
#include "analysis/energy/lowest_positions.hpp"
#include "analysis/motion/contact_space.hpp"

namespace formotion {

// Orientations at which an edge of the part is parallel to a fixed edge or level, or a corner of the part stands
// straight over its centre of mass (a hook on a shelf); and a grid. Ascending, in [0, 2 pi), without repeats.
struct RestSlices {
  std::vector<double> theta_rad;
  std::vector<bool> is_special;  // not of the grid alone
};
RestSlices rest_slices(const ContactSpace& space, const Gravity& gravity, double grid_rad);

// Gathers what touches, or nearly so, about the lowest positions of slices.
class RestCandidates {
 public:
  // within_rad: how far from a slice rests of its branches are looked for.
  RestCandidates(const ContactSpace& space, const Gravity& gravity, double within_rad);

  void add(const Point& lowest, double theta_rad);

  // Along the curve of two of the pairs found, where the height is least; and where three of them meet. In no order.
  std::vector<Configuration> found();
  // Orientations at which two of the pairs found hold the part on a level (two feet on a
  // floor or on steps, one on the floor and one under a ceiling).
  std::vector<double> level_orientations();

 private:
  void meet_round(const std::array<int, 4>& three, std::vector<Configuration>& out) const;
  void least_along(int first, int second, std::vector<Configuration>& out) const;

  void tidy();

  const ContactSpace& space_;
  const Gravity& gravity_;
  double within_rad_;
  int bins_;
  std::vector<std::array<int, 2>> twos_;
  std::vector<std::array<int, 3>> threes_;  // of edge contacts
  // With round corners: the orientations from bin to bin + 1 are looked at.
  std::vector<std::array<int, 4>> round_threes_;  // the last: the bin
};

}  // namespace formotion
