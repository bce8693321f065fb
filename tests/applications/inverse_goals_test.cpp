// Goals on configurations and facets, from the problem file to the violations.
#include "applications/feeder/inverse_goals.hpp"

#include <catch2/catch.hpp>
#include <numbers>

#include "io/problem_file.hpp"
#include "optimize/search_task.hpp"
#include "witness/feeder_specs.hpp"

using namespace formotion;
using namespace formotion::witness;

namespace {

constexpr double kDegree = std::numbers::pi / 180;
const std::atomic<bool> kGoOn{false};

std::string problem_path(const std::string& name) {
  return std::string(FORMOTION_SOURCE_DIR) + "/problems/feeder/" + name + ".json";
}

// The el, 30 x 20 mm with its centre of mass at (12.5, 7.5), before a block from x = 60 on that is 12 mm high.
feeder::FeederSpec el_before_block(std::vector<feeder::ConfigurationGoal> goals) {
  feeder::FeederSpec spec =
      feeder_spec(flat_part(el_outline(), false),
                  {{feeder::Fence{literal(Loop{{60, -2}, {90, -2}, {90, 12}, {60, 12}})}, literal(0)}}, 40);
  spec.goal.configurations = std::move(goals);
  return spec;
}

std::vector<feeder::GoalAnswer> answers(const feeder::FeederSpec& spec, const std::vector<double>& values = {}) {
  const feeder::PartModel part = feeder::part_model(spec.part, spec.environment, values);
  const auto defects = feeder::defects_of(part);
  const feeder::DesignCase design{spec, spec.designs.front(), part, defects, values};
  return feeder::goal_answers(
      design, feeder::lay_out(design.features, spec.environment, spec.manufacture, part.diameter_mm, values));
}

SearchTask fit_of(const Problem& problem, std::int64_t evaluations) {
  SearchTask task;
  task.driver = Driver::LeastSquares;
  task.evaluations = evaluations;
  const std::size_t count = problem.objectives().size();
  task.merit = {1, std::vector<std::optional<double>>(count), std::vector<double>(count, 1)};
  return task;
}

}  // namespace

TEST_CASE("free and blocked are asked with the clearance and with minus the clearance") {
  // Standing 10.5 mm before the block; and 4.5 mm into it, on the wall.
  const Configuration before{32, 8.5, 0}, within{47, 7.5, 0};
  const auto found = answers(el_before_block({{0, before, feeder::Must::Free, 1},
                                              {0, before, feeder::Must::Free, 2},
                                              {0, within, feeder::Must::Blocked, 4},
                                              {0, within, feeder::Must::Blocked, 5},
                                              {0, within, feeder::Must::Free, 0.5}}));
  CHECK(*found[0].got_mm == Approx(1));  // the wall is nearest
  CHECK(found[0].lacking_mm == Approx(0).margin(1e-9));
  CHECK(found[1].lacking_mm == Approx(1));
  CHECK(*found[2].got_mm == Approx(4.5));
  CHECK(found[2].lacking_mm == 0);
  CHECK(found[3].lacking_mm == Approx(0.5));
  CHECK(found[4].lacking_mm == Approx(5));
}

TEST_CASE("supported and unsupported are asked with the margin and with minus the margin") {
  feeder::FeederSpec spec = feeder_spec(flat_part(el_outline(), false), {balcony(9, 100)}, 40);
  const Configuration low{50, 7.5, 0}, high{50, 10.5, 0};
  spec.goal.configurations = {{0, low, feeder::Must::Supported, 1},
                              {0, high, feeder::Must::Unsupported, 1},
                              {0, high, feeder::Must::Supported, 0}};
  const auto found = answers(spec);
  CHECK(*found[0].got_mm == Approx(1.5));
  CHECK(found[0].lacking_mm == 0);
  CHECK(*found[1].got_mm == Approx(1.5));
  CHECK(found[2].lacking_mm == Approx(1.5));
}

