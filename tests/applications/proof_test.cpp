#include <catch2/catch.hpp>

#include "applications/feeder/feeder_problem.hpp"
#include "io/problem_file.hpp"
#include "optimize/certificate.hpp"
#include "optimize/search.hpp"

using namespace formotion;

namespace {

const std::atomic<bool> kGoOn{false};

double best_tolerance(const feeder::FeederProblem& problem, std::int64_t evaluations) {
  RunState state(problem);
  LocalEngine engine(problem, 1);
  SearchOptions options;
  options.budget = {evaluations, 1};
  search(problem, state, nullptr, engine, options);
  double best = 0;
  for (const Evaluated& e : state.evaluations()) {
    if (e.score.feasible) best = std::max(best, e.score.objectives[1]);
  }
  return best;
}

}  // namespace

TEST_CASE("windows of the feeder: the search meets the best tolerance to 1e-6, and the proof closes in to 1e-3") {
  const auto [name, best] = GENERATE(table<const char*, double>({{"balcony_window", 1.0}, {"gap_window", 2.0 / 3}}));
  CAPTURE(name);
  const feeder::FeederProblem problem(
      read_problem_file(FORMOTION_SOURCE_DIR "/problems/feeder/" + std::string(name) + ".json").feeder);
  const double found = best_tolerance(problem, 300);
  CHECK(found == Approx(best).margin(1e-6));
  CHECK(found <= best + 1e-7);
  const StagedProblem* staged = problem.staged();
  REQUIRE(staged);
  ProofWork work{0, 20000}, little{0, 2000};
  const auto bound = least_excluded(*staged, {0}, found, work, kGoOn);
  REQUIRE(bound);
  CHECK(*bound > best);
  CHECK(*bound < best + 1e-3);
  CHECK_FALSE(is_excluded(*staged, {0}, best - 1e-5, little, kGoOn));
}
