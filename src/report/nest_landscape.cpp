#include "report/nest_landscape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include "analysis/contact/free_slice.hpp"
#include "analysis/energy/lowest_positions.hpp"

namespace formotion {
namespace {

using nest::NestRest;
using nest::Scene;

constexpr double kTurn_rad = 2 * std::numbers::pi;
constexpr double kRoom = 1.5;       // beside the outermost rests, of the part's reach
constexpr double kHidden_mm = 0.1;  // a rest this much below where a lowered part stops is under an overhang
constexpr double kBeside_mm = 1e-7;
constexpr double kLevel_mm = 1e-4;  // heights that count as the same
constexpr int kUnknown = -2;

struct Node {
  int row = 0, column = 0;
};

double reach_of(const Scene& scene) {
  double reach = 0;
  for (const Point& p : all_corners(scene.shape)) reach = std::max(reach, p.norm());
  return reach;
}

// Configurations that stand for a rest: all of its orientations that are the same, and the ends of sets.
std::vector<Configuration> members(const Scene& scene, const NestRest& rest) {
  std::vector<Configuration> own = rest.set, all;
  own.push_back(rest.at);
  for (const Configuration& q : own) {
    for (int k = 0; k < scene.symmetry; ++k)
      all.push_back({q.x_mm, q.y_mm, q.theta_rad + k * kTurn_rad / scene.symmetry});
  }
  return all;
}

// Pieces of a slice's boundary that meet are apart by rounding: just beside the gap there is a height.
std::optional<double> lowered_mm(const FreeSlice& slice, const Gravity& gravity, double across) {
  std::optional<double> height;
  for (const double beside : {-kBeside_mm, 0.0, kBeside_mm}) {
    const std::optional<double> one = drop_height_mm(slice, gravity, across + beside);
    if (one && (!height || *one > *height)) height = one;
  }
  return height;
}

void set_range(Landscape& land, const Scene& scene, const std::vector<NestRest>& rests) {
  land.from_mm = scene.outside.from_mm;
  land.to_mm = scene.outside.to_mm;
  if (rests.empty()) return;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const NestRest& rest : rests) {
    const double across = scene.gravity.across_mm(rest.at.position());
    least = std::min(least, across);
    most = std::max(most, across);
  }
  const double room = kRoom * reach_of(scene);
  const double from = std::max(land.from_mm, least - room), to = std::min(land.to_mm, most + room);
  if (to > from) std::tie(land.from_mm, land.to_mm) = std::pair(from, to);
}

// Basins that grow as the water rises.
class Flood {
 public:
  Flood(Landscape& land, std::vector<std::vector<int>> seeds) : land_(land), seeds_(std::move(seeds)) {}

  void run() {
    const int rows = static_cast<int>(land_.height.size()), columns = static_cast<int>(land_.height[0].size());
    std::vector<Node> order;
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        if (land_.height[row][column]) order.push_back({row, column});
      }
    }
    // On a level, where a rest is comes first, and the ends of the range last: so a level floor is its rest's.
    const auto rank = [&](const Node& node) {
      const bool at_end = node.column == 0 || node.column + 1 == columns;
      return std::pair(std::llround(height(node) / kLevel_mm), seeds_[node.row][node.column] != kUnknown ? 0
                                                               : at_end                                  ? 2
                                                                                                         : 1);
    };
    std::stable_sort(order.begin(), order.end(), [&](const Node& a, const Node& b) { return rank(a) < rank(b); });
    basin_of_.assign(rows, std::vector<int>(columns, kUnknown));
    for (const Node& node : order) add(node, rows, columns);
    for (const Node& node : order) {
      const int rest = rest_of_[root(basin_of_[node.row][node.column])];
      land_.basin[node.row][node.column] = rest == kUnknown ? kNoRest : rest;
    }
  }

 private:
  double height(const Node& node) const { return *land_.height[node.row][node.column]; }
  int root(int basin) const {
    while (into_[basin] != basin) basin = into_[basin];
    return basin;
  }

  void add(const Node& node, int rows, int columns) {
    std::optional<Node> lowest;
    std::vector<int> beside;
    for (int i = -1; i <= 1; ++i) {
      for (int k = -1; k <= 1; ++k) {
        const Node other{(node.row + i + rows) % rows, node.column + k};
        if ((i == 0 && k == 0) || other.column < 0 || other.column >= columns) continue;
        const int basin = basin_of_[other.row][other.column];
        if (basin == kUnknown) continue;
        beside.push_back(root(basin));
        if (!lowest || height(other) < height(*lowest)) lowest = other;
      }
    }
    int own = 0;
    if (lowest) {
      own = root(basin_of_[lowest->row][lowest->column]);
    } else {
      own = static_cast<int>(into_.size());
      into_.push_back(own);
      rest_of_.push_back(kUnknown);
    }
    // Hollows without a rest spill into what they meet first.
    for (const int other : beside) {
      const int theirs = root(other), ours = root(own);
      if (theirs == ours || (rest_of_[theirs] != kUnknown && rest_of_[ours] != kUnknown)) continue;
      const bool theirs_empties = rest_of_[theirs] == kUnknown;
      into_[theirs_empties ? theirs : ours] = theirs_empties ? ours : theirs;
    }
    own = root(own);
    basin_of_[node.row][node.column] = own;
    if (rest_of_[own] != kUnknown) return;
    const bool at_end = node.column == 0 || node.column + 1 == columns;
    const int seed = seeds_[node.row][node.column];
    if (seed != kUnknown) {
      rest_of_[own] = seed;
    } else if (at_end) {
      rest_of_[own] = kNoRest;
    }
  }

  Landscape& land_;
  std::vector<std::vector<int>> seeds_;  // rests by node
  std::vector<std::vector<int>> basin_of_;
  std::vector<int> into_, rest_of_;  // of basins: what they have spilt into, the rest that they hold
};

