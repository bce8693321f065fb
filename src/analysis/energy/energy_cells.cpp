#include "analysis/energy/energy_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace formotion {
namespace {

constexpr int kUnits = 20;  // the largest cells are 2^20 units wide
constexpr double kFullTurn = 2 * std::numbers::pi;
constexpr double kWidestTurn_rad = std::numbers::pi / 4;
constexpr double kHere_mm = 1e-6, kHere = 1e-9;  // a place on a border belongs to both sides
constexpr int kMostAcross = 60;                  // largest cells

RealRange common(const RealRange& a, const RealRange& b) { return {std::max(a.low, b.low), std::min(a.high, b.high)}; }
bool is_some(const RealRange& range) { return range.low <= range.high; }

}  // namespace

double EnergyCells::Axis::value(std::int64_t at) const {
  const std::int64_t root = std::min(at >> kUnits, static_cast<std::int64_t>(edges.size()) - 2);
  const double share = std::ldexp(static_cast<double>(at - (root << kUnits)), -kUnits);
  return share == 1 ? edges[root + 1] : edges[root] + share * (edges[root + 1] - edges[root]);
}

std::int64_t EnergyCells::Axis::end() const { return static_cast<std::int64_t>(edges.size() - 1) << kUnits; }

EnergyCells::Axis EnergyCells::laid_out(const std::vector<double>& lines, double widest) {
  Axis axis;
  axis.edges.push_back(lines.front());
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    const double width = lines[i + 1] - lines[i];
    const int steps = std::max(1, static_cast<int>(std::ceil(width / widest - kHere)));
    for (int k = 1; k <= steps; ++k) axis.edges.push_back(k == steps ? lines[i + 1] : lines[i] + width * k / steps);
  }
  return axis;
}

EnergyCells::EnergyCells(const OpenHeights& heights, const CellLayout& layout) : heights_(&heights), layout_(layout) {
  const double across = layout.across_mm.back() - layout.across_mm.front();
  across_ = laid_out(layout.across_mm, std::max(layout.widest_mm, across / kMostAcross));
  std::vector<double> turns = layout.turn_rad;
  turns.push_back(turns.front() + kFullTurn);
  turn_ = laid_out(turns, std::min(kWidestTurn_rad, layout.widest_mm / layout.reach_mm));
  turns_ = static_cast<std::int64_t>(turn_.edges.size()) - 1;
  const std::int64_t rows = static_cast<std::int64_t>(across_.edges.size()) - 1;
  nodes_.emplace_back();
  nodes_[kOutside].heights = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (std::int64_t i = 0; i < rows; ++i) {
    for (std::int64_t j = 0; j < turns_; ++j) {
      Cell cell;
      cell.at = {i << kUnits, j << kUnits};
      cell.level = {kUnits, kUnits};
      cell.root = static_cast<int>(cells_.size());
      cells_.push_back(cell);
      look_at(cell.root);
    }
  }
  const int roots = static_cast<int>(cells_.size());
  for (int c = 0; c < roots; ++c) {
    join(c, 0, true, -1);
    join(c, 1, true, -1);
    if (cells_[c].at[0] == 0) join(c, 0, false, -1);
  }
}

void EnergyCells::look_at(int index) {
  Cell& cell = cells_[index];
  ++looked_at_;
  const std::vector<RealRange> open = heights_->open({across_.value(cell.at[0]), across_.value(cell.end(0))},
                                                     {turn_.value(cell.at[1]), turn_.value(cell.end(1))});
  cell.first_node = static_cast<int>(nodes_.size());
  cell.node_count = static_cast<int>(open.size());
  for (const RealRange& range : open) nodes_.push_back({index, range, {}});
}

double EnergyCells::side_mm(const Cell& cell, int k) const {
  return (axis(k).value(cell.end(k)) - axis(k).value(cell.at[k])) * (k == 0 ? 1 : layout_.reach_mm);
}

double EnergyCells::size_mm(int cell) const { return std::max(side_mm(cells_[cell], 0), side_mm(cells_[cell], 1)); }

