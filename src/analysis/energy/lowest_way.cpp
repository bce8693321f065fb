#include "analysis/energy/lowest_way.hpp"

#include <algorithm>
#include <queue>

namespace formotion {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kTries = 20, kLastTries = 100;  // chains of cells whose motions are looked at

double height_of(const WayEnd& end) { return end ? end->height_mm : -kInfinity; }

}  // namespace

WaySearch::WaySearch(const OpenHeights& heights, const CellLayout& layout, double under_mm)
    : heights_(&heights), cells_(heights, layout), under_mm_(under_mm) {}

std::vector<int> WaySearch::nodes_of(const WayEnd& end) const {
  return end ? cells_.nodes_at(*end) : std::vector<int>{EnergyCells::kOutside};
}

// Dijkstra's algorithm with the highest crossing for the length; until beyond_mm over the first end that is reached.
WaySearch::Flood WaySearch::flood(const std::vector<WayEnd>& from, const std::vector<WayEnd>& to,
                                  double beyond_mm) const {
  Flood flood;
  flood.cost.assign(cells_.nodes().size(), kInfinity);
  flood.source.assign(cells_.nodes().size(), -1);
  std::vector<std::pair<double, int>> ends(cells_.nodes().size(), {kInfinity, -1});
  for (int i = 0; i < static_cast<int>(to.size()); ++i) {
    for (const int node : nodes_of(to[i])) ends[node] = std::min(ends[node], {height_of(to[i]), i});
  }
  using Waiting = std::pair<double, int>;
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> waiting;
  const auto reach = [&](int node, double cost, int source) {
    if (cost >= flood.cost[node]) return;
    flood.cost[node] = cost;
    flood.source[node] = source;
    waiting.push({cost, node});
  };
  for (int i = 0; i < static_cast<int>(from.size()); ++i) {
    for (const int node : nodes_of(from[i])) reach(node, height_of(from[i]), i);
  }
  while (!waiting.empty()) {
    const auto [cost, node] = waiting.top();
    waiting.pop();
    if (cost > flood.cost[node]) continue;
    if (cost > flood.reached_mm + beyond_mm) {
      flood.cost[node] = kInfinity;
      continue;
    }
    if (const auto [height, end] = ends[node]; end >= 0 && std::max(cost, height) < flood.reached_mm) {
      flood.reached_mm = std::max(cost, height);
      flood.reached_from = flood.source[node];
      flood.reached = end;
    }
    for (const int index : cells_.nodes()[node].crossings) {
      const Crossing& crossing = cells_.crossings()[index];
      if (!crossing.is_alive) continue;
      reach(crossing.first == node ? crossing.second : crossing.first, std::max(cost, crossing.heights.low),
            flood.source[node]);
    }
  }
  return flood;
}

// The cells that leave open whether a way at this level exists: at crossings that ways may use, of which no place is
// known that is free at the level.
std::vector<int> WaySearch::loose_cells(const Flood& forward, const Flood& backward, double level_mm, bool& tightened) {
  std::vector<int> loose;
  for (int index = 0; index < static_cast<int>(cells_.crossings().size()); ++index) {
    const Crossing& before = cells_.crossings()[index];
    if (!before.is_alive || before.heights.low > level_mm) continue;
    const auto joins = [&](int a, int b) { return forward.cost[a] <= level_mm && backward.cost[b] <= level_mm; };
    if (!joins(before.first, before.second) && !joins(before.second, before.first)) continue;
    if (!before.is_tight) cells_.tighten(index);
    const Crossing& crossing = cells_.crossings()[index];
    if (!crossing.is_alive || crossing.heights.low > level_mm) {
      tightened = true;
    } else if (!crossing.is_passed_by(level_mm)) {
      const int a = cells_.nodes()[crossing.first].cell, b = cells_.nodes()[crossing.second].cell;
      const bool split_a = a >= 0 && cells_.can_split(a), split_b = b >= 0 && cells_.can_split(b);
      if (split_a && (!split_b || cells_.size_mm(a) >= 0.99 * cells_.size_mm(b))) loose.push_back(a);
      if (split_b && (!split_a || cells_.size_mm(b) >= 0.99 * cells_.size_mm(a))) loose.push_back(b);
    }
  }
  return loose;
}

