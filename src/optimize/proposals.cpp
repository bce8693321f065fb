#include "optimize/proposals.hpp"

#include <algorithm>
#include <numeric>

#include "optimize/evolution.hpp"
#include "optimize/joint_proposals.hpp"
#include "optimize/stage_proposals.hpp"

namespace formotion {
namespace {

constexpr std::uint64_t kProposals = 0xba7c4;  // purpose of the random stream
constexpr double kScanShare = 0.2;             // of the budget goes to the first batch
constexpr std::int64_t kMostAScan = 4000;      // so that a stop during the first batch of a long run loses little
constexpr std::int64_t kLeastAScan = 100;      // a topology
constexpr int kBatches = 12;                   // about as many batches follow
constexpr std::int64_t kMostABatch = 2400;     // so that a stop loses little
constexpr std::int64_t kLeastABatch = 60;      // of small budgets a sixth, ...
constexpr std::int64_t kLeastLater = 200;      // ... up to so many where stages are searched; a task's otherwise
constexpr std::int64_t kLeastATask = 40;
constexpr std::size_t kMostListed = 40;    // composed tracks a batch
constexpr std::int64_t kEarlyBatches = 3;  // in which stages get a third; then an eighth
constexpr std::size_t kMostFollowed = 12;  // composing topologies that joint search follows
constexpr std::size_t kMostGuesses = 12;   // composing topologies whose starting values are scored
constexpr std::size_t kMostAnew = 40;      // topologies that are looked at where nothing brings anything new
constexpr std::int64_t kLeastLocal = 120;  // evaluations of a local search
constexpr std::int64_t kLocalTurn = 4;     // of so many batches one is for local searches, beside stages
constexpr int kStrayTask = 8;              // one joint task in so many is for any topology

class Proposer {
 public:
  Proposer(const Problem& problem, const RunState& state, const SearchBudget& budget)
      : problem_(problem),
        state_(state),
        budget_(budget),
        random_(budget.seed, kProposals, static_cast<std::uint64_t>(state.batches())),
        joint_(problem, state, random_) {
    const StagedProblem* staged = problem.staged();
    // Stages are searched for tolerance; where nobody asks for it, whole candidates are cheaper.
    const bool small =
        staged && staged->states().size() <= kMostStates && !staged->goals().empty() && staged->tolerance_objective();
    for (int t = 0; t < static_cast<int>(problem.topologies().size()); ++t)
      (small && !staged->stages(t).empty() ? composing_ : others_).push_back(t);
  }

  std::vector<SearchTask> run() {
    state_.batches() == 0 ? scan() : search();
    return std::move(tasks_);
  }

 private:
  void scan() {
    const auto wanted = static_cast<std::int64_t>(kScanShare * static_cast<double>(budget_.evaluations));
    if (!others_.empty()) {
      const std::int64_t share = composing_.empty() ? wanted : wanted / 2;
      const auto count = static_cast<std::int64_t>(others_.size());
      const std::int64_t all = std::min(share, std::max(kMostAScan, kLeastAScan * count));
      const std::vector<int> scanned =
          some_of(others_, static_cast<std::size_t>(std::max<std::int64_t>(1, share / kLeastAScan)));
      joint_.scan(scanned, all / static_cast<std::int64_t>(scanned.size()), budget_.seed);
    }
    if (!composing_.empty()) {
      StageProposals stages(problem_, state_, random_);
      joint_.guesses(some_of(composing_, kMostGuesses));
      stages.scan(std::clamp(wanted / 2, std::min(wanted, kLeastLater), kMostAScan), budget_.seed);
      append(stages.take());
    }
    append(joint_.take());
  }

