#include "optimize/least_squares.hpp"

#include <ceres/ceres.h>

#include <algorithm>
#include <deque>

#include "optimize/design_space.hpp"
#include "problem/smooth_problem.hpp"

namespace formotion {
namespace {

constexpr double kFirstReach = 0.2;     // how far one step may go, as a fraction of every range
constexpr int kHalvings = 4;            // of a step that does not make the candidate better
constexpr double kFirstRaise = 10;      // of the objective, in what matters to the user, ...
constexpr double kFirstShare = 0.1;     // ... of what shall become small this share of it, if that is more
constexpr std::size_t kRemembered = 6;  // earlier looks whose lasting residuals still count
constexpr int kMostFailures = 3;        // steps in a row of which no part makes it better

class Residuals final : public ceres::CostFunction {
 public:
  Residuals(const SmoothPieces& pieces, const DesignSpace& space, bool lasting_only)
      : pieces_(pieces), space_(space), lasting_only_(lasting_only) {
    const std::vector<double> zeros(static_cast<std::size_t>(space.dimensions()), 0.0), ones(zeros.size(), 1.0);
    low_ = space.at(zeros).values;
    high_ = space.at(ones).values;
    set_num_residuals(pieces.residuals());
    mutable_parameter_block_sizes()->push_back(space.dimensions());
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const Candidate candidate = space_.at(std::span(parameters[0], static_cast<std::size_t>(space_.dimensions())));
    double* jacobian = jacobians ? jacobians[0] : nullptr;
    std::vector<double> by_values(jacobian ? low_.size() * static_cast<std::size_t>(pieces_.residuals()) : 0);
    if (!pieces_.evaluate(candidate.values, residuals, jacobian ? by_values.data() : nullptr)) {
      // No slopes where there are values: Ceres is to end here and keep what it has come to, not to fail.
      if (!jacobian || !pieces_.evaluate(candidate.values, residuals, nullptr)) return false;
      std::fill(by_values.begin(), by_values.end(), 0.0);
    }
    for (int r = 0; lasting_only_ && r < pieces_.residuals(); ++r) {
      if (pieces_.lasts(r)) continue;
      residuals[r] = 0;
      const auto row = by_values.begin() + static_cast<std::ptrdiff_t>(jacobian ? r * low_.size() : 0);
      if (jacobian) std::fill(row, row + static_cast<std::ptrdiff_t>(low_.size()), 0.0);
    }
    for (std::size_t k = 0; k < by_values.size(); ++k) {
      const std::size_t i = k % low_.size();
      if (high_[i] > low_[i]) *jacobian++ = by_values[k] * (high_[i] - low_[i]);
    }
    return true;
  }

 private:
  const SmoothPieces& pieces_;
  const DesignSpace& space_;
  bool lasting_only_;
  std::vector<double> low_, high_;
};

bool any_lasts(const SmoothPieces& pieces) {
  for (int r = 0; r < pieces.residuals(); ++r) {
    if (pieces.lasts(r)) return true;
  }
  return false;
}

// Where the residuals of the last look, and the lasting ones of those before it, are least within reach of a point;
// none where nothing less was found.
std::optional<std::vector<double>> fitted(const std::deque<std::unique_ptr<SmoothPieces>>& looks,
                                          const DesignSpace& space, const std::vector<double>& from, double reach) {
  std::vector<double> unit = from;
  ceres::Problem problem;
  for (const auto& pieces : looks)
    problem.AddResidualBlock(new Residuals(*pieces, space, pieces != looks.back()), nullptr, unit.data());
  for (int i = 0; i < static_cast<int>(unit.size()); ++i) {
    const double at = from[static_cast<std::size_t>(i)];
    problem.SetParameterLowerBound(unit.data(), i, std::max(0.0, at - reach));
    problem.SetParameterUpperBound(unit.data(), i, std::min(1.0, at + reach));
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.num_threads = 1;
  options.max_num_iterations = looks.back()->steps();
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable() || !(summary.final_cost < summary.initial_cost)) return std::nullopt;
  return unit;
}

}  // namespace

void fit(const Problem& problem, const SearchTask& task, const std::function<Score(const Candidate&)>& score) {
  const std::vector<Objective> objectives(problem.objectives().begin(), problem.objectives().end());
  const Objective& objective = objectives[task.merit.focus];
  const DesignSpace space(problem, task.topology);
  std::vector<double> best = task.start ? space.unit_of(*task.start) : space.start();
  Score best_score = score(space.at(best));
  const SmoothProblem* smooth = problem.smooth();
  if (!smooth || space.dimensions() == 0) return;
  std::int64_t left = task.evaluations - 1;
  // Resolutions are what is told apart: of forces and work, that are sums over a way, far less than one step changes.
  const double share = objective.maximise ? 0 : kFirstShare * std::abs(best_score.objectives[task.merit.focus]);
  double reach = kFirstReach, raise = std::max(kFirstRaise * objective.resolution, share);
  std::deque<std::unique_ptr<SmoothPieces>> looks;
  for (int failures = 0; failures < kMostFailures && left > 0;) {
    const double aim = best_score.objectives[task.merit.focus] + (objective.maximise ? raise : -raise);
    std::erase_if(looks, [](const auto& pieces) { return !any_lasts(*pieces); });
    looks.push_back(smooth->pieces(space.at(best), {task.merit.focus, aim, task.merit.at_most}));
    if (!looks.back()) return;
    if (looks.size() > kRemembered) looks.pop_front();
    const auto end = fitted(looks, space, best, reach);
    bool better = false, gains = false;  // gains: what matters to the user
    double part = 1;
    for (int halving = 0; end && halving <= kHalvings && left > 0 && !better; ++halving, part /= 2) {
      std::vector<double> unit = best;
      for (std::size_t i = 0; i < unit.size(); ++i)
        unit[i] = std::clamp(best[i] + part * ((*end)[i] - best[i]), 0.0, 1.0);
      Score found = score(space.at(unit));
      --left;
      better = task.merit(found, objectives) < task.merit(best_score, objectives);
      if (!better) continue;
      gains = !best_score.feasible || std::abs(found.objectives[task.merit.focus] -
                                               best_score.objectives[task.merit.focus]) >= objective.resolution;
      if (halving == 0) raise *= 1.5;
      best = std::move(unit);
      best_score = std::move(found);
    }
    if (gains) {
      failures = 0;
    } else if (looks.size() > 1) {  // what was remembered may no longer hold
      looks.clear();
    } else {
      ++failures;
      reach /= 4;
      raise /= 4;
    }
  }
}

}  // namespace formotion
