// Motions along chains of cells.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <queue>
#include <tuple>

#include "analysis/energy/lowest_way.hpp"

namespace formotion {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kHalvings = 6;
constexpr double kHere_mm = 1e-6;
constexpr double kBelow_mm = 1;                           // a ceiling with nothing below
constexpr std::array<double, 3> kOff_mm{0.4, 0.1, 0.02};  // first moves out of contacts that do not let it rise
constexpr std::size_t kMostOff = 8;

// As high as allowed, so that what lies between is cleared; in the middle under a ceiling.
double height_in(const RealRange& heights, double most_mm) {
  if (heights.high > most_mm) return std::max(heights.low, most_mm);
  return std::isfinite(heights.low) ? heights.low + (heights.high - heights.low) / 2 : heights.high - kBelow_mm;
}

double turned_on(double from, double to) { return from + std::remainder(to - from, 2 * std::numbers::pi); }

}  // namespace

// The chain whose crossings have the lowest free places, of those the shortest.
std::optional<WaySearch::Chain> WaySearch::chain(const std::vector<WayEnd>& from, const std::vector<WayEnd>& to,
                                                 double most_mm, bool tighten) {
  struct Label {
    double cost = kInfinity;
    int steps = 0, via = -1, before = -1, source = -1;
    bool is_done = false;
  };
  std::vector<Label> labels(cells_.nodes().size());
  using Waiting = std::tuple<double, int, int>;
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> waiting;
  const auto reach = [&](int node, const Label& label) {
    Label& known = labels[node];
    if (known.is_done || label.cost > most_mm) return;
    if (std::tie(label.cost, label.steps) >= std::tie(known.cost, known.steps)) return;
    known = label;
    waiting.push({label.cost, label.steps, node});
  };
  for (int i = 0; i < static_cast<int>(from.size()); ++i) {
    for (const int node : nodes_of(from[i])) {
      reach(node, {from[i] ? from[i]->height_mm : -kInfinity, 0, -1, -1, i, false});
    }
  }
  std::vector<int> target(cells_.nodes().size(), -1);
  for (int i = 0; i < static_cast<int>(to.size()); ++i) {
    for (const int node : nodes_of(to[i])) {
      if (target[node] < 0) target[node] = i;
    }
  }
  while (!waiting.empty()) {
    const int node = std::get<2>(waiting.top());
    waiting.pop();
    if (labels[node].is_done) continue;
    labels[node].is_done = true;
    if (target[node] >= 0) {
      Chain found;
      found.source = labels[node].source;
      found.target = target[node];
      found.least_mm = labels[node].cost;
      if (to[found.target]) found.least_mm = std::max(found.least_mm, to[found.target]->height_mm);
      for (int at = node; at >= 0; at = labels[at].before) {
        found.nodes.push_back(at);
        if (labels[at].via >= 0) found.crossings.push_back(labels[at].via);
      }
      std::reverse(found.nodes.begin(), found.nodes.end());
      std::reverse(found.crossings.begin(), found.crossings.end());
      return found;
    }
    for (const int index : cells_.nodes()[node].crossings) {
      if (cells_.crossings()[index].is_alive && tighten) cells_.tighten(index);
      const Crossing& crossing = cells_.crossings()[index];
      if (crossing.is_banned || !crossing.is_passed_by(most_mm)) continue;
      const Label& here = labels[node];
      reach(
          crossing.first == node ? crossing.second : crossing.first,
          {std::max(here.cost, crossing.places.front().heights.low), here.steps + 1, index, node, here.source, false});
    }
  }
  return std::nullopt;
}

// Straight up from a place, under what is above it.
std::optional<Place> WaySearch::raised(const Place& place, double most_mm) const {
  const auto up_to = [&](double height) {
    return Place{place.across_mm, std::max(height, place.height_mm), place.turn_rad};
  };
  for (const RealRange& range : heights_->free(place.across_mm, place.turn_rad)) {
    if (place.height_mm < range.low - kHere_mm || place.height_mm > range.high + kHere_mm) continue;
    const Place up = up_to(height_in({std::max(place.height_mm, range.low), range.high}, most_mm));
    if (heights_->is_straight_free(place, up)) return up;
  }
  // Touching a round corner, which counts as larger there.
  const Place up = up_to(most_mm);
  return heights_->is_straight_free(place, up) ? std::optional(up) : std::nullopt;
}

