// The derivatives of an assembly's residuals, and what the least-squares driver comes to with them.
#include <catch2/catch.hpp>
#include <cmath>

#include "applications/assembly/assembly_problem.hpp"
#include "applications/assembly/judge.hpp"
#include "applications/assembly/residuals.hpp"
#include "io/problem_file.hpp"
#include "optimize/design_space.hpp"
#include "optimize/search_task.hpp"

using namespace formotion;
using namespace formotion::assembly;

namespace {

const std::atomic<bool> kGoOn{false};

AssemblySpec shipped(const std::string& name) {
  return *read_problem_file(FORMOTION_SOURCE_DIR "/problems/assembly/" + name + ".json").assembly;
}

std::size_t place_of(const Problem& problem, const std::string& objective) {
  std::size_t place = 0;
  while (problem.objectives()[place].name != objective) ++place;
  return place;
}

// Aims at a tenth less than the candidate has.
std::unique_ptr<SmoothPieces> pieces_at(const Problem& problem, std::size_t objective, const Candidate& candidate) {
  return problem.smooth()->pieces(candidate, {objective, 0.9 * problem.score(candidate).objectives[objective], {}});
}

SearchTask task_from(const Problem& problem, std::size_t objective, const Candidate& start, Driver driver,
                     std::int64_t evaluations) {
  SearchTask task;
  task.driver = driver;
  task.evaluations = evaluations;
  task.start = start;
  const std::size_t count = problem.objectives().size();
  task.merit = {objective, std::vector<std::optional<double>>(count), std::vector<double>(count, 1)};
  return task;
}

// How many evaluations it takes to a feasible value; none if it does not come to it.
std::optional<std::size_t> evaluations_to(const std::vector<Trial>& trials, std::size_t objective, double value) {
  for (std::size_t i = 0; i < trials.size(); ++i) {
    if (trials[i].score.feasible && trials[i].score.objectives[objective] <= value) return i + 1;
  }
  return std::nullopt;
}

double least_of(const std::vector<Trial>& trials, std::size_t objective) {
  double least = 1e300;
  for (const Trial& trial : trials) {
    if (trial.score.feasible) least = std::min(least, trial.score.objectives[objective]);
  }
  return least;
}

}  // namespace

TEST_CASE("slopes of work and peaks are those of differences of other steps") {
  struct Case {
    const char* name;
    const char* objective;
    std::vector<double> values;
  };
  const Case cases[] = {
      {"straight_chamfer_least_work", "work_nmm", {4.1}},   {"straight_chamfer_least_work", "work_nmm", {1.9}},
      {"peg_and_chamfer", "work_nmm", {2.3, 1.7}},          {"peg_and_chamfer", "work_nmm", {3.2, 5.99}},
      {"bracket_in_slot", "peak_force_n", {0.9, 1.5, 3.9}}, {"bracket_in_slot", "peak_force_n", {2.0, 2.5, 1.1}}};
  for (const Case& c : cases) {
    CAPTURE(c.name, c.values);
    const AssemblyProblem problem(shipped(c.name));
    const std::size_t objective = place_of(problem, c.objective), n = c.values.size();
    const auto pieces = pieces_at(problem, objective, {0, c.values});
    REQUIRE(pieces);
    const auto m = static_cast<std::size_t>(pieces->residuals());
    std::vector<double> at(m), jacobian(m * n), low(m), high(m);
    REQUIRE(pieces->evaluate(c.values, at.data(), jacobian.data()));
    CHECK(at[0] == Approx(0.1 * problem.score({0, c.values}).objectives[objective]).epsilon(1e-9));
    double largest = 0;
    for (std::size_t i = 0; i < n; ++i) {
      constexpr double kStep = 3e-5;
      std::vector<double> moved = c.values;
      moved[i] += kStep;
      REQUIRE(pieces->evaluate(moved, high.data(), nullptr));
      moved[i] -= 2 * kStep;
      REQUIRE(pieces->evaluate(moved, low.data(), nullptr));
      for (std::size_t k = 0; k < m; ++k) {
        if (!(at[k] > 0 && low[k] > 0 && high[k] > 0)) continue;
        const double slope = (high[k] - low[k]) / (2 * kStep);
        CHECK(jacobian[k * n + i] == Approx(slope).epsilon(2e-4).margin(2e-4));
        largest = std::max(largest, std::abs(slope));
      }
    }
    CHECK(largest > 0.1);  // there was something to compare
  }
}

