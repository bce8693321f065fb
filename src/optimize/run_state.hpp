// What a search knows: everything evaluated, the fronts. Grows by folding results in a fixed order.
#pragma once

#include <unordered_map>
#include <vector>

#include "optimize/archive.hpp"
#include "optimize/design_space.hpp"
#include "optimize/near_pool.hpp"
#include "optimize/run_summary.hpp"
#include "optimize/search_task.hpp"
#include "optimize/stage_pool.hpp"

namespace formotion {

class RunState {
 public:
  explicit RunState(const Problem& problem);

  // The score of a candidate that was evaluated, or null.
  const Score* find(const Candidate& candidate) const;
  // Takes the results of one task in; candidates and stages known already do not count. At most `room` new ones.
  void fold(const TaskResult& result, const std::string& provenance, std::int64_t room);
  // Takes in what a store kept.
  void restore(Evaluated evaluated);
  void restore(StageRecord record);
  void add(Finding finding);
  void close_batch();  // after the last fold of a batch

  const std::vector<Evaluated>& evaluations() const { return evaluations_; }
  const Evaluated& evaluation(std::int64_t number) const { return evaluations_[static_cast<std::size_t>(number - 1)]; }
  const std::vector<StageRecord>& stages() const { return stages_; }
  const std::vector<Finding>& findings() const { return findings_; }
  // What counts against the budget: designs and single stages.
  std::int64_t spent() const { return static_cast<std::int64_t>(evaluations_.size() + stages_.size()); }
  std::int64_t feasible_count() const { return feasible_; }
  const Archive& front() const { return front_; }
  // The front among one topology's designs: a topology that others dominate today may hold the best ones tomorrow.
  const Archive& front_of(int topology) const { return fronts_[static_cast<std::size_t>(topology)]; }
  const NearPool& near(int topology) const { return near_[static_cast<std::size_t>(topology)]; }
  const std::vector<RunProgress>& history() const { return history_; }
  std::int64_t batches() const { return static_cast<std::int64_t>(history_.size()); }

  std::vector<double> losses_of(const Score& score) const;
  // The front; while nothing is feasible, the nearest designs. Ascending numbers.
  std::vector<Evaluated> best_designs() const;

 private:
  bool knows(const StageTrial& trial) const;

  std::vector<Objective> objectives_;
  std::vector<Evaluated> evaluations_;
  std::unordered_multimap<std::size_t, std::size_t> index_;  // hash of the candidate -> place in evaluations_
  std::vector<StageRecord> stages_;
  std::unordered_multimap<std::size_t, std::size_t> stage_index_;  // the same for single stages
  std::vector<Finding> findings_;
  std::int64_t feasible_ = 0, work_ = 0;
  Archive front_;
  std::vector<DesignSpace> spaces_;
  std::vector<Archive> fronts_;
  std::vector<NearPool> near_;
  std::vector<RunProgress> history_;
};

}  // namespace formotion
