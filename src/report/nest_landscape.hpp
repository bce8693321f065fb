// The landscape of heights over configuration space that the page shows of a nest: how low a part can be lowered, and
// into which rest it sinks from there.
#pragma once

#include <optional>
#include <vector>

#include "applications/nest/evaluation.hpp"
#include "applications/nest/nest_problem.hpp"

namespace formotion {

struct LandscapeGrid {
  int rows = 72;     // over all orientations; the first is 0
  int columns = 73;  // across gravity, both ends included
  int finer = 4;     // basins are those of a grid this much finer
};

struct Landscape {
  double from_mm = 0, to_mm = 0;                           // across gravity
  std::vector<std::vector<std::optional<double>>> height;  // rows of columns, absolute; none: nothing is below
  std::vector<int> hidden;                                 // rests under an overhang
  std::vector<std::vector<int>> basin;                     // a rest's number; kNoRest: none of them
};
inline constexpr int kNoRest = -1;

// rests: all of the scene's aspect. The range is that of the rests with some room, within the nest's.
//
// Basins are those of the finer grid: nodes in ascending height join the basin of their lowest neighbour (a flood,
// Vincent and Soille 1991); a hollow of the grid that holds no rest (valleys oblique to the grid have some) empties
// over its lowest brim, and what reaches an end of the range first is in no basin. Rests under an overhang, where no
// part can be lowered to, have none.
Landscape landscape_of(const nest::Scene& scene, const std::vector<nest::NestRest>& rests,
                       const LandscapeGrid& grid = {});

// From rest to rest, or outside, at what heights: the merge tree with every group named by its lowest rest.
struct NamedPass {
  int first = kNoRest, second = kNoRest;  // rests; kNoRest: outside
  double lower_mm = 0;                    // absolute heights
  std::optional<double> upper_mm;
  std::optional<Configuration> at;
};
std::vector<NamedPass> passes_of(const nest::Scene& scene, const std::vector<nest::NestRest>& rests,
                                 const EscapeOptions& options);
// The names alone.
std::vector<NamedPass> named(const MergeTree& tree, const std::vector<nest::NestRest>& rests);

}  // namespace formotion
