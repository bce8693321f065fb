// One search of one problem by one method: the feasible designs that it met, by the work done until then.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "optimize/hypervolume.hpp"
#include "problem/problem.hpp"

namespace formotion::bench {

struct Met {
  std::int64_t work = 0;  // done by the whole search when this design was scored
  LossPoint losses;
};

struct YardstickRun {
  std::vector<Met> met;  // feasible designs in the order in which they were scored
  std::int64_t work = 0, evaluations = 0, stages = 0;
  double cpu_s = 0;
};

struct WorkSpent {};  // thrown by a metered problem when its work is spent

// A problem that keeps the record of a search on one thread and ends it when its work is spent.
class MeteredProblem {
 public:
  MeteredProblem(const Problem& problem, std::int64_t work);
  // Finite losses: those of an infeasible candidate are above all others, by its violation.
  LossPoint operator()(const Candidate& candidate);

  const Problem& problem() const { return problem_; }
  const YardstickRun& run() const { return run_; }

 private:
  const Problem& problem_;
  std::int64_t most_work_;
  std::unique_ptr<Memory> memory_;
  YardstickRun run_;
};
inline constexpr double kInfeasibleLoss = 1e6;

// Takes a scored design, or a single stage, into the record. What costs nothing is charged with one unit, so that every
// search ends. Designs that exceed most_work are not met.
void record(const Problem& problem, const Score& score, std::int64_t most_work, YardstickRun& run);
void record_stage(std::int64_t work, YardstickRun& run);

// Those that no other one dominates, sorted.
std::vector<LossPoint> front_of(std::vector<LossPoint> points);
// Of the first `count` designs met.
std::vector<LossPoint> front_after(const YardstickRun& run, std::size_t count);

// A problem's scale of hypervolumes: every objective from the best that any run met to 0 where it is maximised, to the
// greatest that any run met where it is minimised; 1 is the volume of all runs together.
struct Scale {
  LossRange range;
  double all = 0;
};
Scale scale_of(const Problem& problem, const std::vector<const YardstickRun*>& runs);
double volume(const std::vector<LossPoint>& front, const Scale& scale);
double final_volume(const YardstickRun& run, const Scale& scale);
// The work after which the volume first reached `target`; -1 if it never did, or if that is no
// volume at all.
std::int64_t work_to_reach(const YardstickRun& run, double target, const Scale& scale);

}  // namespace formotion::bench
