// Least squares where slopes end before values do, and what they are told of the limits of a task.
#include <catch2/catch.hpp>
#include <cmath>

#include "optimize/least_squares.hpp"
#include "problem/smooth_problem.hpp"

using namespace formotion;

namespace {

const std::atomic<bool> kGoOn{false};

// Cost (x - 7)^2 + 1 over [0, 10], to be small; its pieces have slopes up to x = `slopes_to` alone.
class Valley final : public Problem, public SmoothProblem {
 public:
  explicit Valley(double slopes_to) : slopes_to_(slopes_to) {}
  std::span<const Variable> variables() const override { return variables_; }
  std::span<const Topology> topologies() const override { return topologies_; }
  std::span<const Objective> objectives() const override { return objectives_; }
  const SmoothProblem* smooth() const override { return this; }
  static double cost(double x) { return (x - 7) * (x - 7) + 1; }

  Score score(const Candidate& c, Memory* = nullptr) const override {
    Score score;
    score.feasible = true;
    score.objectives = {cost(c.values[0]), c.values[0]};
    score.worst_case = score.objectives;
    return score;
  }

  struct Piece final : SmoothPieces {
    double wanted = 0, slopes_to = 0;
    int residuals() const override { return 1; }
    bool lasts(int) const override { return false; }
    bool evaluate(std::span<const double> values, double* residuals, double* jacobian) const override {
      if (jacobian && values[0] > slopes_to) return false;
      residuals[0] = std::max(0.0, cost(values[0]) - wanted);
      if (jacobian) jacobian[0] = residuals[0] > 0 ? 2 * (values[0] - 7) : 0;
      return true;
    }
  };
  std::unique_ptr<SmoothPieces> pieces(const Candidate&, const SmoothAim& aim) const override {
    limits_seen = aim.at_most;
    auto piece = std::make_unique<Piece>();
    piece->wanted = aim.value;
    piece->slopes_to = slopes_to_;
    return piece;
  }
  mutable std::vector<std::optional<double>> limits_seen;

 private:
  double slopes_to_;
  std::vector<Variable> variables_{{"x", 0, 10, std::nullopt}};
  std::vector<Topology> topologies_{{"valley", {0}}};
  std::vector<Objective> objectives_{{"cost", false, 1e-4, false}, {"place", false, 1e-4, false}};
};

std::vector<Trial> fitted(const Valley& valley, double from, std::optional<double> place_at_most = {}) {
  SearchTask task;
  task.driver = Driver::LeastSquares;
  task.evaluations = 30;
  task.start = Candidate{0, {from}};
  task.merit = {0, {std::nullopt, place_at_most}, {1, 1}};
  return run_task(valley, task, kGoOn).trials;
}

double least(const std::vector<Trial>& trials) {
  double least = 1e300;
  for (const Trial& trial : trials) least = std::min(least, trial.score.objectives[0]);
  return least;
}

}  // namespace

TEST_CASE("least squares find the bottom of a valley that no aim reaches") {
  for (const double from : {0.0, 2.0, 6.9, 10.0}) {
    const auto trials = fitted(Valley(1e9), from);
    CAPTURE(from, trials.size());
    CHECK(least(trials) < 1.0005);
    CHECK(trials.size() <= 20);
  }
}

TEST_CASE("steps count up to where slopes end") {
  const Valley valley(3);
  CHECK(least(fitted(valley, 2)) < Valley::cost(3));
  // None at the start: nothing but the start is scored.
  CHECK(fitted(valley, 5).size() == 1);
}

TEST_CASE("pieces are told the limits that the merit sets to the other objectives") {
  const Valley valley(1e9);
  fitted(valley, 2, 3.5);
  REQUIRE(valley.limits_seen.size() == 2);
  CHECK_FALSE(valley.limits_seen[0]);
  CHECK(valley.limits_seen[1] == 3.5);
}
