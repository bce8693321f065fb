#include "optimize/evolution.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "optimize/nlopt_run.hpp"
#include "toy_problem.hpp"

using namespace formotion;

namespace {

constexpr std::uint64_t kPurpose = 77;
const std::atomic<bool> kGoOn{false};

void evolve(const Problem& problem, RunState& state, std::int64_t evaluations, std::uint64_t seed,
            std::int64_t generation = 100) {
  while (state.spent() < evaluations) {
    RandomStream random(seed, kPurpose, static_cast<std::uint64_t>(state.batches()));
    for (const SearchTask& task : evolution_tasks(problem, state, generation, random))
      state.fold(run_task(problem, task, kGoOn), task.provenance, evaluations - state.spent());
    state.close_batch();
  }
}

double best_gain(const RunState& state, int topology) {
  double best = -1e300;
  for (const Evaluated& e : state.evaluations()) {
    if (e.score.feasible && e.candidate.topology == topology) best = std::max(best, e.score.objectives[0]);
  }
  return best;
}

// One topology, five variables. Turned coordinates u: along u0 the loss falls gently, across it it rises steeply and
// ripples, so that every line along a coordinate crosses ridges. Least loss 0 at u = 0.
class TurnedValley final : public Problem {
 public:
  static constexpr int kDimensions = 5;

  TurnedValley() {
    for (int i = 0; i < kDimensions; ++i) {
      variables_.push_back({"x" + std::to_string(i), -1, 1, std::nullopt});
      topologies_[0].variables.push_back(i);
    }
  }
  std::span<const Variable> variables() const override { return variables_; }
  std::span<const Topology> topologies() const override { return topologies_; }
  std::span<const Objective> objectives() const override { return objectives_; }
  Score score(const Candidate& c, Memory* = nullptr) const override {
    Score score;
    score.feasible = true;
    score.objectives = {loss(c.values)};
    score.work = 1;
    return score;
  }

 private:
  // A Householder reflection: orthogonal, and it mixes all coordinates.
  static double loss(const std::vector<double>& x) {
    const double w[kDimensions] = {0.9, 0.5, -0.4, 0.7, 0.3};
    const double best[kDimensions] = {0.31, -0.22, 0.17, -0.41, 0.28};
    double wx = 0, ww = 0;
    for (int i = 0; i < kDimensions; ++i) {
      wx += w[i] * (x[static_cast<std::size_t>(i)] - best[i]);
      ww += w[i] * w[i];
    }
    double sum = 0;
    for (int i = 0; i < kDimensions; ++i) {
      const double u = x[static_cast<std::size_t>(i)] - best[i] - 2 * w[i] * wx / ww;
      sum += i == 0 ? u * u : 100 * u * u + 2 * (1 - std::cos(40 * u));
    }
    return sum;
  }

  std::vector<Variable> variables_;
  std::vector<Topology> topologies_{{"valley", {}}};
  std::vector<Objective> objectives_{{"loss", false, 0, false}};
};

// Three topologies that share variables in a chain, all feasible.
class ChainProblem final : public Problem {
 public:
  std::span<const Variable> variables() const override { return variables_; }
  std::span<const Topology> topologies() const override { return topologies_; }
  std::span<const Objective> objectives() const override { return objectives_; }
  Score score(const Candidate& c, Memory*) const override {
    return {true, 0, {c.values[0], -c.values[0]}, {}, std::nullopt, 1};
  }

