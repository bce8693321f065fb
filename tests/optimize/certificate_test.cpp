#include "optimize/certificate.hpp"

#include <catch2/catch.hpp>

#include "local_search.hpp"
#include "optimize/closing.hpp"
#include "optimize/random_stream.hpp"
#include "toy_stages.hpp"

using namespace formotion;

namespace {

const std::atomic<bool> kGoOn{false};

std::vector<int> all_of(const ToyStages& problem) {
  std::vector<int> topologies;
  for (int t = 0; t < static_cast<int>(problem.topologies().size()); ++t) topologies.push_back(t);
  return topologies;
}

// The best tolerance of one stage on a fine grid of its values, for every state to keep and set to lose, and of all
// topologies by trying all ways to share the losses.
double best_on_grid(const ToyStages& problem, double step) {
  const auto states = static_cast<int>(problem.states().size());
  const StateSet sets = StateSet{1} << states;
  std::vector<std::vector<std::vector<double>>> best;  // kind, kept, lost: half the widest least margin
  for (int k = 0; k < static_cast<int>(problem.kinds().size()); ++k) {
    best.emplace_back(static_cast<std::size_t>(states), std::vector<double>(sets, -1));
    const bool two = problem.kinds()[static_cast<std::size_t>(k)].variables.size() == 2;
    for (double a = 0; a <= 20 + 1e-9; a += step) {
      for (double b = 0; b <= (two ? 20 + 1e-9 : 0); b += step) {
        const StageResult result = problem.pass(k, two ? std::vector<double>{a, b} : std::vector<double>{a});
        for (int kept = 0; kept < states; ++kept) {
          if (result.ends[static_cast<std::size_t>(kept)].to != kept) continue;
          for (StateSet lost = 0; lost < sets; ++lost) {
            double least = result.ends[static_cast<std::size_t>(kept)].nominal_mm;
            for (const int s : members(lost)) {
              const StageEnd& end = result.ends[static_cast<std::size_t>(s)];
              least = end.to == kLostState ? std::min(least, end.nominal_mm) : -1;
              if (least < 0) break;
            }
            double& known = best[static_cast<std::size_t>(k)][static_cast<std::size_t>(kept)][lost];
            known = std::max(known, 0.5 * least);
          }
        }
      }
    }
  }
  double most = 0;
  for (int t = 0; t < static_cast<int>(problem.topologies().size()); ++t) {
    for (int kept = 0; kept < states; ++kept) {
      std::vector<double> now(sets, -1);  // by what is lost so far
      now[0] = 1e9;
      for (const StageUse& use : problem.stages(t)) {
        std::vector<double> next(sets, -1);
        for (StateSet before = 0; before < sets; ++before) {
          for (StateSet lost = 0; lost < sets; ++lost) {
            const double here = best[static_cast<std::size_t>(use.kind)][static_cast<std::size_t>(kept)][lost];
            next[before | lost] = std::max(next[before | lost], std::min(now[before], here));
          }
        }
        now = next;
      }
      most = std::max(most, now[(sets - 1) & ~only(kept)]);
    }
  }
  return most;
}

}  // namespace

TEST_CASE("a window of one stage: the tolerance is a quarter of the heights' distance, and that is proved to 2e-5") {
  const ToyStages problem({{5, 10, 0.5}, {9, 10, 0.3}, {14.5, 10, 0.2}}, {{0}});
  ProofWork little{0, 10000}, work{0, 100000};
  CHECK_FALSE(is_excluded(problem, {0}, 1 - 1e-6, little, kGoOn));  // thing 0 alone, by a bar of 7
  CHECK(is_excluded(problem, {0}, 1 + 2e-5, work, kGoOn));
  const auto bound = least_excluded(problem, {0}, 1, work, kGoOn);
  REQUIRE(bound);
  CHECK(*bound > 1);
  CHECK(*bound < 1 + 5e-5);
}

TEST_CASE("what is proved holds on a grid, and comes near to the best of it") {
  for (std::uint64_t round = 0; round < 12; ++round) {
    RandomStream random(11, 1, round);
    std::vector<ToyStages::Thing> things;
    for (int i = 0; i < 3; ++i) things.push_back({20 * random.uniform(), 20 * random.uniform(), 0.3});
    const ToyStages problem(things, {{0, 1}, {2}, {1, 2}});
    const double best = best_on_grid(problem, 0.1);  // at most 0.1 below the true one
    ProofWork little{0, 20000}, work{0, 2000000};
    CAPTURE(round, best);
    if (best > 0) CHECK_FALSE(is_excluded(problem, all_of(problem), best, little, kGoOn));
    CHECK(is_excluded(problem, all_of(problem), std::max(best, 0.0) + 0.12, work, kGoOn));
  }
}

TEST_CASE("without the work for it nothing is proved") {
  const ToyStages problem({{5, 10, 0.5}, {9, 10, 0.3}}, {{0, 2}});
  ProofWork work{0, 10};
  CHECK_FALSE(is_excluded(problem, {0}, 1.001, work, kGoOn));
  CHECK(work.done < 100);
  const std::atomic<bool> stop{true};
  ProofWork more{0, 100000};
  CHECK_THROWS_AS(is_excluded(problem, {0}, 1.001, more, stop), SearchStopped);
}

TEST_CASE("a proof names what hinders it, and speaks of the topologies that are free of it") {
  const ToyStages problem({{5, 10, 0.5}, {9, 3, 0.3}}, {{0, 1}, {0, 3}});
  const ProofScope scope = proof_scope(problem, 2);
  CHECK(scope.topologies == std::vector<int>{0});
  CHECK(scope.hindrances == std::vector<std::string>{"turner turns parts"});
}

TEST_CASE("at the end of a search the best found and the proved bound stand side by side") {
  const ToyStages problem({{5, 10, 0.5}, {9, 10, 0.3}, {14.5, 10, 0.2}}, {{0}, {1}});
  RunState state(problem);
  SearchOptions options;
  options.budget = {300, 1};
  search_here(problem, state, nullptr, options);
  std::vector<std::string> told;
  for (const Finding& finding : state.findings())
    told.push_back(finding.topic + ", " + finding.subject + ": " + finding.text);
  REQUIRE(told.size() == 3);
  // 1e-6 mm below the best is rounded down, the bound is rounded up.
  CHECK_THAT(told[0], Catch::StartsWith("ranked, bar: number 1 of 1 that tracks were composed for, by tolerance: "));
  CHECK(told[1] == "ranked, hole: not reached: no stage that was tried loses thing 1 and keeps thing 0");
  CHECK_THAT(told[2], Catch::StartsWith("proved, bar, hole: no design within these bounds has a tolerance of 1.0000"));
  CHECK_THAT(told[2], Catch::Contains("or more; the best found has 0.99999") || Catch::EndsWith(" has 1.000000 mm"));
}
