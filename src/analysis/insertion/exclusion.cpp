#include "analysis/insertion/exclusion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <unordered_map>

#include "analysis/insertion/lasting_overlap.hpp"

namespace formotion {
namespace {

constexpr int kLevels = 4;            // sizes of cells: the largest are 8 of the smallest wide
constexpr int kMostAcross = 1 << 19;  // smallest cells from the drawn pose to either side
constexpr int kLateral = 0, kDepth = 1, kTurn = 2;

struct Span {
  double low = 0, high = 0;
};

double distance(const Span& a, const Span& b) { return std::max({0.0, a.low - b.high, b.low - a.high}); }

// What the support's energy allows, for starts of a whole box. With E = (s a - r)' K (s a - r) / 2 + ..., the carrier's
// work on the way is at most ds a' K (s a - r) <= ds sqrt(2 ka E), and at most ds F: hence E <= B(s).
class EnergyTube {
 public:
  EnergyTube(const InsertionTask& task, const std::array<Span, 3>& starts) : starts_(starts) {
    const Point a = task.approach.direction, n = turned_left(a);
    const Stiffness& k = task.stiffness;
    along_ = k.kx_n_per_mm * a.x() * a.x() + k.ky_n_per_mm * a.y() * a.y();
    across_ = k.kx_n_per_mm * n.x() * n.x() + k.ky_n_per_mm * n.y() * n.y();
    turning_ = k.ktheta_nmm_per_rad;
    travel_ = task.approach.distance_mm;
    force_ = task.approach.max_force_n.value_or(std::numeric_limits<double>::infinity());
    if (task.damper_speed_mm_s) {  // r' B r <= S a' B r (docs/exclusion.md): a tube of half the way, whatever the force
      travel_ /= 2;
      force_ = std::numeric_limits<double>::infinity();
    }
    // Along and across are coupled: the energy is at least that of a support as soft as the softer axis.
    bound_along_ = along_;
    if (std::abs(k.kx_n_per_mm - k.ky_n_per_mm) * std::abs(a.x() * a.y()) > 1e-12 * along_) {
      bound_along_ = across_ = std::min(k.kx_n_per_mm, k.ky_n_per_mm);
    }
  }

  bool allows(const std::array<Span, 3>& cell) const {
    const double across = distance(cell[kLateral], starts_[kLateral]), turn = distance(cell[kTurn], starts_[kTurn]);
    const Span way{cell[kDepth].low - starts_[kDepth].high, cell[kDepth].high - starts_[kDepth].low};
    const double depth = std::clamp(travel_, way.low, way.high);
    const double rest = across_ * across * across + turning_ * turn * turn;
    const auto lack_at = [&](double s) {
      return bound_along_ * (s - depth) * (s - depth) + rest - twice_most_energy(s);
    };
    const double yields = force_ / along_;
    double lack = lack_at(travel_);
    if (yields < travel_) lack = std::min(lack, lack_at(std::clamp(depth + force_ / bound_along_, yields, travel_)));
    return lack <= 1e-9 * along_ * (travel_ * travel_ + 1);
  }

 private:
  double twice_most_energy(double s) const {
    const double yields = force_ / along_;
    return s <= yields ? along_ * s * s : 2 * force_ * s - force_ * yields;
  }
  std::array<Span, 3> starts_;
  double along_ = 0, across_ = 0, turning_ = 0, bound_along_ = 0, travel_ = 0, force_ = 0;
};

// Blocks of smallest cells, inclusive.
struct Block {
  std::array<int, 3> low, high;
  bool meets(const Block& other) const {
    for (int k = 0; k < 3; ++k) {
      if (high[k] < other.low[k] || low[k] > other.high[k]) return false;
    }
    return true;
  }
};

// A cell of the tree: at level l 2^l smallest cells wide.
struct Cell {
  int level = 0;
  std::array<int, 3> at{};  // in cells of its size
  Block block() const {
    Block block;
    for (int k = 0; k < 3; ++k) {
      block.low[k] = at[k] * (1 << level);
      block.high[k] = block.low[k] + (1 << level) - 1;
    }
    return block;
  }
  std::uint64_t key() const {
    std::uint64_t key = static_cast<std::uint64_t>(level);
    for (const int place : at) key = key << 20 | static_cast<std::uint64_t>(place + kMostAcross);
    return key;
  }
};

enum class CellState { Closed, Split, Reached };

// Floods the cells from the starts, the deepest ones first.
class Flood {
 public:
  Flood(const InsertionTask& task, const StartBox& starts, double at_depth_mm, const ExclusionOptions& options)
      : task_(task),
        options_(options),
        at_depth_(at_depth_mm),
        starts_(spans_of(task, starts)),
        tube_(task, starts_),
        overlap_(task.space->part, task.space->obstacles, options.cell_mm) {
    const double reach = std::max(task.space->part.reach_mm, options.cell_mm);
    size_ = {options.cell_mm, options.cell_mm, options.cell_mm / reach};
  }