 private:
  std::vector<Variable> variables_{{"a", 0, 1, 0.125}, {"b", 0, 10, 3.25}, {"c", 5, 5, std::nullopt}, {"d", -2, 2, 1}};
  std::vector<Topology> topologies_{{"ab", {0, 1}}, {"bcd", {1, 2, 3}}, {"d", {3}}};
  std::vector<Objective> objectives_{{"up", true, 0, false}, {"down", true, 0, false}};
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace

TEST_CASE("feasible scores come first, by domination; infeasible ones by violation") {
  const std::vector<Objective> objectives{{"gain", true, 0, false}, {"cost", false, 0, false}};
  RandomStream random(3, 3, 3);
  for (int round = 0; round < 50; ++round) {
    std::vector<Score> scores(static_cast<std::size_t>(random.below(30)));
    for (Score& score : scores) {  // few values, so that there are ties
      score.feasible = random.below(2) == 0;
      score.violation = score.feasible ? 0 : 1 + random.below(4);
      score.objectives = {static_cast<double>(random.below(5)), static_cast<double>(random.below(5))};
    }
    std::vector<const Score*> pointers;
    for (const Score& score : scores) pointers.push_back(&score);
    const std::vector<std::size_t> order = feasible_first(pointers, objectives);
    REQUIRE(std::set<std::size_t>(order.begin(), order.end()).size() == scores.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      for (std::size_t j = i + 1; j < order.size(); ++j) {
        const Score &first = scores[order[i]], &second = scores[order[j]];
        REQUIRE((first.feasible || !second.feasible));
        if (!first.feasible) {
          REQUIRE((first.violation < second.violation || (first.violation == second.violation && order[i] < order[j])));
        } else if (second.feasible) {
          REQUIRE_FALSE(dominates(std::vector<double>{-second.objectives[0], second.objectives[1]},
                                  std::vector<double>{-first.objectives[0], first.objectives[1]}));
        }
      }
    }
  }
}

TEST_CASE("of designs that do not dominate each other the ends and the roomier ones come first") {
  const std::vector<Objective> objectives{{"a", false, 0, false}, {"b", false, 0, false}};
  std::vector<Score> scores;
  for (const double a : {0.0, 0.1, 0.2, 0.9, 1.0}) scores.push_back({true, 0, {a, 1 - a}, {}, std::nullopt, 1});
  std::vector<const Score*> pointers;
  for (const Score& score : scores) pointers.push_back(&score);
  // Room: 0.2 for the second, 0.8 for the third and the fourth, all twice.
  CHECK(feasible_first(pointers, objectives) == std::vector<std::size_t>{0, 4, 2, 3, 1});
}

TEST_CASE("one objective ranks by its loss") {
  const std::vector<Objective> objectives{{"gain", true, 0, false}};
  std::vector<Score> scores;
  for (const double gain : {1.0, 3.0, 2.0, 3.5}) scores.push_back({true, 0, {gain}, {}, std::nullopt, 1});
  CHECK(feasible_first({&scores[0], &scores[1], &scores[2], &scores[3]}, objectives) ==
        std::vector<std::size_t>{3, 1, 2, 0});
}

TEST_CASE("evolution finds the best gain of both topologies and the least cost") {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const ToyProblem problem;
    RunState state(problem);
    evolve(problem, state, 4000, seed);
    double cost = 100;
    for (const Evaluated& e : state.evaluations()) {
      if (e.score.feasible) cost = std::min(cost, e.score.objectives[1]);
    }
    CAPTURE(seed);
    CHECK(best_gain(state, 0) == Approx(3).margin(1e-2));
    CHECK(best_gain(state, 1) == Approx(4).margin(1e-2));
    CHECK(cost == Approx(4).margin(1e-2));
  }
}

TEST_CASE("a generation is a pure function of state and stream") {
  const ToyProblem problem;
  RunState state(problem);
  evolve(problem, state, 600, 5);
  RandomStream one(8, kPurpose, 1), two(8, kPurpose, 1), other(9, kPurpose, 1);
  const auto a = next_generation(problem, state, 100, one), b = next_generation(problem, state, 100, two),
             c = next_generation(problem, state, 100, other);
  REQUIRE(a.size() == b.size());
  int differ = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    REQUIRE(a[i].topology == b[i].topology);
    REQUIRE(a[i].values == b[i].values);
    differ += i < c.size() && a[i].values != c[i].values;
  }
  CHECK(differ > 50);
}

TEST_CASE("children are new, no two alike and within their bounds") {
  const ChainProblem problem;
  RunState state(problem);
  for (int generation = 0; generation < 8; ++generation) {
    RandomStream random(2, kPurpose, static_cast<std::uint64_t>(generation));
    const auto children = next_generation(problem, state, 50, random);
    REQUIRE(children.size() == 50);
    std::set<std::pair<int, std::vector<double>>> seen;
    TaskResult result;
    for (const Candidate& child : children) {
      REQUIRE_FALSE(state.find(child));
      REQUIRE(seen.emplace(child.topology, child.values).second);
      const Topology& topology = problem.topologies()[static_cast<std::size_t>(child.topology)];
      REQUIRE(child.values.size() == topology.variables.size());
      for (std::size_t i = 0; i < child.values.size(); ++i) {
        const Variable& variable = problem.variables()[static_cast<std::size_t>(topology.variables[i])];
        REQUIRE((child.values[i] >= variable.min && child.values[i] <= variable.max));
      }
      result.trials.push_back({child, problem.score(child, nullptr)});
    }
    state.fold(result, "test", 1000);
    state.close_batch();
  }
}

