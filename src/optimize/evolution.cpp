#include "optimize/evolution.hpp"

#include <algorithm>
#include <numeric>
#include <pagmo/utils/multi_objective.hpp>
#include <set>
#include <utility>

#include "optimize/variation.hpp"

namespace formotion {
namespace {

constexpr std::size_t kRecent = 1000;       // evaluations that parents come from, besides the fronts
constexpr std::size_t kPopulation = 100;    // parents
constexpr double kFresh = 0.05;             // children without parents
constexpr double kTopologyChange = 0.05;    // children in another topology than their parent's
constexpr double kDifferential = 0.75;      // children by a difference of relatives, where there are enough
constexpr double kInherited = 0.1;          // coordinates that such a step leaves alone
constexpr double kShortest = 0.4;           // such steps, as a share of the difference, up to all of it
constexpr double kSameTopology = 0.7;       // mates that are looked for in the parent's own topology
constexpr std::size_t kLeastRelatives = 4;  // for differences
constexpr std::size_t kAttempts = 20;       // a child
constexpr std::size_t kPiece = 16;          // candidates a task

class Breeder {
 public:
  Breeder(const Problem& problem, const RunState& state, RandomStream& random, std::span<const int> topologies)
      : problem_(problem), state_(state), random_(random), scope_(topologies.begin(), topologies.end()) {
    if (scope_.empty()) {
      scope_.resize(problem.topologies().size());
      std::iota(scope_.begin(), scope_.end(), 0);
    }
    std::sort(scope_.begin(), scope_.end());
    for (const int topology : scope_) {
      if (!archived(topology).empty()) settled_.push_back(topology);
    }
    select_population();
  }

  std::vector<Candidate> breed(std::size_t count) {
    std::vector<Candidate> children;
    for (std::size_t attempt = 0; attempt < kAttempts * count && children.size() < count; ++attempt) {
      Candidate child = one();
      if (!is_new(child)) continue;
      bred_.emplace(child.topology, child.values);
      children.push_back(std::move(child));
    }
    return children;
  }

 private:
  const Variable& variable(int index) const { return problem_.variables()[static_cast<std::size_t>(index)]; }
  const std::vector<int>& variables_of(int topology) const {
    return problem_.topologies()[static_cast<std::size_t>(topology)].variables;
  }
  bool in_scope(int topology) const { return std::binary_search(scope_.begin(), scope_.end(), topology); }
  bool is_new(const Candidate& candidate) const {
    return !state_.find(candidate) && !bred_.contains({candidate.topology, candidate.values});
  }
  double chance() { return random_.uniform(); }

  // The best of what the fronts keep and of what came last: nearly what the best of everything would be, at a cost
  // that does not grow with the run.
  void select_population() {
    std::set<std::int64_t> numbers;
    for (const Archive::Member& member : state_.front().members()) numbers.insert(member.number);
    const auto& all = state_.evaluations();
    for (std::size_t i = all.size() - std::min(all.size(), kRecent); i < all.size(); ++i) numbers.insert(all[i].number);
    std::vector<const Evaluated*> pool;
    std::vector<const Score*> scores;
    for (const std::int64_t number : numbers) {
      const Evaluated& known = state_.evaluation(number);
      if (!in_scope(known.candidate.topology)) continue;
      pool.push_back(&known);
      scores.push_back(&known.score);
    }
    for (const std::size_t place : feasible_first(scores, problem_.objectives())) {
      if (population_.size() == kPopulation) break;
      population_.push_back(&pool[place]->candidate);
    }
  }

  // What is known to be good in a topology: its front, or what is nearest to feasibility.
  std::vector<const Candidate*> archived(int topology) const {
    std::vector<const Candidate*> members;
    for (const Archive::Member& member : state_.front_of(topology).members())
      members.push_back(&state_.evaluation(member.number).candidate);
    if (!members.empty()) return members;
    for (const NearPool::Member& member : state_.near(topology).members())
      members.push_back(&state_.evaluation(member.number).candidate);
    return members;
  }

  std::vector<const Candidate*> relatives(int topology) const {
    std::vector<const Candidate*> members;
    for (const Candidate* candidate : population_) {
      if (candidate->topology == topology) members.push_back(candidate);
    }
    return members.size() < kLeastRelatives ? archived(topology) : members;
  }

