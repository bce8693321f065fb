#include "optimize/least_squares.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "problem/smooth_problem.hpp"
#include "toy_problem.hpp"

using namespace formotion;

namespace {

const std::atomic<bool> kGoOn{false};

// Gain is the least of three planes over [0, 10] x [0, 10]: x, y and 12 - x - y, 4 at most, at (4, 4). The residual is
// of the plane that decides; a liar turns its slopes round.
class Roof final : public Problem, public SmoothProblem {
 public:
  explicit Roof(bool lies) : lies_(lies) {}
  std::span<const Variable> variables() const override { return variables_; }
  std::span<const Topology> topologies() const override { return topologies_; }
  std::span<const Objective> objectives() const override { return objectives_; }
  const SmoothProblem* smooth() const override { return this; }

  static std::array<double, 3> planes(std::span<const double> v) { return {v[0], v[1], 12 - v[0] - v[1]}; }
  Score score(const Candidate& c, Memory* = nullptr) const override {
    const auto all = planes(c.values);
    Score score;
    score.feasible = true;
    score.objectives = {*std::min_element(all.begin(), all.end())};
    score.worst_case = score.objectives;
    return score;
  }

  struct Plane final : SmoothPieces {
    std::size_t which = 0;
    double wanted = 0;
    bool lies = false;
    int residuals() const override { return 1; }
    bool lasts(int) const override { return true; }
    bool evaluate(std::span<const double> values, double* residuals, double* jacobian) const override {
      constexpr double kSlopes[3][2] = {{1, 0}, {0, 1}, {-1, -1}};
      const double lacking = wanted - planes(values)[which];
      residuals[0] = lies ? std::max(0.0, 2 * wanted - lacking) : std::max(0.0, lacking);
      for (int i = 0; jacobian && i < 2; ++i) jacobian[i] = lacking > 0 ? (lies ? 1 : -1) * kSlopes[which][i] : 0;
      return true;
    }
  };
  std::unique_ptr<SmoothPieces> pieces(const Candidate& candidate, const SmoothAim& aim) const override {
    const auto all = planes(candidate.values);
    auto plane = std::make_unique<Plane>();
    plane->which = static_cast<std::size_t>(std::min_element(all.begin(), all.end()) - all.begin());
    plane->wanted = aim.value;
    plane->lies = lies_;
    return plane;
  }

 private:
  bool lies_;
  std::vector<Variable> variables_{{"x", 0, 10, std::nullopt}, {"y", 0, 10, std::nullopt}};
  std::vector<Topology> topologies_{{"roof", {0, 1}}};
  std::vector<Objective> objectives_{{"gain", true, 0.01, false}};
};

SearchTask task(std::int64_t evaluations, std::size_t objectives) {
  SearchTask result;
  result.driver = Driver::LeastSquares;
  result.evaluations = evaluations;
  result.start = Candidate{0, objectives == 1 ? std::vector<double>{1, 2} : std::vector<double>{1}};
  result.merit = {0, std::vector<std::optional<double>>(objectives), std::vector<double>(objectives, 1)};
  return result;
}

double best_gain(const std::vector<Trial>& trials) {
  double best = -1e300;
  for (const Trial& trial : trials) best = std::max(best, trial.score.objectives[0]);
  return best;
}

}  // namespace

TEST_CASE("least squares climb to where three pieces meet within their budget") {
  const Roof roof(false);
  for (const std::int64_t budget : {1, 7, 60}) {
    const auto trials = run_task(roof, task(budget, 1), kGoOn).trials;
    CHECK(static_cast<std::int64_t>(trials.size()) <= budget);
    if (budget == 60) CHECK(best_gain(trials) > 3.9);
    const auto again = run_task(roof, task(budget, 1), kGoOn).trials;
    REQUIRE(again.size() == trials.size());
    for (std::size_t i = 0; i < trials.size(); ++i) CHECK(trials[i].candidate.values == again[i].candidate.values);
  }
}

TEST_CASE("residuals that lie cost evaluations and no more: scores decide what is kept") {
  const auto trials = run_task(Roof(true), task(200, 1), kGoOn).trials;
  CHECK(best_gain(trials) == 1);  // the start's
  CHECK(trials.size() < 40);
}

TEST_CASE("a problem without residuals gets its start scored") {
  const auto trials = run_task(ToyProblem(), task(50, 2), kGoOn).trials;
  REQUIRE(trials.size() == 1);
  CHECK(trials.front().candidate.values == std::vector<double>{1});
}
