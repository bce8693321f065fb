// How good a front is, as one number: the volume that it dominates.
#pragma once

#include <span>
#include <vector>

namespace formotion {

using LossPoint = std::vector<double>;  // one loss an objective, all to be minimised

// The volume of what is worse than some point and better than the reference, exactly (Zitzler, Thiele 1998). Points
// that are not better than the reference in every objective add nothing. The order of the points does not matter, to
// the bit.
double hypervolume(const std::vector<LossPoint>& points, std::span<const double> reference);

// Between which losses fronts are compared.
struct LossRange {
  LossPoint best, worst;
};

// From the least to the greatest loss of every objective among the points; there is one at least.
LossRange loss_range(const std::vector<LossPoint>& points);

// The share of the range's box that the points dominate, in [0, 1]; its worst corner is the reference. An objective
// whose range is one number is met by all points that are no worse, and leaves the volume to the others. Losses better
// than the range's best count as the best.
double normalised_hypervolume(const std::vector<LossPoint>& points, const LossRange& range);

}  // namespace formotion
