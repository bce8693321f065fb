#include "yardstick_run.hpp"

#include <algorithm>

#include "optimize/archive.hpp"

namespace formotion::bench {

MeteredProblem::MeteredProblem(const Problem& problem, std::int64_t work)
    : problem_(problem), most_work_(work), memory_(problem.memory()) {}

LossPoint MeteredProblem::operator()(const Candidate& candidate) {
  if (run_.work >= most_work_) throw WorkSpent();
  const Score score = problem_.score(candidate, memory_.get());
  record(problem_, score, most_work_, run_);
  const auto objectives = problem_.objectives();
  LossPoint losses;
  for (std::size_t k = 0; k < objectives.size(); ++k)
    losses.push_back(score.feasible ? objectives[k].loss(score.objectives[k]) : kInfeasibleLoss + score.violation);
  return losses;
}

void record(const Problem& problem, const Score& score, std::int64_t most_work, YardstickRun& run) {
  run.work += std::max<std::int64_t>(1, score.work);
  ++run.evaluations;
  if (!score.feasible || run.work > most_work) return;
  Met met{run.work, {}};
  for (std::size_t k = 0; k < problem.objectives().size(); ++k)
    met.losses.push_back(problem.objectives()[k].loss(score.objectives[k]) + 0.0);
  run.met.push_back(std::move(met));
}

void record_stage(std::int64_t work, YardstickRun& run) {
  run.work += std::max<std::int64_t>(1, work);
  ++run.stages;
}

std::vector<LossPoint> front_of(std::vector<LossPoint> points) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  std::vector<LossPoint> front;  // nothing later in this order dominates anything earlier
  for (LossPoint& point : points) {
    if (std::none_of(front.begin(), front.end(), [&](const LossPoint& other) { return dominates(other, point); }))
      front.push_back(std::move(point));
  }
  return front;
}

std::vector<LossPoint> front_after(const YardstickRun& run, std::size_t count) {
  std::vector<LossPoint> points;
  for (std::size_t i = 0; i < count; ++i) points.push_back(run.met[i].losses);
  return front_of(std::move(points));
}

Scale scale_of(const Problem& problem, const std::vector<const YardstickRun*>& runs) {
  std::vector<LossPoint> points;
  for (const YardstickRun* run : runs) {
    for (const Met& met : run->met) points.push_back(met.losses);
  }
  Scale scale;
  if (points.empty()) return scale;
  scale.range = loss_range(points);
  for (std::size_t k = 0; k < problem.objectives().size(); ++k) {
    if (problem.objectives()[k].maximise) scale.range.worst[k] = 0;
  }
  scale.all = normalised_hypervolume(front_of(std::move(points)), scale.range);
  return scale;
}

double volume(const std::vector<LossPoint>& front, const Scale& scale) {
  return scale.all > 0 ? normalised_hypervolume(front, scale.range) / scale.all : 0;
}

double final_volume(const YardstickRun& run, const Scale& scale) {
  return volume(front_after(run, run.met.size()), scale);
}

std::int64_t work_to_reach(const YardstickRun& run, double target, const Scale& scale) {
  if (target <= 0 || final_volume(run, scale) < target) return -1;
  std::size_t below = 0, enough = run.met.size();  // volumes only grow with the designs met
  while (enough - below > 1) {
    const std::size_t middle = below + (enough - below) / 2;
    (volume(front_after(run, middle), scale) < target ? below : enough) = middle;
  }
  return run.met[enough - 1].work;
}

}  // namespace formotion::bench