int EnergyCells::axis_to_split(int index) const {
  const Cell& cell = cells_[index];
  const int longer = side_mm(cell, 0) >= side_mm(cell, 1) ? 0 : 1;
  return cell.level[longer] > 0 && side_mm(cell, longer) >= 2 * layout_.least_mm ? longer : -1;
}

// The leaves within a largest cell, or a part of it, that touch this side from below or above.
void EnergyCells::leaves_on(int index, int k, std::int64_t at, std::int64_t from, std::int64_t to, bool below,
                            std::vector<int>& found) const {
  const Cell& cell = cells_[index];
  if (cell.at[1 - k] >= to || cell.end(1 - k) <= from) return;
  if (cell.first_child >= 0) {
    leaves_on(cell.first_child, k, at, from, to, below, found);
    leaves_on(cell.first_child + 1, k, at, from, to, below, found);
  } else if ((below ? cell.end(k) : cell.at[k]) == at) {
    found.push_back(index);
  }
}

// All crossings on one side of a leaf, but for those to `except`.
void EnergyCells::join(int index, int k, bool above, int except) {
  const Cell cell = cells_[index];
  std::int64_t at = above ? cell.end(k) : cell.at[k];
  const bool at_end = at == (above ? axis(k).end() : 0);
  if (k == 0 && at_end) {
    for (int n = 0; n < cell.node_count; ++n) {
      add_crossing(cell.first_node + n, kOutside, nodes_[cell.first_node + n].heights, k, at, cell.at[1], cell.end(1));
    }
    return;
  }
  if (at_end) at = above ? 0 : axis(k).end();  // round the turn
  std::array<std::int64_t, 2> root{cell.at[0] >> kUnits, cell.at[1] >> kUnits};
  root[k] = above ? at >> kUnits : (at - 1) >> kUnits;
  std::vector<int> others;
  leaves_on(static_cast<int>(root[0] * turns_ + root[1]), k, at, cell.at[1 - k], cell.end(1 - k), !above, others);
  for (const int other : others) {
    if (other != except) join(index, other, k, at);
  }
}

void EnergyCells::join(int index, int other_index, int k, std::int64_t at) {
  const Cell &cell = cells_[index], &other = cells_[other_index];
  const std::int64_t from = std::max(cell.at[1 - k], other.at[1 - k]), to = std::min(cell.end(1 - k), other.end(1 - k));
  for (int a = 0; a < cell.node_count; ++a) {
    for (int b = 0; b < other.node_count; ++b) {
      const int first = cell.first_node + a, second = other.first_node + b;
      const RealRange both = common(nodes_[first].heights, nodes_[second].heights);
      if (is_some(both)) add_crossing(first, second, both, k, at, from, to);
    }
  }
}

void EnergyCells::add_crossing(int first, int second, const RealRange& heights, int k, std::int64_t at,
                               std::int64_t from, std::int64_t to) {
  Crossing crossing;
  crossing.first = first;
  crossing.second = second;
  crossing.heights = heights;
  crossing.axis = k;
  crossing.at = at;
  crossing.from = from;
  crossing.to = to;
  const int index = static_cast<int>(crossings_.size());
  crossings_.push_back(std::move(crossing));
  nodes_[first].crossings.push_back(index);
  nodes_[second].crossings.push_back(index);
}