TEST_CASE("the work down a straight chamfer has the slope of its closed form") {
  // A face at an angle a from the approach, tan a = t = width / depth, takes the axial force k u tan(a + phi) where it
  // has pushed the part by u aside: the work to U is k U^2 / 2 tan(a + phi) / tan a. What follows in the hole does not
  // depend on the depth. The problem's other springs are stiff, not rigid: they change steep slopes by under 1 %.
  const AssemblyProblem problem(shipped("straight_chamfer_least_work"));
  const double width = 2.2, friction = 0.2, k = 5, aside = 1.9;
  for (const double depth : {1.2, 2.0, 2.6, 2.8, 4.0, 6.8}) {
    const auto pieces = pieces_at(problem, 0, {0, {depth}});
    REQUIRE(pieces);
    double slope = 0, residual = 0;
    REQUIRE(pieces->evaluate(std::vector<double>{depth}, &residual, &slope));
    const double t = width / depth, below = t - friction * t * t;
    const double by_t = (below - (t + friction) * (1 - 2 * friction * t)) / (below * below);
    CAPTURE(depth);
    CHECK(slope == Approx(k * aside * aside / 2 * by_t * -width / (depth * depth)).epsilon(1e-2).margin(2e-3));
  }
}

TEST_CASE("least squares come to the straight chamfer of least work within a few evaluations of any start") {
  const AssemblyProblem problem(shipped("straight_chamfer_least_work"));
  const DesignSpace space(problem, 0);
  const double best = 2.2 / (std::sqrt(1.04) - 0.2);
  std::size_t fits = 0, simplices = 0;
  for (std::uint64_t p = 0; p < 5; ++p) {
    const Candidate start = space.at(space.spread_point(p, 7));
    CAPTURE(start.values);
    const double close = problem.score({0, {best}}).objectives[0] + 1e-3;
    const auto fitted = run_task(problem, task_from(problem, 0, start, Driver::LeastSquares, 40), kGoOn).trials;
    const auto at = evaluations_to(fitted, 0, close);
    REQUIRE(at);
    CHECK(*at <= 6);
    CHECK(fitted.size() <= 12);
    fits += *at;
    const auto by_simplex = run_task(problem, task_from(problem, 0, start, Driver::Sbplx, 40), kGoOn).trials;
    simplices += evaluations_to(by_simplex, 0, close).value_or(40);
  }
  CHECK(2 * fits < simplices);
}

TEST_CASE("least squares make the worst of many starts less while chamfers keep their limit") {
  const AssemblyProblem problem(shipped("peg_and_chamfer"));
  const std::size_t work = place_of(problem, "work_nmm"), chamfer = place_of(problem, "chamfer_mm");
  const Candidate start{0, {2.2, 1.8}};
  const double at_start = problem.score(start).objectives[work];
  SearchTask task = task_from(problem, work, start, Driver::LeastSquares, 8);
  task.merit.at_most[chamfer] = 2.2;
  const auto trials = run_task(problem, task, kGoOn).trials;
  double least = at_start;
  for (const Trial& trial : trials) {
    if (trial.score.feasible && trial.score.objectives[chamfer] <= 2.2)
      least = std::min(least, trial.score.objectives[work]);
  }
  CHECK(least < 0.85 * at_start);
  // A width that may be larger gains more: the limit was what held it.
  CHECK(least >=
        least_of(run_task(problem, task_from(problem, work, start, Driver::LeastSquares, 8), kGoOn).trials, work) -
            1e-3);
}