// Small free motions from a place that cannot rise: to all sides, in across, height and turn.
std::vector<Place> WaySearch::moved_off(const Place& place, double most_mm) const {
  std::vector<Place> found;
  for (const double size : kOff_mm) {
    for (int k = 0; k < 27 && found.size() < kMostOff; ++k) {
      const Place to{place.across_mm + size * (k % 3 - 1), place.height_mm + size * (k / 3 % 3 - 1),
                     place.turn_rad + size / cells_.reach_mm() * (k / 9 - 1)};
      if (k != 13 && to.height_mm <= most_mm && heights_->is_straight_free(place, to)) found.push_back(to);
    }
  }
  return found;
}

WaySearch::Trial WaySearch::follow(const Chain& chain, const std::vector<WayEnd>& from, const std::vector<WayEnd>& to,
                                   double most_mm) const {
  struct State {
    std::vector<Place> places;  // since the state before
    int before = -1;
  };
  std::vector<std::vector<State>> states(1);
  if (const WayEnd& start = from[chain.source]) {
    if (const auto up = raised(*start, most_mm)) states[0].push_back({{*start, *up}, -1});
    states[0].push_back({{*start}, -1});
    if (states[0].size() < 2) {
      for (const Place& off : moved_off(*start, most_mm)) states[0].push_back({{*start, off}, -1});
    }
  } else {
    states[0].push_back({{}, -1});
  }
  const auto step = [&](const std::vector<Place>& ends, bool passes_outside) {
    std::vector<State> next;
    for (Place end : ends) {
      for (int k = 0; k < static_cast<int>(states.back().size()); ++k) {
        const std::vector<Place>& before = states.back()[k].places;
        if (before.empty()) {
          next.push_back({{end}, k});
          break;
        }
        const Place& at = before.back();
        end.turn_rad = turned_on(at.turn_rad, end.turn_rad);
        // Straight, or (into and out of slots without clearance) up or down first or last; outside under everything.
        std::vector<std::vector<Place>> ways{{end},
                                             {{at.across_mm, end.height_mm, at.turn_rad}, end},
                                             {{end.across_mm, at.height_mm, end.turn_rad}, end}};
        if (passes_outside) {
          ways = {{{at.across_mm, under_mm_, at.turn_rad}, {end.across_mm, under_mm_, end.turn_rad}, end}};
        }
        const auto free_way = std::find_if(ways.begin(), ways.end(), [&](const std::vector<Place>& way) {
          for (std::size_t i = 0; i < way.size(); ++i) {
            if (!heights_->is_straight_free(i == 0 ? at : way[i - 1], way[i])) return false;
          }
          return true;
        });
        if (free_way == ways.end()) continue;
        std::vector<Place> way = std::move(*free_way);
        next.push_back({std::move(way), k});
        break;
      }
    }
    const bool found = !next.empty();
    if (found) states.push_back(std::move(next));
    return found;
  };
  Trial trial;
  for (std::size_t k = 0; k < chain.crossings.size(); ++k) {
    std::vector<Place> ends;
    for (const CrossingPlace& place : cells_.crossings()[chain.crossings[k]].places) {
      if (place.heights.low > most_mm) break;
      ends.push_back({place.across_mm, height_in(place.heights, most_mm), place.turn_rad});
    }
    trial.failed = k;
    if (!step(ends, k > 0 && chain.nodes[k] == EnergyCells::kOutside)) return trial;
  }
  if (const WayEnd& end = to[chain.target]) {
    trial.failed = chain.crossings.size();
    bool arrived = false;
    if (const std::optional<Place> up = raised(*end, most_mm); up && step({*up}, false)) {
      arrived = step({*end}, false);
      if (!arrived) states.pop_back();
    }
    if (!arrived && !step({*end}, false)) return trial;
  }
  int k = 0;
  for (std::size_t i = states.size(); i-- > 0;) {
    const State& state = states[i][k];
    trial.path.insert(trial.path.end(), state.places.rbegin(), state.places.rend());
    k = state.before;
  }
  std::reverse(trial.path.begin(), trial.path.end());
  return trial;
}

// The same chain with less height to spare, as long as a motion is found.
void WaySearch::sharpen(const Chain& chain, const std::vector<WayEnd>& from, const std::vector<WayEnd>& to,
                        double most_mm, std::vector<Place>& path) const {
  double low = chain.least_mm, high = most_mm;
  for (int i = 0; i <= kHalvings && high > low; ++i) {
    const double height = i == 0 ? low : low + (high - low) / 2;
    Trial trial = follow(chain, from, to, height);
    (trial.path.empty() ? low : high) = height;
    if (!trial.path.empty()) path = std::move(trial.path);
  }
}

}  // namespace formotion
