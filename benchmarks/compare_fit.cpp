// Least squares and SBPLX from the same starts on the first topology of a problem: evaluations until a design is
// feasible, until its tolerance is what it ends at, and until SBPLX reaches what least squares end at (0: never).
//
//   compare_fit PROBLEM.json STARTS EVALUATIONS [feasible]
//
// With `feasible` random starts are first brought to a feasible design (by SBPLX, at most 3,000 evaluations).
#include <algorithm>
#include <cstdlib>
#include <iomanip>
#include <iostream>

#include "applications/feeder/feeder_problem.hpp"
#include "io/problem_file.hpp"
#include "optimize/random_stream.hpp"
#include "optimize/search_task.hpp"

using namespace formotion;

namespace {

const std::atomic<bool> kGoOn{false};
constexpr std::int64_t kToFeasible = 3000;
constexpr std::uint64_t kStarts = 7;  // key of the random starts
constexpr double kSame_mm = 0.01;     // tolerances that differ by less do not matter

std::size_t place_of_tolerance(const Problem& problem) {
  const auto objectives = problem.objectives();
  const auto found =
      std::find_if(objectives.begin(), objectives.end(), [](const Objective& o) { return o.name == "tolerance_mm"; });
  if (found == objectives.end()) throw std::runtime_error("tolerance_mm is no objective of the problem");
  return static_cast<std::size_t>(found - objectives.begin());
}

SearchTask task_from(const Problem& problem, Driver driver, std::int64_t evaluations, const Candidate& start) {
  SearchTask task;
  task.driver = driver;
  task.evaluations = evaluations;
  task.seed = 1;
  task.start = start;
  const std::size_t count = problem.objectives().size();
  task.merit = {place_of_tolerance(problem), std::vector<std::optional<double>>(count), std::vector<double>(count, 1)};
  return task;
}

Candidate random_start(const Problem& problem, int number) {
  Candidate start{0, {}};
  RandomStream random(kStarts, 0, static_cast<std::uint64_t>(number));
  for (const int index : problem.topologies()[0].variables) {
    const Variable& v = problem.variables()[static_cast<std::size_t>(index)];
    start.values.push_back(number == 0 ? v.start() : v.min + (v.max - v.min) * random.uniform());
  }
  return start;
}

std::optional<Candidate> feasible_from(const Problem& problem, const Candidate& start) {
  for (const Trial& trial : run_task(problem, task_from(problem, Driver::Sbplx, kToFeasible, start), kGoOn).trials) {
    if (trial.score.feasible) return trial.candidate;
  }
  return std::nullopt;
}

// From 1; 0: never.
std::size_t first_with(const std::vector<Trial>& trials, std::size_t focus, double at_least) {
  for (std::size_t i = 0; i < trials.size(); ++i) {
    if (trials[i].score.feasible && trials[i].score.objectives[focus] >= at_least) return i + 1;
  }
  return 0;
}

// Returns the best tolerance. wanted: another one, that somebody else reached.
double report(const Problem& problem, const SearchTask& task, double wanted) {
  const std::vector<Trial> trials = run_task(problem, task, kGoOn).trials;
  const std::size_t focus = task.merit.focus;
  double best = 0;
  for (const Trial& trial : trials) {
    if (trial.score.feasible) best = std::max(best, trial.score.objectives[focus]);
  }
  std::cout << "  " << std::setw(14) << std::left << name(task.driver) << trials.size() << " evaluations, feasible at "
            << first_with(trials, focus, 0) << ", " << best << " mm at " << first_with(trials, focus, best - kSame_mm);
  if (wanted > 0) std::cout << ", " << wanted << " mm at " << first_with(trials, focus, wanted - kSame_mm);
  std::cout << "\n";
  return best;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::cerr << "usage: compare_fit PROBLEM.json STARTS EVALUATIONS [feasible]\n";
    return 2;
  }
  const feeder::FeederProblem problem(read_problem_file(argv[1]).feeder);
  for (int number = 0; number < std::atoi(argv[2]); ++number) {
    std::optional<Candidate> start = random_start(problem, number);
    if (argc > 4) start = feasible_from(problem, *start);
    std::cout << "start " << number << (start ? "" : ": none feasible") << "\n";
    double reached = 0;
    for (const Driver driver : {Driver::LeastSquares, Driver::Sbplx}) {
      if (start) reached = report(problem, task_from(problem, driver, std::atoll(argv[3]), *start), reached);
    }
  }
  return 0;
}
