#include "optimize/stage_task.hpp"

#include <catch2/catch.hpp>

#include "toy_stages.hpp"

using namespace formotion;

namespace {

const std::atomic<bool> kGoOn{false};

ToyStages toy() { return {{{5, 10, 0.5}, {9, 3, 0.3}, {14, 12, 0.2}}, {{0, 1}, {2}, {3}}}; }

SearchTask task(Driver driver, StageAim aim, std::int64_t evaluations) {
  SearchTask result;
  result.driver = driver;
  result.stage = std::move(aim);
  result.evaluations = evaluations;
  result.seed = 3;
  return result;
}

double best_tolerance(const std::vector<StageTrial>& trials) {
  double best = 0;
  for (const StageTrial& trial : trials) best = std::max(best, trial.tolerance_mm);
  return best;
}

}  // namespace

TEST_CASE("every driver finds the window of a bar: a quarter of the distance of the heights") {
  const ToyStages problem = toy();
  for (const Driver driver : {Driver::Spread, Driver::DirectL, Driver::Crs2, Driver::Sbplx}) {
    const auto trials = run_task(problem, task(driver, {0, {0}, {1, 2}, 0}, 300), kGoOn).stages;
    CAPTURE(name(driver));
    CHECK(trials.size() <= 300);
    const double precision = driver == Driver::Spread ? 0.05 : driver == Driver::Sbplx ? 1e-6 : 1e-3;
    CHECK(best_tolerance(trials) == Approx(1).margin(precision));
    CHECK(best_tolerance(trials) <= 1);
  }
}

TEST_CASE("a stage of two variables is found from far away, its demand measured and nothing else") {
  const ToyStages problem = toy();
  SearchTask band = task(Driver::Sbplx, {2, {0, 2}, {1}, 0}, 600);
  band.start = Candidate{0, {16, 1}};  // loses nothing
  const auto trials = run_task(problem, band, kGoOn).stages;
  // From 7 to 11.5: nominal margins of 2 and 2.5 mm.
  CHECK(best_tolerance(trials) == Approx(1).margin(1e-6));
  for (const StageTrial& trial : trials) {
    if (trial.demanded.empty()) continue;
    REQUIRE(trial.demanded == StageDemand{true, true, true});
    REQUIRE_FALSE(wrong(trial.result, *band.stage, true, nullptr));
  }
}

TEST_CASE("length has its price") {
  const ToyStages problem = toy();
  const auto length_of_best = [&](double weight) {
    const auto trials = run_task(problem, task(Driver::DirectL, {1, {0, 2}, {1}, weight}, 300), kGoOn).stages;
    const auto merit = [&](const StageTrial& t) {
      return t.demanded.empty() ? 1e9 : weight * t.result.length_mm - t.tolerance_mm;
    };
    return std::min_element(trials.begin(), trials.end(),
                            [&](const StageTrial& a, const StageTrial& b) { return merit(a) < merit(b); })
        ->result.length_mm;
  };
  // Half of what the hole is longer than 3 mm, up to the middle of 3 and 10 mm.
  CHECK(length_of_best(0) == Approx(6.5).margin(1e-3));
  CHECK(length_of_best(0.4) == Approx(6.5).margin(1e-3));
  CHECK(length_of_best(0.6) == Approx(3).margin(1e-3));
}

TEST_CASE("what is wrong ranks: every state right, then the sum of what is missing, then invalid stages") {
  const StageAim aim{0, {0}, {1}, 0};
  const auto result = [](StageEnd a, StageEnd b) { return StageResult{true, 0, {a, b}, 1, 1}; };
  const auto good = result({0, 1, 0}, {kLostState, 1, 0});
  CHECK_FALSE(wrong(good, aim, true, nullptr));
  CHECK(*wrong(result({kLostState, 0.4, 0}, {kLostState, 1, 0}), aim, true, nullptr) == Approx(0.4));
  CHECK(*wrong(result({kLostState, 0.4, 0}, {1, 0.7, 0}), aim, true, nullptr) == Approx(1.1));
  CHECK(*wrong(result({0, 1, 0}, {kStuckState, 0, 2.5}), aim, true, nullptr) == Approx(2.5));
  CHECK(*wrong(result({0, 1, 0}, {1, 0, 0}), aim, true, nullptr) > 0);
  StageResult invalid = good;
  invalid.valid = false;
  invalid.violation = 0.1;
  CHECK(*wrong(invalid, aim, true, nullptr) > *wrong(result({kLostState, 90, 0}, {1, 90, 0}), aim, true, nullptr));
}

TEST_CASE("a stage that turns states is to go on as it began") {
  const ToyStages problem = toy();
  SearchTask turn = task(Driver::Sbplx, {3, {0, 1}, {}, 0}, 200);
  for (const double start : {0.4, 0.7}) {
    turn.start = Candidate{0, {start}};
    const auto trials = run_task(problem, turn, kGoOn).stages;
    CHECK(best_tolerance(trials) == Approx(0.25).margin(1e-6));
    for (const StageTrial& trial : trials) {
      if (!trial.demanded.empty()) REQUIRE((trial.values[0] < 0.5) == (start < 0.5));
    }
  }
}

TEST_CASE("without an aim stages are only looked at") {
  const ToyStages problem = toy();
  const auto trials = run_task(problem, task(Driver::Spread, {2, {}, {}, 0}, 50), kGoOn).stages;
  REQUIRE(trials.size() == 50);
  for (const StageTrial& trial : trials) {
    REQUIRE(trial.demanded.empty());
    REQUIRE(trial.work == 3);
  }
}

TEST_CASE("a stage task is a pure function and stops when told to") {
  const ToyStages problem = toy();
  for (const Driver driver : {Driver::DirectL, Driver::Crs2, Driver::Sbplx}) {
    const SearchTask same = task(driver, {2, {0, 2}, {1}, 0}, 200);
    const auto a = run_task(problem, same, kGoOn).stages, b = run_task(problem, same, kGoOn).stages;
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      REQUIRE(a[i].values == b[i].values);
      REQUIRE(a[i].tolerance_mm == b[i].tolerance_mm);
      for (std::size_t j = 0; j < i; ++j) REQUIRE(a[i].values != a[j].values);
    }
    const std::atomic<bool> stop{true};
    CHECK_THROWS_AS(run_task(problem, same, stop), SearchStopped);
  }
}
