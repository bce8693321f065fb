#include "witness/escape_planner.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>
#include <numeric>

namespace formotion::witness {
namespace {

constexpr double kMargin_mm = 1e-6;  // clearance of all that is called free
constexpr double kPiece_mm = 5e-3;   // of motions that are not proved yet
constexpr long kLooks = 300, kProofLooks = 400000;
constexpr int kNeighbours = 6;
constexpr int kDraws = 12;  // for each free sample that is asked for, at most

// Of many scales alike.
double scale(Random& random, double least, double most) {
  return least * std::pow(most / least, uniform(random, 0, 1));
}

class Roadmap {
 public:
  Roadmap(const PlannedNest& nest, const WayQuestion& question)
      : nest_(nest), question_(question), random_(question.seed), level_(question.below_mm) {}

  FoundWay found() {
    groups_ = {0};
    add(question_.start);
    for (const Configuration& q : question_.hint) add_near(q);
    for (long draws = 0; way_.free_samples < question_.free_samples && draws < kDraws * question_.free_samples; ++draws)
      add(finished(drawn()));
    return way_;
  }

 private:
  struct Edge {
    int a, b;
    bool is_proved = false, is_wrong = false;
  };

  bool is_out(const Configuration& q) const { return q.x_mm <= question_.from_mm || q.x_mm >= question_.to_mm; }
  bool is_good(const Configuration& q) const { return q.y_mm < level_ && nest_.clearance_mm(q) >= kMargin_mm; }
  Configuration moved(const Configuration& q, double by_mm) {
    return {q.x_mm + uniform(random_, -by_mm, by_mm), q.y_mm + uniform(random_, -by_mm, by_mm),
            q.theta_rad + uniform(random_, -by_mm, by_mm) / nest_.reach_mm()};
  }

  // Hints may touch: a free place beside them.
  void add_near(const Configuration& q) {
    focus_.push_back(q);
    for (int k = 0; k < 24; ++k) {
      Configuration beside = moved(q, scale(random_, 2e-6, 1e-2));
      if (k % 2 == 0) beside.y_mm = std::min(beside.y_mm, level_ - 1e-9);
      if (is_good(beside)) return add(beside);
    }
  }

  Configuration drawn() {
    const double kind = uniform(random_, 0, 1);
    const double reach = nest_.reach_mm();
    if (kind < 0.45 && !focus_.empty()) {
      const std::size_t last = focus_.size() - 1;
      const std::size_t k = uniform(random_, 0, 1) < 0.5 ? last : random_() % focus_.size();
      return moved(focus_[k], scale(random_, 1e-4, 3));
    }
    if (kind < 0.7) return moved(nodes_[random_() % nodes_.size()], scale(random_, 1e-2, 2 * reach));
    if (kind < 0.85) {  // between what is joined to the start and what is joined to the outside
      const Configuration a = nodes_[random_() % nodes_.size()], b = nodes_[random_() % nodes_.size()];
      const double h = uniform(random_, 0, 1);
      return {std::lerp(a.x_mm, b.x_mm, h), std::lerp(a.y_mm, b.y_mm, h),
              a.theta_rad + h * std::remainder(b.theta_rad - a.theta_rad, 2 * std::numbers::pi)};
    }
    const double low = std::min(question_.start.y_mm, level_ - reach) - 2 * reach;
    return {uniform(random_, question_.from_mm - 0.2 * reach, question_.to_mm + 0.2 * reach),
            uniform(random_, low, level_), uniform(random_, -std::numbers::pi, std::numbers::pi)};
  }

  // As drawn, or lowered to a contact, or to where it lies in its orientation.
  Configuration finished(Configuration q) {
    q.y_mm = std::min(q.y_mm, level_ - scale(random_, 1e-7, 1e-1));
    const double kind = uniform(random_, 0, 1);
    if (kind < 0.3 || !is_good(q)) return q;
    const double off = scale(random_, 2 * kMargin_mm, 0.05);
    q = lowered(q, off);
    if (kind < 0.55) return q;
    double step = scale(random_, 0.05, 1);
    for (int k = 0; k < 14; ++k) {  // sideways and down again, while that is lower
      const double side = (random_() & 1) != 0 ? step : -step;
      Configuration next{q.x_mm + side, q.y_mm + 0.7 * step, q.theta_rad};
      bool sinks = false;
      if (is_good(next)) {
        next = lowered(next, off);
        sinks = next.y_mm < q.y_mm;
      }
      if (sinks) {
        q = next;
      } else {
        step *= 0.6;
      }
    }
    return q;
  }

  // Straight down until only off_mm is left, or by the part's size.
  Configuration lowered(Configuration q, double off_mm) const {
    const double floor = q.y_mm - 2 * nest_.reach_mm();
    for (int k = 0; k < 30 && q.y_mm > floor; ++k) {
      const double clear = nest_.clearance_mm(q);
      if (clear <= 1.2 * off_mm) break;
      q.y_mm -= clear - off_mm;
    }
    return q;
  }

  int group(int node) {
    while (groups_[node] != node) node = groups_[node] = groups_[groups_[node]];
    return node;
  }
  void unite(int a, int b) { groups_[group(a)] = group(b); }

