#include "optimize/run_state.hpp"

#include <algorithm>
#include <bit>

namespace formotion {
namespace {

constexpr std::size_t kFrontCapacity = 100;
constexpr std::size_t kTopologyCapacity = 30;
constexpr std::size_t kNearCapacity = 30;
constexpr double kNearRadius = 0.1;
constexpr std::size_t kShownInfeasible = 10;

std::size_t hash_of(int group, const std::vector<double>& values) {
  std::uint64_t hash = 0xcbf29ce484222325u ^ static_cast<std::uint64_t>(group);  // FNV-1a over words
  for (const double value : values) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(value + 0.0)) * 0x100000001b3u;
    hash ^= hash >> 29;
  }
  return hash;
}
std::size_t hash_of(const Candidate& candidate) { return hash_of(candidate.topology, candidate.values); }

std::vector<double> resolutions_of(const std::vector<Objective>& objectives) {
  std::vector<double> resolutions;
  for (const Objective& objective : objectives) resolutions.push_back(objective.resolution);
  return resolutions;
}

}  // namespace

RunState::RunState(const Problem& problem)
    : objectives_(problem.objectives().begin(), problem.objectives().end()),
      front_(resolutions_of(objectives_), kFrontCapacity) {
  for (int t = 0; t < static_cast<int>(problem.topologies().size()); ++t) spaces_.emplace_back(problem, t);
  near_.assign(problem.topologies().size(), NearPool(kNearCapacity, kNearRadius));
  fronts_.assign(problem.topologies().size(), Archive(resolutions_of(objectives_), kTopologyCapacity));
}

const Score* RunState::find(const Candidate& candidate) const {
  const auto [begin, end] = index_.equal_range(hash_of(candidate));
  for (auto it = begin; it != end; ++it) {
    const Candidate& known = evaluations_[it->second].candidate;
    if (known.topology == candidate.topology && known.values == candidate.values)
      return &evaluations_[it->second].score;
  }
  return nullptr;
}

void RunState::fold(const TaskResult& result, const std::string& provenance, std::int64_t room) {
  for (const Trial& trial : result.trials) {
    if (room <= 0) return;
    if (find(trial.candidate)) continue;
    --room;
    restore({static_cast<std::int64_t>(evaluations_.size()) + 1, trial.candidate, trial.score, provenance});
  }
  for (const StageTrial& trial : result.stages) {
    if (room <= 0) return;
    if (knows(trial)) continue;
    --room;
    restore({static_cast<std::int64_t>(stages_.size()) + 1, trial, provenance});
  }
}

// With the same demand: another one tells something new.
bool RunState::knows(const StageTrial& trial) const {
  const auto [begin, end] = stage_index_.equal_range(hash_of(trial.kind, trial.values));
  return std::any_of(begin, end, [&](const auto& entry) {
    const StageTrial& known = stages_[entry.second].trial;
    return known.kind == trial.kind && known.values == trial.values && known.demanded == trial.demanded;
  });
}

void RunState::restore(StageRecord record) {
  stage_index_.emplace(hash_of(record.trial.kind, record.trial.values), stages_.size());
  work_ += record.trial.work;
  stages_.push_back(std::move(record));
}

void RunState::add(Finding finding) { findings_.push_back(std::move(finding)); }

void RunState::restore(Evaluated evaluated) {
  index_.emplace(hash_of(evaluated.candidate), evaluations_.size());
  work_ += evaluated.score.work;
  const auto topology = static_cast<std::size_t>(evaluated.candidate.topology);
  const std::vector<double> losses = losses_of(evaluated.score);
  if (evaluated.score.feasible) {
    ++feasible_;
    fronts_[topology].offer(evaluated.number, losses);
    front_.offer(evaluated.number, losses);
  } else if (evaluated.score.failure == Failure::None) {
    near_[topology].offer(
        {evaluated.number, spaces_[topology].unit_of(evaluated.candidate), evaluated.score.violation});
  }
  evaluations_.push_back(std::move(evaluated));
}

void RunState::close_batch() {
  RunProgress progress;
  progress.evaluations = static_cast<std::int64_t>(evaluations_.size());
  progress.stages = static_cast<std::int64_t>(stages_.size());
  progress.work = work_;
  progress.front_size = static_cast<std::int64_t>(front_.members().size());
  for (std::size_t k = 0; k < objectives_.size() && !front_.members().empty(); ++k) {
    double least = front_.members().front().losses[k];
    for (const Archive::Member& member : front_.members()) least = std::min(least, member.losses[k]);
    progress.best.push_back(objectives_[k].loss(least) + 0.0);
  }
  for (const Archive::Member& member : front_.members()) progress.front.push_back(member.losses);
  history_.push_back(std::move(progress));
}

std::vector<Evaluated> RunState::best_designs() const {
  std::vector<Evaluated> designs;
  for (const Archive::Member& member : front_.members()) designs.push_back(evaluation(member.number));
  if (!designs.empty()) return designs;
  for (const NearPool& near : near_) {
    for (const NearPool::Member& member : near.members()) designs.push_back(evaluation(member.number));
  }
  std::stable_sort(designs.begin(), designs.end(),
                   [](const Evaluated& a, const Evaluated& b) { return a.score.violation < b.score.violation; });
  if (designs.size() > kShownInfeasible) designs.resize(kShownInfeasible);
  std::sort(designs.begin(), designs.end(), [](const Evaluated& a, const Evaluated& b) { return a.number < b.number; });
  return designs;
}

std::vector<double> RunState::losses_of(const Score& score) const {
  std::vector<double> losses;
  for (std::size_t k = 0; k < objectives_.size(); ++k) losses.push_back(objectives_[k].loss(score.objectives[k]) + 0.0);
  return losses;
}

}  // namespace formotion
