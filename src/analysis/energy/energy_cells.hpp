// Cells over (across, turn) with the heights that may be free in each, and the crossings between them: what a search
// for the lowest way out walks on. Heights are not cut into cells: open_heights.hpp bounds them.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "analysis/energy/open_heights.hpp"

namespace formotion {

struct CellLayout {
  std::vector<double> across_mm;  // ascending: the ends, and lines that cells shall keep to; outside is beyond the ends
  std::vector<double> turn_rad;   // ascending, less than a full turn: lines that cells shall keep to; at least one
  double widest_mm = 1, least_mm = 0.05;
  double reach_mm = 1;  // angles count by this
};

// A place on a crossing at which the part is free from `heights.low` on.
struct CrossingPlace {
  double across_mm = 0, turn_rad = 0;
  RealRange heights;
};

// Between two nodes. low: no way across is lower.
struct Crossing {
  int first = 0, second = 0;
  RealRange heights;
  bool is_alive = true, is_tight = false, is_banned = false;
  int axis = 0;  // the side is at one place across (0) or one turn (1)
  std::int64_t at = 0, from = 0, to = 0;
  std::vector<CrossingPlace> places;  // ascending in height; known where it is tight
  bool is_passed_by(double height_mm) const {
    return is_alive && is_tight && !places.empty() && places.front().heights.low <= height_mm;
  }
};

// One stretch of heights in one cell. Node 0 is outside.
struct EnergyNode {
  int cell = -1;
  RealRange heights;
  std::vector<int> crossings;
};

class EnergyCells {
 public:
  static constexpr int kOutside = 0;

  EnergyCells(const OpenHeights& heights, const CellLayout& layout);

  const std::vector<EnergyNode>& nodes() const { return nodes_; }
  const std::vector<Crossing>& crossings() const { return crossings_; }
  long looked_at() const { return looked_at_; }
  double reach_mm() const { return layout_.reach_mm; }

  // The nodes that hold a place: several where cells meet there.
  std::vector<int> nodes_at(const Place& place) const;
  // Bounds the crossing by the heights open on its side alone, and finds places on it.
  void tighten(int crossing);
  void ban(int crossing) { crossings_[crossing].is_banned = true; }
  void lift_bans();
  double size_mm(int cell) const;  // of its longer side
  bool can_split(int cell) const { return axis_to_split(cell) >= 0; }
  void split(int cell);

 private:
  struct Axis {
    std::vector<double> edges;  // of the largest cells
    double value(std::int64_t at) const;
    std::int64_t end() const;
  };
  struct Cell {
    std::array<std::int64_t, 2> at{};  // in smallest units
    std::array<int, 2> level{};        // its sides are 2^level units
    int root = 0;
    int first_child = -1;  // two of them
    int first_node = 0, node_count = 0;
    std::int64_t end(int axis) const { return at[axis] + (std::int64_t{1} << level[axis]); }
  };

  static Axis laid_out(const std::vector<double>& lines, double widest);
  const Axis& axis(int k) const { return k == 0 ? across_ : turn_; }
  double side_mm(const Cell& cell, int k) const;
  int axis_to_split(int cell) const;
  void look_at(int cell);
  void leaves_on(int cell, int axis, std::int64_t at, std::int64_t from, std::int64_t to, bool below,
                 std::vector<int>& found) const;
  void join(int cell, int axis, bool above, int except);
  void join(int cell, int other, int axis, std::int64_t at);
  void add_crossing(int first, int second, const RealRange& heights, int axis, std::int64_t at, std::int64_t from,
                    std::int64_t to);
  const std::vector<RealRange>& free_at(double across_mm, double turn_rad, std::int64_t key_across,
                                        std::int64_t key_turn);

  const OpenHeights* heights_;
  CellLayout layout_;
  Axis across_, turn_;
  std::int64_t turns_ = 0;   // largest cells round the turn
  std::vector<Cell> cells_;  // the roots first
  std::vector<EnergyNode> nodes_;
  std::vector<Crossing> crossings_;
  std::unordered_map<std::uint64_t, std::vector<RealRange>> free_;  // looked up only
  long looked_at_ = 0;
};

}  // namespace formotion