bool WaySearch::split_largest(std::vector<int> cells) {
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  double largest = 0;
  for (const int cell : cells) largest = std::max(largest, cells_.size_mm(cell));
  for (const int cell : cells) {
    if (cells_.size_mm(cell) > 0.5 * largest) cells_.split(cell);
  }
  return !cells.empty();
}

// Looks for a motion along chains of cells, and bans what failed: `failed` has the cells.
bool WaySearch::settle(const std::vector<WayEnd>& from, const std::vector<WayEnd>& to, double chain_mm, double most_mm,
                       bool tighten, int tries, LowestWay& way, std::vector<int>& failed) {
  bool found = false;
  for (int i = 0; i < tries && !found; ++i) {
    const std::optional<Chain> way_on = chain(from, to, chain_mm, tighten);
    if (!way_on) break;
    const double height = tighten ? way_on->least_mm + most_mm : most_mm;
    Trial trial = follow(*way_on, from, to, height);
    if (trial.path.empty()) {
      const int cell = cells_.nodes()[way_on->nodes[trial.failed]].cell;
      if (cell >= 0) failed.push_back(cell);
      if (way_on->crossings.empty()) break;
      cells_.ban(way_on->crossings[std::min(trial.failed, way_on->crossings.size() - 1)]);
      continue;
    }
    sharpen(*way_on, from, to, height, trial.path);
    double upper = -kInfinity;
    for (std::size_t k = 0; k < trial.path.size(); ++k) {
      if (trial.path[k].height_mm <= upper + 1e-9) continue;
      upper = trial.path[k].height_mm;
      way.highest = k;
    }
    way.upper_mm = upper;
    way.path = std::move(trial.path);
    way.source = way_on->source;
    way.target = way_on->target;
    found = true;
  }
  cells_.lift_bans();
  return found;
}

LowestWay WaySearch::lowest_way(const std::vector<WayEnd>& from, const std::vector<WayEnd>& to,
                                const WayDemand& demand) {
  LowestWay way;
  const double gap = demand.gap_mm * (1 - 1e-6), half_gap = gap / 2;  // less than asked, by more than rounding
  const long before = cells_.looked_at();
  for (;;) {
    const Flood forward = flood(from, to, half_gap);
    way.lower_mm = std::max(way.lower_mm, forward.reached_mm);
    way.source = forward.reached_from;
    way.target = forward.reached;
    if (way.lower_mm == kInfinity) {
      way.why = "enclosed";
      return way;
    }
    if (way.lower_mm > demand.most_mm) return way;
    const double level = way.lower_mm + half_gap;
    const Flood backward = flood(to, from, half_gap);
    bool goes_on = false;
    std::vector<int> loose = loose_cells(forward, backward, level, goes_on);
    if (!demand.want_path && !goes_on && chain(from, to, level, false)) return way;
    if (demand.want_path) {
      std::vector<int> failed;
      if (settle(from, to, level, way.lower_mm + gap, false, kTries, way, failed)) return way;
      for (const int cell : failed) {
        if (cells_.can_split(cell)) loose.push_back(cell);
      }
    }
    if (cells_.looked_at() - before > demand.most_cells) {
      way.why = "too many cells";
      break;
    }
    if (!goes_on && !split_largest(std::move(loose))) {
      way.why = "cells as small as allowed leave it open";
      break;
    }
  }
  if (demand.want_path) {
    std::vector<int> failed;
    if (!settle(from, to, kInfinity, gap, true, kLastTries, way, failed)) way.why += "; no motion found";
  }
  return way;
}

}  // namespace formotion
