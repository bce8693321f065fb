// The knee of a front: the design beyond which a little more of one objective costs much of another.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace formotion {

struct Knee {
  std::size_t index = 0;
  double distance = 0;  // in objectives scaled to 0..1 over the front
};

// The design farthest from the hyperplane through the best designs of every objective, on the ideal's side (Das 1999:
// "On characterizing the knee of the Pareto curve"), objectives scaled by their ranges over the front. Where these best
// designs span no hyperplane, the one of the worst corners stands in: all losses 1 but one. losses: one row a design,
// to be minimised. None with fewer than three designs, with fewer than two objectives in which they differ, and for
// fronts that bulge nowhere. Of equals the first.
std::optional<Knee> knee(const std::vector<std::vector<double>>& losses);

}  // namespace formotion
