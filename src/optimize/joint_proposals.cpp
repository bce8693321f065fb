#include "optimize/joint_proposals.hpp"

#include <algorithm>
#include <cmath>

#include "optimize/design_space.hpp"

namespace formotion {
namespace {

constexpr int kMostDirectDimensions = 8;                      // DIRECT-L's boxes are too coarse beyond
constexpr std::size_t kScanned = 3;                           // objectives
constexpr double kLargestStep = 0.2;                          // of a local search, as a share of every variable's range
constexpr int kFits = 4;                                      // one local search in so many is by least squares, ...
constexpr std::int64_t kFitEvaluations = 40, kFirstFit = 10;  // ... with so many evaluations
constexpr double kLooseShare = 0.3;  // of an objective's range that an improvement of another one may cost

}  // namespace

JointProposals::JointProposals(const Problem& problem, const RunState& state, RandomStream& random)
    : problem_(problem), state_(state), random_(random), scale_(problem.objectives().size(), 1) {
  for (std::size_t k = 0; k < objective_count(); ++k) {
    if (!problem.objectives()[k].stepwise) smooth_.push_back(k);
  }
  if (smooth_.empty()) smooth_.push_back(0);
  const auto& members = state_.front().members();
  for (std::size_t k = 0; k < objective_count() && members.size() > 1; ++k) {
    double low = members.front().losses[k], high = low;
    for (const Archive::Member& member : members) {
      low = std::min(low, member.losses[k]);
      high = std::max(high, member.losses[k]);
    }
    if (high > low) scale_[k] = high - low;
  }
}

Merit JointProposals::free_merit(std::size_t focus) const {
  return {focus, std::vector<std::optional<double>>(objective_count()), scale_};
}

SearchTask& JointProposals::add(Driver driver, int topology, std::int64_t evaluations, const std::string& what) {
  SearchTask task;
  task.driver = driver;
  task.topology = topology;
  task.evaluations = std::max<std::int64_t>(1, evaluations);
  task.seed = random_.next() >> 32;
  task.first_point = random_.next() >> 40;
  task.merit = free_merit(0);
  task.provenance = std::string(name(driver)) + ", " + what;
  tasks_.push_back(std::move(task));
  return tasks_.back();
}

// SBPLX; now and then least squares, where there are residuals: it ends after few evaluations, as good or not.
SearchTask& JointProposals::add_local(int topology, std::int64_t evaluations, const std::string& what) {
  if (problem_.smooth() && random_.below(kFits) == 0)
    return add(Driver::LeastSquares, topology, std::min(evaluations, kFitEvaluations), what);
  return add(Driver::Sbplx, topology, evaluations, what);
}

void JointProposals::guesses(const std::vector<int>& topologies) {
  for (const int t : topologies) {
    if (problem_.smooth())
      add(Driver::LeastSquares, t, kFirstFit, "from the starting values");
    else
      add(Driver::Sbplx, t, 1, "the starting values");
  }
}

void JointProposals::scan(const std::vector<int>& topologies, std::int64_t evaluations_each, std::uint64_t seed) {
  for (const int t : topologies) {
    guesses({t});
    const int dimensions = DesignSpace(problem_, t).dimensions();
    if (dimensions == 0) continue;
    const std::size_t scanned = std::min(objective_count(), kScanned);
    for (std::size_t k = 0; k < scanned; ++k) {
      SearchTask& global =
          add(dimensions <= kMostDirectDimensions ? Driver::DirectL : Driver::Crs2, t,
              evaluations_each / static_cast<std::int64_t>(2 * scanned), "scan for " + objective_name(k));
      global.merit = free_merit(k);
    }
    // In pieces, so that threads share them. All topologies see the same sequence.
    const std::int64_t points = evaluations_each / 2;
    for (std::int64_t done = 0; done < points; done += kTaskEvaluations) {
      SearchTask& spread = add(Driver::Spread, t, std::min(kTaskEvaluations, points - done), "scan");
      spread.first_point = static_cast<std::uint64_t>(done);
      spread.seed = seed;
    }
  }
}

// Topologies without feasible designs get every other task; improving what there is, the others. A part goes to
// looking elsewhere: most problems have several basins.
void JointProposals::search(const std::vector<int>& topologies, std::int64_t count, std::int64_t evaluations_each) {
  std::vector<int> solved, unsolved;
  for (const int t : topologies) (state_.front_of(t).members().empty() ? unsolved : solved).push_back(t);
  for (std::int64_t i = 0; i < count; ++i) {
    const int turn = random_.below(8);
    if (turn == 7) {
      look_elsewhere(random_.pick(topologies), evaluations_each);
    } else if (!unsolved.empty() && (solved.empty() || turn % 2 == 0)) {
      repair(random_.pick(unsolved), evaluations_each);
    } else if (turn == 3) {
      repair(random_.pick(topologies), evaluations_each);
    } else {
      improve(random_.pick(solved), evaluations_each);
    }
  }
}

void JointProposals::anything_new(const std::vector<int>& topologies, std::int64_t evaluations_each) {
  for (const int t : topologies) add(Driver::Spread, t, evaluations_each, "anything new");
}

void JointProposals::look_elsewhere(int topology, std::int64_t evaluations) {
  const auto focus = static_cast<std::size_t>(random_.below(static_cast<int>(objective_count())));
  add(Driver::Crs2, topology, evaluations, "for " + objective_name(focus)).merit.focus = focus;
}

// From an infeasible design that is near to feasibility or good at something, to a feasible one that keeps what was
// good.
void JointProposals::repair(int topology, std::int64_t evaluations) {
  const auto& near = state_.near(topology).members();
  if (near.empty()) return look_elsewhere(topology, evaluations);
  const NearPool::Member& member = random_.pick(near);
  SearchTask& task = add_local(topology, evaluations, "towards feasibility from d" + std::to_string(member.number));
  task.start = state_.evaluation(member.number).candidate;
  task.step = step();
  task.merit.focus = random_.pick(smooth_);
  const auto kept = static_cast<std::size_t>(random_.below(static_cast<int>(objective_count()) + 1));
  if (kept < objective_count()) {
    const Objective& objective = problem_.objectives()[kept];
    task.merit.at_most[kept] = objective.loss(state_.evaluation(member.number).score.objectives[kept]);
  }
}

// From a design of the topology's front along one objective, the others no worse than they are, or than somewhat
// more, or (if they can vary smoothly) free.
void JointProposals::improve(int topology, std::int64_t evaluations) {
  const Archive::Member& member = random_.pick(state_.front_of(topology).members());
  const std::size_t focus = random_.pick(smooth_);
  SearchTask& task =
      add_local(topology, evaluations, objective_name(focus) + " from d" + std::to_string(member.number));
  task.start = state_.evaluation(member.number).candidate;
  task.step = step();
  task.merit.focus = focus;
  const int slack = random_.below(3);
  for (std::size_t k = 0; k < objective_count(); ++k) {
    const bool free = slack == 2 && !problem_.objectives()[k].stepwise;
    if (k == focus || free) continue;
    task.merit.at_most[k] = member.losses[k] + (slack == 1 ? kLooseShare * random_.uniform() * scale_[k] : 0);
  }
}

double JointProposals::step() { return kLargestStep * std::pow(2.0, -6.0 * random_.uniform()); }

}  // namespace formotion