TEST_CASE("a facet's way outward is how far its obstacle came on along the contact normal") {
  feeder::FeederSpec spec = el_before_block({});
  spec.variables = {{"rise", -5, 5, 0}};
  for (feeder::FeatureSpec& feature : spec.designs.front()) {
    AffineLoop& loop = std::get<feeder::Fence>(feature.shape).polygon_mm;
    loop[2][1].terms = loop[3][1].terms = {{0, 1.0}};
  }
  // The bottom edge on the block's corner 3, and the corner 0 on its top (edge 2), both at 0 degrees; corner 0 at 20.
  feeder::FacetGoal edge, corner;
  edge.edge_moves = true;
  edge.component = corner.component = 1;
  edge.fixed = 3;
  corner.fixed = 2;
  edge.outward_mm = corner.outward_mm = 2;
  corner.theta_rad = 20 * kDegree;
  spec.goal.facets = {edge, corner};
  REQUIRE_FALSE(feeder::place_references(spec).has_value());
  for (const double rise : {-1.0, 0.0, 1.25, 3.0}) {
    for (const feeder::GoalAnswer& answer : answers(spec, {rise})) {
      CHECK(*answer.got_mm == Approx(rise).margin(1e-12));
      CHECK(answer.lacking_mm == Approx(std::max(0.0, 2 - rise)));
    }
  }
  spec.goal.facets[1].theta_rad = 100 * kDegree;  // the corner's other edge is in the block then
  const auto defect = feeder::place_references(spec);
  REQUIRE(defect.has_value());
  CHECK(defect->first == 1);
}

TEST_CASE("what a goal lacks is a violation and part of the score") {
  feeder::FeederSpec spec = feeder_spec(flat_part(bibazu_l(), false), {balcony(12, 100)}, 60);
  const feeder::FeederProblem without(spec);
  REQUIRE(without.evaluate(0, {}).feasible);
  spec.goal.configurations = {{0, {50, 10.3, std::numbers::pi}, feeder::Must::Unsupported, 3}};
  const feeder::FeederProblem with(spec);
  const feeder::FeederEvaluation evaluation = with.evaluate(0, {});
  REQUIRE(evaluation.violations.size() == 1);
  CHECK(evaluation.violations.front().by == evaluation.goals.front().lacking_mm);
  CHECK(with.score({0, {}}).violation == Approx(evaluation.goals.front().lacking_mm));
  CHECK(evaluation.poses.size() == without.evaluate(0, {}).poses.size());
}

TEST_CASE("least squares meet the goals of the shipped facet problem in a few evaluations") {
  const feeder::FeederProblem problem(read_problem_file(problem_path("inverse_facet")).feeder);
  const std::vector<Trial> trials = run_task(problem, fit_of(problem, 4), kGoOn).trials;
  REQUIRE_FALSE(trials.front().score.feasible);
  CHECK(std::any_of(trials.begin(), trials.end(), [](const Trial& trial) { return trial.score.feasible; }));
}

TEST_CASE("least squares find the tolerance of the balcony of the plate and only exact scores count") {
  const feeder::FeederProblem problem(read_problem_file(problem_path("plate_with_hole")).feeder);
  const SearchTask task = fit_of(problem, 12);
  const std::vector<Trial> trials = run_task(problem, task, kGoOn).trials,
                           again = run_task(problem, task, kGoOn).trials;
  REQUIRE(trials.size() == again.size());
  CHECK(trials.size() <= 12);
  double best = 0;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    CHECK(trials[i].candidate.values == again[i].candidate.values);
    CHECK(trials[i].score.objectives == problem.score(trials[i].candidate).objectives);
    if (trials[i].score.feasible) best = std::max(best, trials[i].score.objectives[1]);
  }
  CHECK_FALSE(trials.front().score.feasible);
  CHECK(best > 0.28);  // 0.2843 mm is the most that any search found
}