TEST_CASE("a candidate keeps the values that it shares with another topology and starts the others") {
  const ChainProblem problem;
  bool started = false, random_value = false;
  for (std::uint64_t i = 0; i < 20; ++i) {
    RandomStream random(1, 1, i);
    const Candidate moved = with_topology(problem, {0, {0.7, 1.0 / 3}}, 1, random);
    REQUIRE(moved.topology == 1);
    REQUIRE(moved.values.size() == 3);
    REQUIRE(moved.values[0] == 1.0 / 3);
    REQUIRE(moved.values[1] == 5);
    started = started || moved.values[2] == 1;
    random_value = random_value || moved.values[2] != 1;
  }
  CHECK(started);
  CHECK(random_value);
}

TEST_CASE("children of a changed topology carry what their parent had of it") {
  const ChainProblem problem;
  RunState state(problem);
  TaskResult known;
  for (int i = 0; i < 20; ++i) known.trials.push_back({{0, {i / 20.0, 1.0 / 7}}, {}});
  for (Trial& trial : known.trials) trial.score = problem.score(trial.candidate, nullptr);
  state.fold(known, "test", 1000);
  state.close_batch();
  RandomStream random(4, kPurpose, 0);
  int changed = 0;
  for (const Candidate& child : next_generation(problem, state, 400, random)) {
    if (child.topology != 0) changed += child.topology == 1 && child.values[0] == 1.0 / 7;
  }
  CHECK(changed > 3);
}

TEST_CASE("children and parents stay within the topologies that are asked for") {
  const ChainProblem problem;
  RunState state(problem);
  evolve(problem, state, 200, 3);
  RandomStream random(4, kPurpose, 0);
  const std::vector<int> some{2, 1};
  std::set<int> seen;
  for (const Candidate& child : next_generation(problem, state, 100, random, some)) seen.insert(child.topology);
  CHECK(seen == std::set<int>{1, 2});
}

TEST_CASE("a problem that has no more candidates gives fewer children and ends") {
  class Still final : public Problem {
   public:
    std::span<const Variable> variables() const override { return {}; }
    std::span<const Topology> topologies() const override { return topologies_; }
    std::span<const Objective> objectives() const override { return objectives_; }
    Score score(const Candidate&, Memory*) const override { return {true, 0, {2}, {}, std::nullopt, 1}; }

   private:
    std::vector<Topology> topologies_{{"a", {}}, {"b", {}}};
    std::vector<Objective> objectives_{{"o", true, 0, false}};
  } problem;
  RunState state(problem);
  RandomStream random(1, kPurpose, 0);
  CHECK(next_generation(problem, state, 10, random).size() == 2);
}

TEST_CASE("tasks hold one topology each, all children once and no more than asked for") {
  const ToyProblem problem;
  RunState state(problem);
  evolve(problem, state, 300, 1);
  RandomStream one(6, kPurpose, 0), two(6, kPurpose, 0);
  const auto children = next_generation(problem, state, 100, one);
  std::set<std::pair<int, std::vector<double>>> bred, listed;
  for (const Candidate& child : children) bred.emplace(child.topology, child.values);
  for (const SearchTask& task : evolution_tasks(problem, state, 100, two)) {
    REQUIRE(task.driver == Driver::Listed);
    REQUIRE(task.evaluations == static_cast<std::int64_t>(task.listed.size()));
    for (const Candidate& child : task.listed) {
      REQUIRE(child.topology == task.topology);
      REQUIRE(listed.emplace(child.topology, child.values).second);
    }
  }
  CHECK(bred == listed);
}

TEST_CASE("down a turned valley with ripples evolution comes farther than SBPLX from random starts") {
  const TurnedValley problem;
  constexpr std::int64_t kEvaluations = 4000;
  const DesignSpace space(problem, 0);
  std::vector<double> evolved, local;
  for (std::uint64_t seed = 1; seed <= 7; ++seed) {
    RunState state(problem);
    evolve(problem, state, kEvaluations, seed);
    evolved.push_back(best_gain(state, 0) == -1e300 ? 1e300 : state.front().members().front().losses[0]);
    double least = 1e300;
    std::int64_t spent = 0;
    for (std::uint64_t restart = 0; spent < kEvaluations; ++restart) {
      const NloptRun run{NloptMethod::Sbplx, space.spread_point(restart, seed), 0.1, kEvaluations - spent, seed};
      minimise(run, [&](const std::vector<double>& unit) {
        ++spent;
        const double loss = problem.score(space.at(unit)).objectives[0];
        least = std::min(least, loss);
        return loss;
      });
    }
    local.push_back(least);
  }
  CAPTURE(evolved, local);
  CHECK(median(evolved) < 0.01 * median(local));
}
