#include "optimize/search.hpp"

#include <catch2/catch.hpp>

#include "local_search.hpp"
#include "toy_problem.hpp"

using namespace formotion;

namespace {

SearchOptions options(std::int64_t evaluations, std::uint64_t seed) {
  SearchOptions result;
  result.budget = {evaluations, seed};
  return result;
}

RunState searched(std::int64_t evaluations, std::uint64_t seed, int threads) {
  const ToyProblem problem;
  RunState state(problem);
  search_here(problem, state, nullptr, options(evaluations, seed), threads);
  return state;
}

void check_same(const RunState& a, const RunState& b) {
  REQUIRE(a.evaluations().size() == b.evaluations().size());
  for (std::size_t i = 0; i < a.evaluations().size(); ++i) {
    REQUIRE(a.evaluations()[i].candidate.topology == b.evaluations()[i].candidate.topology);
    REQUIRE(a.evaluations()[i].candidate.values == b.evaluations()[i].candidate.values);
    REQUIRE(a.evaluations()[i].provenance == b.evaluations()[i].provenance);
  }
  REQUIRE(a.front().members().size() == b.front().members().size());
  for (std::size_t i = 0; i < a.front().members().size(); ++i) {
    REQUIRE(a.front().members()[i].number == b.front().members()[i].number);
    REQUIRE(a.front().members()[i].losses == b.front().members()[i].losses);
  }
}

}  // namespace

TEST_CASE("the search meets known optima: both topologies' best gains and the least cost, to 1e-6") {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const RunState state = searched(4000, seed, 1);
    double line = 0, plane = 0, cost = 100;
    for (const Evaluated& e : state.evaluations()) {
      if (!e.score.feasible) continue;
      (e.candidate.topology == 0 ? line : plane) =
          std::max(e.candidate.topology == 0 ? line : plane, e.score.objectives[0]);
      cost = std::min(cost, e.score.objectives[1]);
    }
    CHECK(line == Approx(3).margin(1e-6));
    CHECK(plane == Approx(4).margin(1e-6));
    CHECK(cost == Approx(4).margin(1e-5));  // the end of the feasible range is open
  }
}

TEST_CASE("the budget is met exactly and no candidate is scored twice") {
  const ToyProblem problem;
  for (const std::int64_t budget : {1, 7, 100, 1000, 3333}) {
    RunState state(problem);
    CHECK(search_here(problem, state, nullptr, options(budget, 5), 1) == SearchEnd::BudgetSpent);
    CHECK(static_cast<std::int64_t>(state.evaluations().size()) == budget);
    for (const Evaluated& e : state.evaluations()) REQUIRE(state.find(e.candidate) == &e.score);
    CHECK(state.history().back().evaluations == budget);
  }
}

TEST_CASE("one, two and eight threads: the same candidates in the same order, the same front") {
  const RunState one = searched(3000, 9, 1);
  check_same(one, searched(3000, 9, 2));
  check_same(one, searched(3000, 9, 8));
}

TEST_CASE("different seeds search differently") {
  const RunState a = searched(500, 1, 1), b = searched(500, 2, 1);
  int same = 0;
  for (const Evaluated& e : a.evaluations()) same += b.find(e.candidate) != nullptr;
  CHECK(same < 300);
}

TEST_CASE("a search that is stopped after any batch and goes on is the search that was never stopped") {
  const ToyProblem problem;
  const RunState whole = searched(3000, 4, 2);
  for (std::int64_t stop_after = 1; stop_after < whole.batches(); stop_after += 2) {
    RunState state(problem);
    std::atomic<bool> stop{false};
    SearchOptions how = options(3000, 4);
    how.stop = &stop;
    how.after_batch = [&](const RunState& now) { stop = now.batches() == stop_after; };
    REQUIRE(search_here(problem, state, nullptr, how, 2) == SearchEnd::Stopped);
    REQUIRE(state.batches() == stop_after);
    stop = false;
    REQUIRE(search_here(problem, state, nullptr, options(3000, 4), 1) == SearchEnd::BudgetSpent);
    check_same(state, whole);
  }
}

TEST_CASE("a search without variables ends when nothing new can be tried") {
  class Still final : public Problem {
   public:
    std::span<const Variable> variables() const override { return {}; }
    std::span<const Topology> topologies() const override { return topologies_; }
    std::span<const Objective> objectives() const override { return objectives_; }
    Score score(const Candidate& c, Memory*) const override {
      return {c.topology == 1, c.topology == 1 ? 0.0 : 1.0, {2}, {}, std::nullopt, 1};
    }

   private:
    std::vector<Topology> topologies_{{"a", {}}, {"b", {}}};
    std::vector<Objective> objectives_{{"o", true, 0, false}};
  } problem;
  RunState state(problem);
  CHECK(search_here(problem, state, nullptr, options(1000, 1), 2) == SearchEnd::NothingNew);
  CHECK(state.evaluations().size() == 2);
  CHECK(state.best_designs().size() == 1);
}

TEST_CASE("a candidate whose scoring throws is a failure of its own, and the search goes on") {
  class Broken final : public Problem {
   public:
    std::span<const Variable> variables() const override { return inner_.variables(); }
    std::span<const Topology> topologies() const override { return inner_.topologies(); }
    std::span<const Objective> objectives() const override { return inner_.objectives(); }
    Score score(const Candidate& c, Memory*) const override {
      if (c.values[0] < 1) throw std::logic_error("broken");
      return inner_.score(c);
    }

   private:
    ToyProblem inner_;
  } problem;
  RunState state(problem);
  CHECK(search_here(problem, state, nullptr, options(3000, 1), 2) == SearchEnd::BudgetSpent);
  int failed = 0;
  for (const Evaluated& e : state.evaluations()) {
    const bool broken = e.candidate.values[0] < 1;
    REQUIRE((e.score.failure == Failure::Error) == broken);
    REQUIRE((!broken || (e.score.failure_text == "broken" && !e.score.feasible)));
    failed += broken;
  }
  CHECK(failed > 0);
}

TEST_CASE("while nothing is feasible the nearest designs stand in for the front") {
  class Hopeless final : public Problem {
   public:
    std::span<const Variable> variables() const override { return inner_.variables(); }
    std::span<const Topology> topologies() const override { return inner_.topologies(); }
    std::span<const Objective> objectives() const override { return inner_.objectives(); }
    Score score(const Candidate& c, Memory*) const override {
      Score score = inner_.score(c);
      score.feasible = false;
      score.violation = 1 + std::abs(c.values[0] - 3);
      return score;
    }

   private:
    ToyProblem inner_;
  } problem;
  RunState state(problem);
  search_here(problem, state, nullptr, options(2000, 1), 2);
  CHECK(state.front().members().empty());
  REQUIRE_FALSE(state.best_designs().empty());
  double least = 100;
  for (const Evaluated& e : state.best_designs()) least = std::min(least, e.score.violation);
  CHECK(least == Approx(1).margin(1e-6));
}