  void search() {
    const auto rest = static_cast<std::int64_t>(static_cast<double>(budget_.evaluations) * (1 - kScanShare));
    const std::int64_t least = std::clamp(rest / 6, kLeastABatch, composing_.empty() ? kTaskEvaluations : kLeastLater);
    const std::int64_t batch = std::clamp(rest / kBatches, std::min(rest, least), kMostABatch);
    const std::int64_t wanted = std::clamp(batch / (composing_.empty() ? 2 : 6), kLeastATask, kTaskEvaluations);
    const std::int64_t tasks = std::max<std::int64_t>(1, batch / wanted);
    const std::int64_t each = std::max<std::int64_t>(1, batch / tasks);
    const auto& history = state_.history();
    if (history.size() > 1 && history.back().spent() == history[history.size() - 2].spent()) {
      std::vector<int> all(problem_.topologies().size());
      std::iota(all.begin(), all.end(), 0);
      joint_.anything_new(some_of(all, kMostAnew), each);
      return append(joint_.take());
    }
    std::int64_t for_stages = composing_.empty() ? 0 : others_.empty() ? tasks : (tasks + 1) / 2;
    if (for_stages > 0) compose(for_stages, each);
    const std::int64_t rest_of_tasks = tasks - for_stages;
    if (rest_of_tasks > 0 && !others_.empty()) {
      // Half of the work breeds across topologies, half goes on from single designs; little work takes turns.
      const bool breeds = state_.batches() % 2 == 1;
      const std::int64_t bred = rest_of_tasks > 2 ? rest_of_tasks / 2 : breeds ? rest_of_tasks : 0;
      if (bred > 0) append(evolution_tasks(problem_, state_, bred * each, random_, others_));
      if (rest_of_tasks > bred) joint_.search(others_, rest_of_tasks - bred, each);
      append(joint_.take());
    }
  }

  // Composed tracks first, then stages that better ones could be made of, then whole candidates of the topologies that
  // compositions reach.
  void compose(std::int64_t tasks, std::int64_t each) {
    StageProposals stages(problem_, state_, random_);
    const std::int64_t evaluations = std::max(each, tasks * each - stages.list(kMostListed));
    const std::int64_t share = state_.batches() <= kEarlyBatches ? evaluations / 3 : evaluations / 8;
    const std::int64_t left = evaluations - share + stages.search(share, each);
    append(stages.take());
    std::vector<int> followed = stages.ranked();
    for (const Archive::Member& member : state_.front().members())
      followed.insert(followed.begin(), state_.evaluation(member.number).candidate.topology);
    std::vector<int> distinct;
    for (const int t : followed) {
      const bool composes = std::binary_search(composing_.begin(), composing_.end(), t);
      if (composes && std::find(distinct.begin(), distinct.end(), t) == distinct.end()) distinct.push_back(t);
    }
    if (distinct.size() > kMostFollowed) distinct.resize(kMostFollowed);
    if (distinct.empty()) distinct = some_of(composing_, kMostFollowed);
    // Breeding and local searches take turns: both need some room.
    const bool few = composing_.size() <= kMostFollowed;
    if (state_.batches() % kLocalTurn != 0)
      return append(evolution_tasks(problem_, state_, left, random_, few ? composing_ : distinct));
    const std::int64_t local = std::max<std::int64_t>(1, left / kLeastLocal);
    for (std::int64_t i = 0; i < local; ++i) {
      const bool stray = random_.below(kStrayTask) == 0;
      joint_.search(stray ? std::vector<int>{random_.pick(composing_)} : distinct, 1, left / local);
    }
    append(joint_.take());
  }

  // So many of them, picked at random; all if there are no more.
  std::vector<int> some_of(const std::vector<int>& topologies, std::size_t most) {
    std::vector<int> some = topologies;
    if (some.size() > most) {
      // A partial shuffle: the first `most` stay.
      for (std::size_t i = 0; i < most; ++i) {
        const auto left = static_cast<int>(some.size() - i);
        std::swap(some[i], some[i + static_cast<std::size_t>(random_.below(left))]);
      }
      some.resize(most);
    }
    std::sort(some.begin(), some.end());
    return some;
  }

  void append(std::vector<SearchTask> tasks) {
    tasks_.insert(tasks_.end(), std::make_move_iterator(tasks.begin()), std::make_move_iterator(tasks.end()));
  }

  const Problem& problem_;
  const RunState& state_;
  const SearchBudget& budget_;
  RandomStream random_;
  JointProposals joint_;
  std::vector<int> composing_, others_;  // topologies that come apart into stages, and those that do not
  std::vector<SearchTask> tasks_;
};

}  // namespace

std::vector<SearchTask> propose(const Problem& problem, const RunState& state, const SearchBudget& budget) {
  return Proposer(problem, state, budget).run();
}

}  // namespace formotion
