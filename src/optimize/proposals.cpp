#include "optimize/proposals.hpp"

#include <algorithm>
#include <cmath>

#include "optimize/design_space.hpp"
#include "optimize/random_stream.hpp"

namespace formotion {
namespace {

constexpr std::uint64_t kProposals = 0xba7c4;  // purpose of the random stream
constexpr int kMostDirectDimensions = 8;       // DIRECT-L's boxes are too coarse beyond
constexpr double kScanShare = 0.2;             // of the budget goes to the first batch
constexpr std::int64_t kMostAScan = 4000;      // so that a stop during the first batch of a long run loses little
constexpr std::int64_t kLeastAScan = 100;      // a topology
constexpr int kBatches = 12;                   // about as many batches follow
constexpr std::int64_t kMostABatch = 2400;     // so that a stop loses little
constexpr std::int64_t kTaskEvaluations = 150;
constexpr double kLargestStep = 0.2;  // of a local search, as a share of every variable's range
constexpr double kLooseShare = 0.3;   // of an objective's range that an improvement of another one may cost

class Proposer {
 public:
  Proposer(const Problem& problem, const RunState& state, const SearchBudget& budget)
      : problem_(problem),
        state_(state),
        budget_(budget),
        random_(budget.seed, kProposals, static_cast<std::uint64_t>(state.batches())) {
    for (int t = 0; t < static_cast<int>(problem.topologies().size()); ++t) {
      spaces_.emplace_back(problem, t);
      topologies_.push_back(t);
      (state.front_of(t).members().empty() ? unsolved_ : solved_).push_back(t);
    }
    for (std::size_t k = 0; k < objective_count(); ++k) {
      if (!problem.objectives()[k].stepwise) smooth_.push_back(k);
    }
    if (smooth_.empty()) smooth_.push_back(0);
    set_scales();
  }

  std::vector<SearchTask> run() {
    state_.batches() == 0 ? scan() : search();
    return std::move(tasks_);
  }

 private:
  std::size_t objective_count() const { return problem_.objectives().size(); }

  // One unit of an objective: its range on the front.
  void set_scales() {
    scale_.assign(objective_count(), 1);
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

  Merit free_merit(std::size_t focus) const {
    return {focus, std::vector<std::optional<double>>(objective_count()), scale_};
  }

  SearchTask& add(Driver driver, int topology, std::int64_t evaluations, const std::string& what) {
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

  // Every topology alike: the user's guess and spread points, and a global scan for feasibility first, then for an
  // objective.
  void scan() {
    const auto count = static_cast<std::int64_t>(spaces_.size());
    const auto wanted = static_cast<std::int64_t>(kScanShare * static_cast<double>(budget_.evaluations));
    const auto share = std::min(wanted, std::max(kMostAScan, kLeastAScan * count)) / count;
    for (int t = 0; t < static_cast<int>(spaces_.size()); ++t) {
      SearchTask& guess = add(Driver::Sbplx, t, 1, "the starting values");
      guess.start = std::nullopt;
      const int dimensions = spaces_[static_cast<std::size_t>(t)].dimensions();
      if (dimensions == 0) continue;
      const std::size_t scanned = std::min<std::size_t>(objective_count(), 3);
      for (std::size_t k = 0; k < scanned; ++k) {
        SearchTask& global = add(dimensions <= kMostDirectDimensions ? Driver::DirectL : Driver::Crs2, t,
                                 share / static_cast<std::int64_t>(2 * scanned), "scan for " + objective_name(k));
        global.merit = free_merit(k);
      }
      // In pieces, so that threads share them. All topologies see the same sequence.
      const std::int64_t points = share / 2;
      for (std::int64_t done = 0; done < points; done += kTaskEvaluations) {
        SearchTask& spread = add(Driver::Spread, t, std::min(kTaskEvaluations, points - done), "scan");
        spread.first_point = static_cast<std::uint64_t>(done);
        spread.seed = budget_.seed;
      }
    }
  }

  // Topologies without feasible designs get every other task; improving what there is, the others. A part goes to
  // looking elsewhere: most problems have several basins. Where all that brought nothing new, anything will do.
  void search() {
    const auto rest = static_cast<std::int64_t>(static_cast<double>(budget_.evaluations) * (1 - kScanShare));
    const std::int64_t batch = std::clamp(rest / kBatches, std::min(rest, kTaskEvaluations), kMostABatch);
    const std::int64_t tasks = std::max<std::int64_t>(1, batch / kTaskEvaluations);
    const std::int64_t each = std::max<std::int64_t>(1, batch / tasks);
    const auto& history = state_.history();
    const bool fruitless = history.size() > 1 && history.back().evaluations == history[history.size() - 2].evaluations;
    if (fruitless) {
      for (const int topology : topologies_) add(Driver::Spread, topology, each, "anything new");
      return;
    }
    for (std::int64_t i = 0; i < tasks; ++i) {
      if (i % 8 == 7) {
        look_elsewhere(random_.pick(topologies_), each);
      } else if (!unsolved_.empty() && (solved_.empty() || i % 2 == 0)) {
        repair(random_.pick(unsolved_), each);
      } else if (i % 8 == 3) {
        repair(random_.pick(topologies_), each);
      } else {
        improve(random_.pick(solved_), each);
      }
    }
  }

  const std::string& objective_name(std::size_t k) const { return problem_.objectives()[k].name; }

  void look_elsewhere(int topology, std::int64_t evaluations) {
    const auto focus = static_cast<std::size_t>(random_.below(static_cast<int>(objective_count())));
    add(Driver::Crs2, topology, evaluations, "for " + objective_name(focus)).merit.focus = focus;
  }

  // From an infeasible design that is near to feasibility or good at something, to a feasible one that keeps what was
  // good.
  void repair(int topology, std::int64_t evaluations) {
    const auto& near = state_.near(topology).members();
    if (near.empty()) return look_elsewhere(topology, evaluations);
    const NearPool::Member& member = random_.pick(near);
    SearchTask& task =
        add(Driver::Sbplx, topology, evaluations, "towards feasibility from d" + std::to_string(member.number));
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
  void improve(int topology, std::int64_t evaluations) {
    const Archive::Member& member = random_.pick(state_.front_of(topology).members());
    const std::size_t focus = random_.pick(smooth_);
    SearchTask& task =
        add(Driver::Sbplx, topology, evaluations, objective_name(focus) + " from d" + std::to_string(member.number));
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

  double step() { return kLargestStep * std::pow(2.0, -6.0 * random_.uniform()); }

  const Problem& problem_;
  const RunState& state_;
  const SearchBudget& budget_;
  RandomStream random_;
  std::vector<DesignSpace> spaces_;
  std::vector<int> topologies_, solved_, unsolved_;  // all; those with and without feasible designs
  std::vector<std::size_t> smooth_;                  // objectives that a local search can follow
  std::vector<double> scale_;
  std::vector<SearchTask> tasks_;
};

}  // namespace

std::vector<SearchTask> propose(const Problem& problem, const RunState& state, const SearchBudget& budget) {
  return Proposer(problem, state, budget).run();
}

}  // namespace formotion