std::vector<int> EnergyCells::nodes_at(const Place& place) const {
  std::vector<int> found, waiting;
  for (int root = 0; root < static_cast<int>(cells_.size()) && cells_[root].root == root; ++root) {
    waiting.push_back(root);
  }
  while (!waiting.empty()) {
    const Cell& cell = cells_[waiting.back()];
    waiting.pop_back();
    const double low = across_.value(cell.at[0]), high = across_.value(cell.end(0));
    if (place.across_mm < low - kHere || place.across_mm > high + kHere) continue;
    const double middle = (turn_.value(cell.at[1]) + turn_.value(cell.end(1))) / 2;
    const double half = turn_.value(cell.end(1)) - middle;
    if (std::abs(std::remainder(place.turn_rad - middle, kFullTurn)) > half + kHere) continue;
    if (cell.first_child >= 0) {
      waiting.push_back(cell.first_child);
      waiting.push_back(cell.first_child + 1);
      continue;
    }
    for (int n = cell.first_node; n < cell.first_node + cell.node_count; ++n) {
      const RealRange& heights = nodes_[n].heights;
      if (place.height_mm >= heights.low - kHere_mm && place.height_mm <= heights.high + kHere_mm) found.push_back(n);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

const std::vector<RealRange>& EnergyCells::free_at(double across_mm, double turn_rad, std::int64_t key_across,
                                                   std::int64_t key_turn) {
  const std::uint64_t key = static_cast<std::uint64_t>(key_across) << 32 | static_cast<std::uint64_t>(key_turn);
  const auto [entry, is_new] = free_.try_emplace(key);
  if (is_new) {
    ++looked_at_;
    entry->second = heights_->free(across_mm, turn_rad);
  }
  return entry->second;
}

void EnergyCells::tighten(int index) {
  Crossing& crossing = crossings_[index];
  if (crossing.is_tight) return;
  crossing.is_tight = true;
  const int k = crossing.axis;
  const double at = axis(k).value(crossing.at);
  const double from = axis(1 - k).value(crossing.from), to = axis(1 - k).value(crossing.to);
  ++looked_at_;
  const std::vector<RealRange> open =
      k == 0 ? heights_->open({at, at}, {from, to}) : heights_->open({from, to}, {at, at});
  RealRange within{1, 0};
  for (const RealRange& range : open) {
    const RealRange here = common(range, crossing.heights);
    if (!is_some(here)) continue;
    within = is_some(within) ? RealRange{std::min(within.low, here.low), std::max(within.high, here.high)} : here;
  }
  if (!is_some(within)) {
    crossing.is_alive = false;
    return;
  }
  crossing.heights = within;
  for (const int part : {1, 0, 2}) {  // in half units, the middle first
    const std::int64_t along = (2 - part) * crossing.from + part * crossing.to;
    const double value = part == 0 ? from : part == 2 ? to : from + (to - from) / 2;
    const std::int64_t whole = 2 * turn_.end();
    const std::array<double, 2> place = k == 0 ? std::array{at, value} : std::array{value, at};
    const std::array<std::int64_t, 2> key =
        k == 0 ? std::array{2 * crossing.at, along % whole} : std::array{along, 2 * crossing.at % whole};
    for (const RealRange& range : free_at(place[0], place[1], key[0], key[1])) {
      const RealRange here = common(range, within);
      if (is_some(here)) crossing.places.push_back({place[0], place[1], here});
    }
  }
  std::stable_sort(crossing.places.begin(), crossing.places.end(),
                   [](const CrossingPlace& a, const CrossingPlace& b) { return a.heights.low < b.heights.low; });
}

void EnergyCells::lift_bans() {
  for (Crossing& crossing : crossings_) crossing.is_banned = false;
}

void EnergyCells::split(int index) {
  const int k = axis_to_split(index);
  if (k < 0 || cells_[index].first_child >= 0) return;
  const Cell parent = cells_[index];
  for (int n = parent.first_node; n < parent.first_node + parent.node_count; ++n) {
    for (const int crossing : nodes_[n].crossings) crossings_[crossing].is_alive = false;
    nodes_[n].crossings.clear();
  }
  const int first = static_cast<int>(cells_.size());
  cells_[index].first_child = first;
  for (int child = 0; child < 2; ++child) {
    Cell cell = parent;
    --cell.level[k];
    cell.at[k] = parent.at[k] + child * (std::int64_t{1} << cell.level[k]);
    cell.first_child = -1;
    cells_.push_back(cell);
    look_at(first + child);
  }
  for (int child = first; child < first + 2; ++child) {
    for (int side = 0; side < 4; ++side) join(child, side / 2, side % 2 == 1, child > first ? first : -1);
  }
}

}  // namespace formotion
