#include <catch2/catch.hpp>

#include "local_search.hpp"
#include "optimize/random_stream.hpp"
#include "toy_stages.hpp"

using namespace formotion;

namespace {

// The best track keeps thing 0: a band from below 4 up to 11.5 loses all others, 3.5 from everything, which bears an
// error of 1.75. No topology has a band alone, so the others have to let thing 0 pass.
ToyStages toy() {
  return {{{15, 12, 0.4}, {7, 4, 0.3}, {8, 10, 0.2}, {4, 11, 0.1}}, {{0}, {0, 1}, {0, 1, 2}, {2, 2, 1}, {1, 1}}};
}

RunState searched(const ToyStages& problem, std::int64_t evaluations, std::uint64_t seed, int threads = 1) {
  RunState state(problem);
  SearchOptions options;
  options.budget = {evaluations, seed};
  search_here(problem, state, nullptr, options, threads);
  return state;
}

double best_gain(const RunState& state) {
  double best = 0;
  for (const Evaluated& e : state.evaluations()) {
    if (e.score.feasible) best = std::max(best, e.score.objectives[0]);
  }
  return best;
}

}  // namespace

TEST_CASE("composed search finds the track of three stages that keeps one thing of four") {
  const ToyStages problem = toy();
  for (const std::uint64_t seed : {1, 2, 3}) {
    const RunState state = searched(problem, 6000, seed);
    CHECK(best_gain(state) == Approx(1.75).margin(1e-6));
    CHECK(state.spent() == 6000);
  }
}

TEST_CASE("composed search: the same bits on one and on four threads") {
  const ToyStages problem = toy();
  const RunState a = searched(problem, 900, 5, 1), b = searched(problem, 900, 5, 4);
  REQUIRE(a.evaluations().size() == b.evaluations().size());
  REQUIRE(a.stages().size() == b.stages().size());
  for (std::size_t i = 0; i < a.evaluations().size(); ++i)
    REQUIRE(a.evaluations()[i].candidate.values == b.evaluations()[i].candidate.values);
  for (std::size_t i = 0; i < a.stages().size(); ++i) REQUIRE(a.stages()[i].trial.values == b.stages()[i].trial.values);
}