  // The better of two of the population, or one of any topology's best: a topology that others dominate today may hold
  // the best designs tomorrow.
  const Candidate& parent() {
    if (random_.below(2) == 0 && !population_.empty()) {
      const int a = random_.below(static_cast<int>(population_.size()));
      const int b = random_.below(static_cast<int>(population_.size()));
      return *population_[static_cast<std::size_t>(std::min(a, b))];
    }
    return *random_.pick(archived(random_.pick(settled_)));
  }

  Candidate one() {
    if (settled_.empty() || chance() < kFresh) return fresh(random_.pick(scope_));
    const Candidate& first = parent();
    if (chance() < kTopologyChange && scope_.size() > 1)
      return varied(with_topology(problem_, first, related(first.topology), random_));
    const std::vector<const Candidate*> kin = relatives(first.topology);
    if (kin.size() >= kLeastRelatives && chance() < kDifferential) return differential(first, kin);
    return varied(recombined(first, chance() < kSameTopology ? *random_.pick(kin) : parent()));
  }

  // The starting values, or a random candidate.
  Candidate fresh(int topology) {
    Candidate candidate{topology, {}};
    for (const int index : variables_of(topology)) candidate.values.push_back(variable(index).start());
    if (is_new(candidate)) return candidate;
    for (std::size_t i = 0; i < candidate.values.size(); ++i) set(candidate, i, chance());
    return candidate;
  }

  // Another topology of the scope, the likelier the more variables it shares.
  int related(int topology) {
    const std::vector<int>& mine = variables_of(topology);
    std::vector<std::uint64_t> up_to;
    for (const int other : scope_) {
      std::uint64_t shared = 0;
      for (const int index : variables_of(other)) shared += std::binary_search(mine.begin(), mine.end(), index);
      up_to.push_back((up_to.empty() ? 0 : up_to.back()) + (other == topology ? 0 : shared));
    }
    if (up_to.back() == 0) return random_.pick(scope_);
    const auto at = std::upper_bound(up_to.begin(), up_to.end(), random_.next() % up_to.back());
    return scope_[static_cast<std::size_t>(at - up_to.begin())];
  }

  // A child of the first parent's topology: half of the variables that both parents have are crossed.
  Candidate recombined(const Candidate& first, const Candidate& second) {
    Candidate child = first;
    const std::vector<int>& mine = variables_of(first.topology);
    const std::vector<int>& theirs = variables_of(second.topology);
    for (std::size_t i = 0; i < mine.size(); ++i) {
      const auto at = std::lower_bound(theirs.begin(), theirs.end(), mine[i]);
      if (at == theirs.end() || *at != mine[i] || random_.below(2) == 0) continue;
      const double other = second.values[static_cast<std::size_t>(at - theirs.begin())];
      if (other != child.values[i])
        set(child, i, crossed(unit(mine[i], child.values[i]), unit(mine[i], other), random_));
    }
    return child;
  }

  // Differences between relatives follow valleys that lie across the coordinates, where crossing them one by one fails.
  Candidate differential(const Candidate& first, const std::vector<const Candidate*>& kin) {
    Candidate child = first;
    const Candidate &from = *random_.pick(kin), &to = *random_.pick(kin);
    const double share = kShortest + (1 - kShortest) * chance();
    const std::vector<int>& mine = variables_of(first.topology);
    for (std::size_t i = 0; i < mine.size(); ++i) {
      if (to.values[i] == from.values[i] || chance() < kInherited) continue;
      const double by = share * (unit(mine[i], to.values[i]) - unit(mine[i], from.values[i]));
      set(child, i, stepped(unit(mine[i], first.values[i]), by, random_));
    }
    return child;
  }

  // One variable in the mean is mutated.
  Candidate varied(Candidate candidate) {
    const std::vector<int>& indices = variables_of(candidate.topology);
    for (std::size_t i = 0; i < indices.size(); ++i) {
      if (random_.below(static_cast<int>(indices.size())) == 0)
        set(candidate, i, mutated(unit(indices[i], candidate.values[i]), random_));
    }
    return candidate;
  }

  double unit(int index, double value) const {
    const Variable& v = variable(index);
    return v.max > v.min ? std::clamp((value - v.min) / (v.max - v.min), 0.0, 1.0) : 0;
  }
  void set(Candidate& candidate, std::size_t place, double unit_value) const {
    const Variable& v = variable(variables_of(candidate.topology)[place]);
    candidate.values[place] = std::min(v.max, v.min + unit_value * (v.max - v.min));
  }

