#include "optimize/search_task.hpp"

#include <catch2/catch.hpp>

#include "toy_problem.hpp"

using namespace formotion;

namespace {

SearchTask task(Driver driver, std::int64_t evaluations) {
  SearchTask result;
  result.driver = driver;
  result.topology = 1;
  result.evaluations = evaluations;
  result.seed = 11;
  result.merit = {0, {std::nullopt, std::nullopt}, {1, 1}};
  return result;
}

const std::atomic<bool> kGoOn{false};

}  // namespace

TEST_CASE("no driver evaluates more than its task allows, and each comes near the best gain") {
  const ToyProblem problem;
  for (const Driver driver : {Driver::Spread, Driver::DirectL, Driver::Crs2, Driver::Sbplx}) {
    for (const std::int64_t budget : {1, 20, 600}) {
      const std::vector<Trial> trials = run_task(problem, task(driver, budget), kGoOn).trials;
      CAPTURE(name(driver), budget);
      CHECK(static_cast<std::int64_t>(trials.size()) <= budget);
      double best = 0;
      for (const Trial& trial : trials) best = std::max(best, trial.score.objectives[0]);
      if (budget == 600) CHECK(best > (driver == Driver::Spread ? 3.8 : 3.99));
    }
  }
}

TEST_CASE("a task is a pure function: twice the same trials") {
  const ToyProblem problem;
  for (const Driver driver : {Driver::Spread, Driver::DirectL, Driver::Crs2, Driver::Sbplx}) {
    const auto a = run_task(problem, task(driver, 300), kGoOn).trials,
               b = run_task(problem, task(driver, 300), kGoOn).trials;
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) REQUIRE(a[i].candidate.values == b[i].candidate.values);
  }
}

TEST_CASE("a bound on an objective is kept where it can be") {
  const ToyProblem problem;
  SearchTask bounded = task(Driver::Sbplx, 500);
  bounded.start = Candidate{1, {2, -0.2}};
  bounded.merit.at_most[1] = 20.1;  // the cost: y at most 0.1, where the gain is 3.6 at best
  double best = 0;
  for (const Trial& trial : run_task(problem, bounded, kGoOn).trials) {
    if (trial.score.objectives[1] <= 20.1) best = std::max(best, trial.score.objectives[0]);
  }
  CHECK(best == Approx(3.6).margin(1e-5));
}

TEST_CASE("merits rank: bounds kept and feasible, bounds broken, infeasible, nearer ones first") {
  const std::vector<Objective> objectives{{"gain", true, 0, false}, {"cost", false, 0, false}};
  const Merit merit{0, {std::nullopt, 5.0}, {1, 1}};
  const auto score = [](bool feasible, double violation, double gain, double cost) {
    return Score{feasible, violation, {gain, cost}, {}, std::nullopt, 1};
  };
  const std::vector<Score> ascending{score(true, 0, 3, 5),   score(true, 0, 2, 1),    score(false, 0.1, 9, 1),
                                     score(true, 0, 9, 5.5), score(false, 1, 9, 5.5), score(false, 3, 9, 1)};
  for (std::size_t i = 0; i + 1 < ascending.size(); ++i)
    CHECK(merit(ascending[i], objectives) < merit(ascending[i + 1], objectives));
}

TEST_CASE("a task that is told to stop stops") {
  const ToyProblem problem;
  const std::atomic<bool> stop{true};
  for (const Driver driver : {Driver::Spread, Driver::DirectL, Driver::Crs2, Driver::Sbplx}) {
    CHECK_THROWS_AS(run_task(problem, task(driver, 100), stop), SearchStopped);
  }
}