TEST_CASE("corners in one line have slopes to the sides on which work goes on straight") {
  // As written all faces of the curve are one: whichever corner moves, other faces are touched.
  const AssemblyProblem problem(shipped("curved_chamfer"));
  const Candidate start{0, {0.2, 0.4, 0.6, 0.8, 1}};
  const auto pieces = pieces_at(problem, 0, start);
  REQUIRE(pieces);
  REQUIRE(pieces->residuals() == 1);
  double residual = 0;
  std::vector<double> slopes(5);
  REQUIRE(pieces->evaluate(start.values, &residual, slopes.data()));
  for (std::size_t i = 0; i < 5; ++i) {
    std::vector<double> moved = start.values;
    moved[i] -= 1e-4;
    const double less = problem.score({0, moved}).objectives[0];
    CAPTURE(i);
    CHECK(slopes[i] == Approx((problem.score(start).objectives[0] - less) / 1e-4).epsilon(0.05));
  }
}

TEST_CASE("there are no pieces where nothing is missing or no start assembles or no force is asked about") {
  const AssemblyProblem straight(shipped("straight_chamfer_least_work"));
  CHECK_FALSE(straight.smooth()->pieces({0, {3.0}}, {0, 100.0, {}}));
  CHECK(straight.smooth()->pieces({0, {3.0}}, {0, 1.0, {}}));
  CHECK_FALSE(straight.smooth()->pieces({0, {3.0}}, {}));
  AssemblySpec far = shipped("straight_chamfer_least_work");
  far.goal.depth_mm = 1000;
  CHECK_FALSE(AssemblyProblem(far).smooth()->pieces({0, {3.0}}, {0, 1.0, {}}));
  CHECK(AssemblyProblem(shipped("keyed_connector")).smooth() == nullptr);
  CHECK(AssemblyProblem(shipped("damped_peg")).smooth() == nullptr);
}

TEST_CASE("a bound on a force that is not kept is met by least squares") {
  AssemblySpec spec = shipped("straight_chamfer_least_work");
  const AssemblyProblem free(spec);
  const Candidate start{0, {1.5}};
  const AssemblyEvaluation before = free.evaluate(0, start.values);
  const double peak = before.metrics.peak_force_n;
  spec.bounds.push_back({"peak_force_n", std::nullopt, 0.8 * peak});
  const AssemblyProblem bounded(spec);
  REQUIRE_FALSE(bounded.score(start).feasible);
  const auto trials = run_task(bounded, task_from(bounded, 0, start, Driver::LeastSquares, 6), kGoOn).trials;
  CHECK(evaluations_to(trials, 0, 1e9).value_or(99) <= 4);
}

TEST_CASE("starts that carry under uncertain values are looked at with those values") {
  AssemblySpec spec = shipped("straight_chamfer_least_work");
  spec.uncertainty.intervals["friction"] = {0.1, 0.3};
  spec.robust = true;
  const AssemblyProblem problem(spec);
  const Candidate start{0, {3.5}};
  const double worst = problem.score(start).objectives[0];
  CHECK(worst > 1.05 * AssemblyProblem(shipped("straight_chamfer_least_work")).score(start).objectives[0]);
  const auto pieces = problem.smooth()->pieces(start, {0, worst - 1, {}});
  REQUIRE(pieces);
  std::vector<double> residuals(static_cast<std::size_t>(pieces->residuals())), slopes(residuals.size());
  REQUIRE(pieces->evaluate(start.values, residuals.data(), slopes.data()));
  CHECK(residuals[0] == Approx(1).epsilon(1e-6));
  // Least at 45 degrees less half the angle of the worst friction.
  const auto trials = run_task(problem, task_from(problem, 0, start, Driver::LeastSquares, 8), kGoOn).trials;
  const double best = 2.2 / (std::sqrt(1.09) - 0.3);
  CHECK(least_of(trials, 0) <= problem.score({0, {best}}).objectives[0] + 1e-3);
}