  const Problem& problem_;
  const RunState& state_;
  RandomStream& random_;
  std::vector<int> scope_;                    // ascending
  std::vector<int> settled_;                  // those of the scope in which something is known
  std::vector<const Candidate*> population_;  // best first
  std::set<std::pair<int, std::vector<double>>> bred_;
};

}  // namespace

std::vector<std::size_t> feasible_first(const std::vector<const Score*>& scores,
                                        std::span<const Objective> objectives) {
  std::vector<std::size_t> order, feasible, infeasible;
  for (std::size_t i = 0; i < scores.size(); ++i) (scores[i]->feasible ? feasible : infeasible).push_back(i);
  if (feasible.size() < 2) {
    order = feasible;
  } else {
    std::vector<std::vector<double>> losses;
    for (const std::size_t i : feasible) {
      std::vector<double> loss;
      for (std::size_t k = 0; k < objectives.size(); ++k)
        loss.push_back(objectives[k].loss(scores[i]->objectives[k]) + 0.0);
      if (loss.size() == 1) loss.push_back(0);  // pagmo begins at two objectives
      losses.push_back(std::move(loss));
    }
    const auto fronts = std::get<0>(pagmo::fast_non_dominated_sorting(losses));
    for (std::vector<std::size_t> front : fronts) {
      std::sort(front.begin(), front.end());
      std::vector<std::vector<double>> members;
      for (const std::size_t i : front) members.push_back(losses[i]);
      const std::vector<double> room =
          front.size() > 1 ? pagmo::crowding_distance(members) : std::vector<double>(front.size(), 0.0);
      std::vector<std::size_t> by_room(front.size());
      std::iota(by_room.begin(), by_room.end(), std::size_t{0});
      std::stable_sort(by_room.begin(), by_room.end(), [&](std::size_t a, std::size_t b) { return room[a] > room[b]; });
      for (const std::size_t i : by_room) order.push_back(feasible[front[i]]);
    }
  }
  std::stable_sort(infeasible.begin(), infeasible.end(),
                   [&](std::size_t a, std::size_t b) { return scores[a]->violation < scores[b]->violation; });
  order.insert(order.end(), infeasible.begin(), infeasible.end());
  return order;
}

Candidate with_topology(const Problem& problem, const Candidate& candidate, int topology, RandomStream& random) {
  const std::vector<int>& old = problem.topologies()[static_cast<std::size_t>(candidate.topology)].variables;
  Candidate moved{topology, {}};
  for (const int index : problem.topologies()[static_cast<std::size_t>(topology)].variables) {
    const Variable& variable = problem.variables()[static_cast<std::size_t>(index)];
    const auto at = std::lower_bound(old.begin(), old.end(), index);
    if (at != old.end() && *at == index) {
      moved.values.push_back(candidate.values[static_cast<std::size_t>(at - old.begin())]);
    } else if (random.below(2) == 0) {
      moved.values.push_back(variable.start());
    } else {
      moved.values.push_back(std::min(variable.max, variable.min + random.uniform() * (variable.max - variable.min)));
    }
  }
  return moved;
}

std::vector<Candidate> next_generation(const Problem& problem, const RunState& state, std::size_t count,
                                       RandomStream& random, std::span<const int> topologies) {
  return Breeder(problem, state, random, topologies).breed(count);
}

std::vector<SearchTask> evolution_tasks(const Problem& problem, const RunState& state, std::int64_t evaluations,
                                        RandomStream& random, std::span<const int> topologies) {
  std::vector<Candidate> children =
      next_generation(problem, state, static_cast<std::size_t>(evaluations), random, topologies);
  // A task stays in one topology.
  std::stable_sort(children.begin(), children.end(),
                   [](const Candidate& a, const Candidate& b) { return a.topology < b.topology; });
  const std::size_t objectives = problem.objectives().size();
  std::vector<SearchTask> tasks;
  for (Candidate& child : children) {
    if (tasks.empty() || tasks.back().topology != child.topology || tasks.back().listed.size() == kPiece) {
      SearchTask task;
      task.driver = Driver::Listed;
      task.topology = child.topology;
      task.merit = {0, std::vector<std::optional<double>>(objectives), std::vector<double>(objectives, 1.0)};
      task.provenance = "evolution";
      tasks.push_back(std::move(task));
    }
    tasks.back().listed.push_back(std::move(child));
    tasks.back().evaluations = static_cast<std::int64_t>(tasks.back().listed.size());
  }
  return tasks;
}

}  // namespace formotion