// The lowest node near each rest.
std::vector<std::vector<int>> seeds_of(Landscape& land, const Scene& scene, const std::vector<NestRest>& rests) {
  const int rows = static_cast<int>(land.height.size()), columns = static_cast<int>(land.height[0].size());
  std::vector<std::vector<int>> seeds(rows, std::vector<int>(columns, kUnknown));
  for (std::size_t i = 0; i < rests.size(); ++i) {
    bool is_hidden = true;
    for (const Configuration& q : members(scene, rests[i])) {
      const double across = scene.gravity.across_mm(q.position());
      const auto lowered = lowered_mm(free_slice(scene.part, scene.obstacles, q.theta_rad), scene.gravity, across);
      if (!lowered || *lowered > scene.gravity.height_mm(q) + kHidden_mm) continue;
      is_hidden = false;
      const int row = static_cast<int>(std::lround(q.theta_rad / kTurn_rad * rows));
      const int column =
          static_cast<int>(std::lround((across - land.from_mm) / (land.to_mm - land.from_mm) * (columns - 1)));
      std::optional<Node> lowest;
      for (int a = -1; a <= 1; ++a) {
        for (int b = -1; b <= 1; ++b) {
          const Node node{((row + a) % rows + rows) % rows, column + b};
          if (node.column < 0 || node.column >= columns || !land.height[node.row][node.column]) continue;
          if (!lowest || *land.height[node.row][node.column] < *land.height[lowest->row][lowest->column]) lowest = node;
        }
      }
      if (lowest && seeds[lowest->row][lowest->column] == kUnknown)
        seeds[lowest->row][lowest->column] = static_cast<int>(i);
    }
    if (is_hidden) land.hidden.push_back(static_cast<int>(i));
  }
  return seeds;
}

}  // namespace

Landscape landscape_of(const Scene& scene, const std::vector<NestRest>& rests, const LandscapeGrid& grid) {
  Landscape fine;
  set_range(fine, scene, rests);
  const int rows = grid.rows * grid.finer, columns = (grid.columns - 1) * grid.finer + 1;
  for (int row = 0; row < rows; ++row) {
    const FreeSlice slice = free_slice(scene.part, scene.obstacles, row * kTurn_rad / rows);
    fine.height.emplace_back();
    for (int column = 0; column < columns; ++column) {
      const double across = fine.from_mm + column * (fine.to_mm - fine.from_mm) / (columns - 1);
      fine.height.back().push_back(lowered_mm(slice, scene.gravity, across));
    }
  }
  fine.basin.assign(rows, std::vector<int>(columns, kNoRest));
  const std::vector<std::vector<int>> seeds = seeds_of(fine, scene, rests);
  Flood(fine, seeds).run();
  Landscape land{fine.from_mm, fine.to_mm, {}, fine.hidden, {}};
  for (int row = 0; row < rows; row += grid.finer) {
    land.height.emplace_back();
    land.basin.emplace_back();
    for (int column = 0; column < columns; column += grid.finer) {
      land.height.back().push_back(fine.height[row][column]);
      land.basin.back().push_back(fine.basin[row][column]);
    }
  }
  return land;
}

std::vector<NamedPass> named(const MergeTree& tree, const std::vector<NestRest>& rests) {
  const int outside = static_cast<int>(rests.size());
  std::vector<int> name;  // of rests, outside, groups
  for (int i = 0; i < outside; ++i) name.push_back(i);
  name.push_back(kNoRest);
  std::vector<NamedPass> passes;
  for (const Pass& pass : tree.passes) {
    const int a = name[pass.first], b = name[pass.second];
    const bool swaps = a == kNoRest;
    passes.push_back({swaps ? b : a, swaps ? a : b, pass.lower_mm, pass.upper_mm, pass.at});
    const bool is_outside = a == kNoRest || b == kNoRest;
    name.push_back(is_outside ? kNoRest : rests[b].height_mm < rests[a].height_mm ? b : a);
  }
  return passes;
}

std::vector<NamedPass> passes_of(const Scene& scene, const std::vector<NestRest>& rests, const EscapeOptions& options) {
  std::vector<Configuration> starts;
  for (const NestRest& rest : rests) starts.push_back(rest.at);
  if (starts.empty()) return {};
  return named(merge_tree(*scene.space, scene.gravity, starts, scene.outside, options), rests);
}

}  // namespace formotion