  void add(const Configuration& q) {
    if (!is_good(q)) return;
    ++way_.free_samples;
    const int node = static_cast<int>(nodes_.size());
    nodes_.push_back(q);
    groups_.push_back(node + 1);
    if (is_out(q)) unite(node + 1, 0);
    std::vector<std::pair<double, int>> near;
    for (int k = 0; k < node; ++k) {
      const Configuration& other = nodes_[k];
      if (other.y_mm >= level_) continue;
      // The turn counts by half the reach: parts are mostly nearer to their middle.
      near.emplace_back(
          std::abs(other.x_mm - q.x_mm) + std::abs(other.y_mm - q.y_mm) +
              0.5 * nest_.reach_mm() * std::abs(std::remainder(other.theta_rad - q.theta_rad, 2 * std::numbers::pi)),
          k);
    }
    const auto join = [&](int other) {
      if (group(other + 1) == group(node + 1)) return;
      if (!nest_.is_motion_free(nodes_[other], q, kMargin_mm, kPiece_mm, kLooks)) return;
      edges_.push_back({other, node});
      unite(other + 1, node + 1);
    };
    const std::size_t count = std::min<std::size_t>(near.size(), 4 * kNeighbours);
    std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count), near.end());
    int tried = 0;
    for (std::size_t i = 0; i < count && tried < kNeighbours; ++i) {
      if (group(near[i].second + 1) == group(node + 1)) continue;
      ++tried;
      join(near[i].second);
    }
    // And the nearest of the two groups that matter.
    for (const int wanted : {0, 1}) {
      int nearest = -1;
      double least = 1e300;
      for (const auto& [distance, k] : near) {
        if (distance < least && group(k + 1) == group(wanted)) {
          least = distance;
          nearest = k;
        }
      }
      if (nearest >= 0) join(nearest);
    }
    while (group(1) == group(0)) settle();
  }

  // The start is joined to the outside: proves that way, and sinks below it.
  void settle() {
    std::vector<std::vector<int>> by_node(nodes_.size());
    for (int e = 0; e < static_cast<int>(edges_.size()); ++e) {
      by_node[edges_[e].a].push_back(e);
      by_node[edges_[e].b].push_back(e);
    }
    std::vector<int> via(nodes_.size(), -2);
    std::deque<int> waiting{0};
    via[0] = -1;
    int end = -1;
    while (!waiting.empty() && end < 0) {
      const int node = waiting.front();
      waiting.pop_front();
      if (is_out(nodes_[node])) end = node;
      for (const int e : by_node[node]) {
        const int next = edges_[e].a == node ? edges_[e].b : edges_[e].a;
        if (via[next] != -2) continue;
        via[next] = e;
        waiting.push_back(next);
      }
    }
    std::vector<Configuration> path;
    bool is_proved = end >= 0;
    for (int node = end; node >= 0;) {
      path.push_back(nodes_[node]);
      if (via[node] < 0) break;
      Edge& edge = edges_[via[node]];
      if (!edge.is_proved) {
        edge.is_proved = nest_.is_motion_free(nodes_[edge.a], nodes_[edge.b], kMargin_mm, 2 * kMargin_mm, kProofLooks);
        edge.is_wrong = !edge.is_proved;
        is_proved = is_proved && edge.is_proved;
      }
      node = edge.a == node ? edge.b : edge.a;
    }
    if (is_proved) {
      std::reverse(path.begin(), path.end());
      for (std::size_t k = 1; k < path.size(); ++k) {  // by the shorter turns, as they were looked at
        const double before = path[k - 1].theta_rad;
        path[k].theta_rad = before + std::remainder(path[k].theta_rad - before, 2 * std::numbers::pi);
      }
      way_.got_out = true;
      const auto highest =
          std::max_element(path.begin(), path.end(), [](const auto& a, const auto& b) { return a.y_mm < b.y_mm; });
      level_ = way_.highest_mm = highest->y_mm;
      const auto at = static_cast<std::size_t>(highest - path.begin());
      focus_.clear();
      for (std::size_t k = at - std::min<std::size_t>(at, 3); k < std::min(path.size(), at + 4); ++k) {
        if (k != at) focus_.push_back(path[k]);
      }
      focus_.push_back(path[at]);
      way_.path = std::move(path);
    }
    std::erase_if(edges_, [&](const Edge& edge) {
      return edge.is_wrong || nodes_[edge.a].y_mm >= level_ || nodes_[edge.b].y_mm >= level_;
    });
    std::iota(groups_.begin(), groups_.end(), 0);
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      if (nodes_[k].y_mm < level_ && is_out(nodes_[k])) unite(static_cast<int>(k) + 1, 0);
    }
    for (const Edge& edge : edges_) unite(edge.a + 1, edge.b + 1);
  }

  const PlannedNest& nest_;
  const WayQuestion& question_;
  Random random_;
  double level_;
  std::vector<Configuration> nodes_, focus_;
  std::vector<int> groups_;  // of the outside, then of the nodes: each names another of its group, or itself
  std::vector<Edge> edges_;
  FoundWay way_;
};

}  // namespace

FoundWay look_for_way(const PlannedNest& nest, const WayQuestion& question) {
  if (!(question.start.y_mm < question.below_mm) || nest.clearance_mm(question.start) < kMargin_mm) return {};
  return Roadmap(nest, question).found();
}

Configuration sunk(const PlannedNest& nest, const Configuration& start, Random& random) {
  Configuration at = start;
  for (int failures = 0; failures < 400;) {
    const double by = scale(random, 1e-3, 2);
    const Configuration next{at.x_mm + uniform(random, -by, by), at.y_mm - uniform(random, 0, by),
                             at.theta_rad + uniform(random, -by, by) / nest.reach_mm()};
    const bool sinks = nest.is_motion_free(at, next, 1e-4, 2e-4, 2000);
    if (sinks) at = next;
    failures = sinks ? 0 : failures + 1;
    if (at.y_mm < start.y_mm - 200) break;  // out of everything
  }
  return at;
}

}  // namespace formotion::witness
