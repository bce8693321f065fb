#include "yardstick_methods.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/nsga2.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>

#include "optimize/design_space.hpp"
#include "optimize/evolution.hpp"
#include "optimize/nlopt_run.hpp"
#include "optimize/random_stream.hpp"
#include "optimize/search.hpp"

namespace formotion::bench {
namespace {

// The work of a batch's single stages counts before that of its designs.
YardstickRun recorded(const Problem& problem, const RunState& state, std::int64_t most_work) {
  YardstickRun run;
  for (const RunProgress& batch : state.history()) {
    while (run.stages < batch.stages)
      record_stage(state.stages()[static_cast<std::size_t>(run.stages)].trial.work, run);
    while (run.evaluations < batch.evaluations)
      record(problem, state.evaluation(run.evaluations + 1).score, most_work, run);
  }
  return run;
}

YardstickRun engine(const Problem& problem, std::int64_t work, std::int64_t evaluations, std::uint64_t seed) {
  RunState state(problem);
  LocalEngine local(problem, 1);
  std::atomic<bool> stop{false};
  SearchOptions options;
  options.budget = {evaluations, seed};
  options.stop = &stop;
  options.after_batch = [&](const RunState& now) { stop = std::max(now.history().back().work, now.spent()) >= work; };
  search(problem, state, nullptr, local, options);
  return recorded(problem, state, work);
}

// Our generations alone.
YardstickRun evolution(const Problem& problem, std::int64_t work, std::int64_t evaluations, std::uint64_t seed) {
  constexpr std::uint64_t kPurpose = 0xe0;
  RunState state(problem);
  const std::atomic<bool> never{false};
  const std::int64_t generation = std::clamp<std::int64_t>(evaluations / 40, 20, 100);
  do {
    RandomStream random(seed, kPurpose, static_cast<std::uint64_t>(state.batches()));
    const std::vector<SearchTask> tasks = evolution_tasks(problem, state, generation, random);
    if (tasks.empty()) break;
    for (const SearchTask& task : tasks)
      state.fold(run_task(problem, task, never), task.provenance, std::numeric_limits<std::int64_t>::max());
    state.close_batch();
  } while (std::max(state.history().back().work, state.spent()) < work);
  return recorded(problem, state, work);
}

// Topologies alike, values uniform within their bounds.
YardstickRun random_designs(const Problem& problem, std::int64_t work, std::int64_t, std::uint64_t seed) {
  MeteredProblem metered(problem, work);
  RandomStream random(seed, 0x4a, 0);
  std::vector<DesignSpace> spaces;
  for (int t = 0; t < static_cast<int>(problem.topologies().size()); ++t) spaces.emplace_back(problem, t);
  try {
    for (;;) {
      const DesignSpace& space = random.pick(spaces);
      std::vector<double> unit(static_cast<std::size_t>(space.dimensions()));
      for (double& u : unit) u = random.uniform();
      metered(space.at(unit));
    }
  } catch (const WorkSpent&) {}
  return metered.run();
}

// All variables and one that picks the topology, in the unit cube. Its penalties rank infeasible designs behind all
// feasible ones, by violation.
struct MixedProblem {
  MeteredProblem* metered = nullptr;
  pagmo::vector_double fitness(const pagmo::vector_double& x) const {
    const Problem& problem = metered->problem();
    const auto count = static_cast<double>(problem.topologies().size());
    Candidate candidate{static_cast<int>(std::min(count - 1, std::floor(x[0] * count))), {}};
    for (const int index : problem.topologies()[static_cast<std::size_t>(candidate.topology)].variables) {
      const Variable& v = problem.variables()[static_cast<std::size_t>(index)];
      candidate.values.push_back(std::min(v.max, v.min + x[static_cast<std::size_t>(index) + 1] * (v.max - v.min)));
    }
    LossPoint losses = (*metered)(candidate);
    if (losses.size() == 1) losses.push_back(0);  // NSGA-II begins at two objectives
    return losses;
  }
  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    const std::size_t n = metered->problem().variables().size() + 1;
    return {pagmo::vector_double(n, 0.0), pagmo::vector_double(n, 1.0)};
  }
  pagmo::vector_double::size_type get_nobj() const {
    return std::max<std::size_t>(2, metered->problem().objectives().size());
  }
};

YardstickRun nsga2(const Problem& problem, std::int64_t work, std::int64_t evaluations, std::uint64_t seed) {
  MeteredProblem metered(problem, work);
  const auto size = static_cast<unsigned>(4 * std::clamp<std::int64_t>(evaluations / 160, 10, 25));
  const double rate = 1.0 / static_cast<double>(problem.variables().size() + 1);
  try {
    pagmo::population population{pagmo::problem{MixedProblem{&metered}}, size, static_cast<unsigned>(seed)};
    // Indices of crossover and mutation as usual: 15 and 20.
    pagmo::algorithm algorithm{pagmo::nsga2(1, 0.9, 15, rate, 20, static_cast<unsigned>(seed))};
    for (;;) population = algorithm.evolve(population);
  } catch (const WorkSpent&) {}
  return metered.run();
}

// A classical use of NLopt: topology after topology, a global search for a random weighting of the objectives (the
// achievement function of Wierzbicki 1980 between the best and the worst losses met so far), then a local one from the
// best point that it found.
YardstickRun nlopt(const Problem& problem, std::int64_t work, std::int64_t, std::uint64_t seed) {
  MeteredProblem metered(problem, work);
  RandomStream random(seed, 0x91, 0);
  std::vector<DesignSpace> spaces;
  for (int t = 0; t < static_cast<int>(problem.topologies().size()); ++t) spaces.emplace_back(problem, t);
  const std::size_t objectives = problem.objectives().size();
  try {
    for (std::uint64_t round = 0;; ++round) {
      const DesignSpace& space = spaces[round % spaces.size()];
      if (space.dimensions() == 0) {
        metered(space.at({}));
        continue;
      }
      LossRange range{LossPoint(objectives, 0.0), LossPoint(objectives, 1.0)};
      std::vector<LossPoint> known;
      for (const Met& met : metered.run().met) known.push_back(met.losses);
      if (known.size() > 1) range = loss_range(known);
      std::vector<double> weights;
      for (std::size_t k = 0; k < objectives; ++k) weights.push_back(random.uniform());
      std::vector<double> best;
      double least = std::numeric_limits<double>::infinity();
      const auto value = [&](const std::vector<double>& unit) {
        const LossPoint losses = metered(space.at(unit));
        double greatest = -std::numeric_limits<double>::infinity(), sum = 0;
        for (std::size_t k = 0; k < objectives; ++k) {
          const double extent = range.worst[k] - range.best[k];
          const double part = weights[k] * (losses[k] - range.best[k]) / (extent > 0 ? extent : 1);
          greatest = std::max(greatest, part);
          sum += part;
        }
        const bool feasible = losses.front() < kInfeasibleLoss;
        const double result = feasible ? greatest + 0.05 * sum : losses.front();
        if (result < least) {
          least = result;
          best = unit;
        }
        return result;
      };
      const std::int64_t global = 40 * (space.dimensions() + 1), local = 30 * (space.dimensions() + 1);
      minimise({NloptMethod::Crs2, space.spread_point(round / spaces.size(), seed), 0.1, global, random.next() >> 32},
               value);
      minimise({NloptMethod::Sbplx, best, 0.1, local, random.next() >> 32}, value);
    }
  } catch (const WorkSpent&) {}
  return metered.run();
}

}  // namespace

const std::vector<Method>& methods() {
  static const std::vector<Method> all{
      {"engine", "the program's search", true, engine},
      {"evolution", "its generations alone", true, evolution},
      {"random", "random designs", false, random_designs},
      {"nsga2", "pagmo's NSGA-II, the topology as a variable", false, nsga2},
      {"nlopt", "NLopt's CRS2 and SBPLX on achievement functions, topology after topology", false, nlopt},
  };
  return all;
}

}  // namespace formotion::bench
