// The merge tree: Prim's algorithm over searches that share their cells, then its ways in ascending height.
#include <algorithm>
#include <numeric>

#include "analysis/energy/way_layout.hpp"

namespace formotion {
namespace {

struct Groups {
  std::vector<int> parent, number;  // of a group: what passes call it
  explicit Groups(int count) : parent(count), number(count) {
    std::iota(parent.begin(), parent.end(), 0);
    std::iota(number.begin(), number.end(), 0);
  }
  int of(int member) const {
    while (parent[member] != member) member = parent[member];
    return member;
  }
};

}  // namespace

MergeTree merge_tree(const ContactSpace& space, const Gravity& gravity, const std::vector<Configuration>& starts,
                     const EscapeGoal& goal, const EscapeOptions& options) {
  MergeTree tree;
  const int count = static_cast<int>(starts.size());
  if (count == 0) return tree;
  LaidOutSearch laid_out(space, gravity, starts, goal, options);
  WaySearch& search = laid_out.search();
  std::vector<WayEnd> ends;
  for (const Configuration& start : starts) ends.push_back(laid_out.heights().place_of(start));
  ends.push_back(std::nullopt);
  std::vector<Pass> ways;
  std::vector<bool> joined(ends.size());
  joined.back() = true;
  for (int i = 0; i < count; ++i) {
    const Place& place = *ends[i];
    EscapeBracket bracket;
    if (is_beyond(goal, place)) {  // outside already
      joined[i] = true;
      ways.push_back({i, count, place.height_mm, place.height_mm, starts[i]});
      if (options.want_path) {
        bracket.upper_mm = 0;
        bracket.path = {starts[i]};
        bracket.pass = starts[i];
      }
    } else {
      const long before = search.looked_at();
      bracket =
          bracket_of(search.lowest_way({ends[i]}, {std::nullopt}, demand_of(options)), laid_out.heights(), starts[i]);
      bracket.cells = search.looked_at() - before;
    }
    tree.brackets.push_back(std::move(bracket));
  }
  for (;;) {
    std::vector<WayEnd> from, to;
    std::vector<int> known, others;
    for (int i = 0; i <= count; ++i) {
      if (i < count && is_beyond(goal, *ends[i])) continue;
      (joined[i] ? from : to).push_back(ends[i]);
      (joined[i] ? known : others).push_back(i);
    }
    if (others.empty()) break;
    const LowestWay way = search.lowest_way(from, to, demand_of(options));
    if (way.source < 0 || way.target < 0) {  // none of them can be reached: they have a tree of their own
      joined[others.front()] = true;
      continue;
    }
    joined[others[way.target]] = true;
    ways.push_back(
        {others[way.target], known[way.source], way.lower_mm, way.upper_mm, pass_of(way, laid_out.heights())});
  }
  std::stable_sort(ways.begin(), ways.end(), [](const Pass& a, const Pass& b) { return a.lower_mm < b.lower_mm; });
  Groups groups(count + 1);
  for (Pass& pass : ways) {
    const int first = groups.of(pass.first), second = groups.of(pass.second);
    pass.first = std::min(groups.number[first], groups.number[second]);
    pass.second = std::max(groups.number[first], groups.number[second]);
    groups.parent[first] = second;
    groups.number[second] = count + 1 + static_cast<int>(tree.passes.size());
    tree.passes.push_back(pass);
  }
  tree.cells = search.looked_at();
  return tree;
}

}  // namespace formotion