  Exclusion run() {
    Exclusion result;
    result.bound_mm = starts_[kDepth].high;
    if (starts_[kDepth].high >= at_depth_) {
      result.why = "a start is as deep already";
      return result;
    }
    Block first;
    for (int k = 0; k < 3; ++k) {
      const double low = (starts_[k].low - origin(k)) / size_[k], high = (starts_[k].high - origin(k)) / size_[k];
      if (!(std::abs(low) < kMostAcross / 4 && std::abs(high) < kMostAcross / 4)) {
        result.why = "the starts are too far apart for cells as small";
        return result;
      }
      first.low[k] = static_cast<int>(std::floor(low));
      first.high[k] = static_cast<int>(std::floor(high));
    }
    enter(first);
    while (!queue_.empty() && result.why.empty()) {
      const Block block = queue_.top().cell.block();
      queue_.pop();
      result.bound_mm = std::max(result.bound_mm, at_depth_ + (block.high[kDepth] + 1) * size_[kDepth]);
      if (block.high[kDepth] >= 0) result.why = "cells connect the starts to the depth";
      for (int k = 0; k < 3; ++k) {
        Block below = block, above = block;
        below.low[k] = below.high[k] = block.low[k] - 1;
        above.low[k] = above.high[k] = block.high[k] + 1;
        if (below.low[k] <= -kMostAcross / 2 || above.high[k] >= kMostAcross / 2) {
          result.why = "the support lets the part go too far for cells as small";
        }
        enter(below);
        enter(above);
      }
      if (cells_ > options_.most_cells && result.why.empty()) result.why = "too many cells";
    }
    result.cells = cells_;
    result.proved = result.why.empty();
    return result;
  }

 private:
  struct Waiting {
    Cell cell;
    int depth = 0;
    std::uint64_t key = 0;
    bool operator<(const Waiting& other) const {
      return depth < other.depth || (depth == other.depth && key < other.key);
    }
  };

  static std::array<Span, 3> spans_of(const InsertionTask& task, const StartBox& starts) {
    const Point a = task.approach.direction, n = turned_left(a);
    const auto along_y = [&](double share) {
      return Span{std::min(share * starts.y_min_mm, share * starts.y_max_mm),
                  std::max(share * starts.y_min_mm, share * starts.y_max_mm)};
    };
    const Span lateral = along_y(n.y()), depth = along_y(a.y());
    return {Span{starts.x_min_mm + lateral.low, starts.x_max_mm + lateral.high}, depth,
            Span{starts.theta_min_rad, starts.theta_max_rad}};
  }
  // Depths count from at_depth, so that no cell lies on both sides of it.
  double origin(int k) const { return k == kDepth ? at_depth_ : 0; }

  // Reaches what is open of a block that lies in one of the largest cells, or (the starts) in several.
  void enter(const Block& block) {
    const int top = kLevels - 1;
    Cell root{top, {}};
    for (root.at[0] = block.low[0] >> top; root.at[0] <= block.high[0] >> top; ++root.at[0]) {
      for (root.at[1] = block.low[1] >> top; root.at[1] <= block.high[1] >> top; ++root.at[1]) {
        for (root.at[2] = block.low[2] >> top; root.at[2] <= block.high[2] >> top; ++root.at[2]) visit(root, block);
      }
    }
  }

  void visit(const Cell& cell, const Block& block) {
    const Block own = cell.block();
    if (!own.meets(block)) return;
    const auto [entry, is_new] = states_.try_emplace(cell.key(), CellState::Closed);
    if (is_new) {
      const CellState state = look_at(cell, own);
      entry->second = state;
      if (state == CellState::Reached) queue_.push({cell, own.high[kDepth], cell.key()});
    }
    if (entry->second != CellState::Split) return;
    for (int child = 0; child < 8; ++child) {
      visit({cell.level - 1,
             {2 * cell.at[0] + (child & 1), 2 * cell.at[1] + (child >> 1 & 1), 2 * cell.at[2] + (child >> 2)}},
            block);
    }
  }

  // Looked at when a way to it is known; a smallest cell that is not closed for certain is open.
  CellState look_at(const Cell& cell, const Block& own) {
    ++cells_;
    std::array<Span, 3> spans;
    std::array<double, 3> middle, half;
    for (int k = 0; k < 3; ++k) {
      spans[k] = {origin(k) + own.low[k] * size_[k], origin(k) + (own.high[k] + 1) * size_[k]};
      middle[k] = (spans[k].low + spans[k].high) / 2;
      half[k] = (spans[k].high - spans[k].low) / 2;
    }
    if (!tube_.allows(spans)) return CellState::Closed;
    const Point a = task_.approach.direction;
    const Point at = task_.drawn.position() + middle[kLateral] * turned_left(a) + middle[kDepth] * a;
    const Configuration q{at.x(), at.y(), task_.drawn.theta_rad + middle[kTurn]};
    const double move = std::hypot(half[kLateral], half[kDepth]), turn = half[kTurn];
    if (overlap_.at(q, move, turn)) return CellState::Closed;
    if (cell.level == 0 || overlap_.free_at(q, move, turn)) return CellState::Reached;
    return CellState::Split;
  }

  const InsertionTask& task_;
  const ExclusionOptions& options_;
  double at_depth_;
  std::array<Span, 3> starts_;
  EnergyTube tube_;
  LastingOverlap overlap_;
  std::array<double, 3> size_{};
  std::unordered_map<std::uint64_t, CellState> states_;  // looked up only
  std::priority_queue<Waiting> queue_;
  long cells_ = 0;
};

}  // namespace

Exclusion deepest_reachable(const InsertionTask& task, const StartBox& starts, double at_depth_mm,
                            const ExclusionOptions& options) {
  return Flood(task, starts, at_depth_mm, options).run();
}

}  // namespace formotion
