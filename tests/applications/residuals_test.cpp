// The derivatives of residuals against differences of what the exact analysis says.
#include "applications/feeder/residuals.hpp"

#include <catch2/catch.hpp>
#include <numeric>

#include "analysis/geometry/boolean.hpp"
#include "analysis/geometry/offset.hpp"
#include "applications/feeder/active_search.hpp"
#include "applications/feeder/expressions.hpp"
#include "applications/feeder/inverse_goals.hpp"
#include "witness/feeder_specs.hpp"

using namespace formotion;
using namespace formotion::witness;

namespace {

constexpr double kStep = 1e-5;
constexpr double kBend = 2e-3;  // of slopes to both sides, beyond which something else decides on one of them

// Every number of the features, and of the part where it is wanted, gets a variable of its own that is added to it.
void add_variables(feeder::FeederSpec& spec, bool of_part) {
  const auto vary = [&](Affine& expression) {
    const int index = static_cast<int>(spec.variables.size());
    spec.variables.push_back({"v" + std::to_string(index), -1, 1, 0});
    expression.terms = {{index, 1.0}};
  };
  for (feeder::FeatureSpec& feature : spec.designs.front()) feeder::Expressions::each(feature, vary);
  for (feeder::AspectSpec& aspect : spec.part.aspects) {
    if (of_part) feeder::Expressions::loop(aspect.outline_mm, vary);
  }
}

struct Case {
  feeder::FeederSpec spec;
  explicit Case(feeder::FeederSpec given) : spec(std::move(given)) {}

  template <class Use>
  auto with(const std::vector<double>& values, const Use& use) const {
    const feeder::PartModel part = feeder::part_model(spec.part, spec.environment, values);
    const std::vector<Violation> defects = feeder::defects_of(part);
    const feeder::DesignCase design{spec, spec.designs.front(), part, defects, values};
    return use(design, feeder::lay_out(design.features, spec.environment, spec.manufacture, part.diameter_mm, values));
  }
  using Violation = feeder::Violation;
};

struct Count {
  int traced = 0, untraced = 0, compared = 0, bent = 0;
};

// The slope of every residual along a random direction; exact(values) gives the residuals by the exact analysis.
template <class Exact>
void compare(const feeder::FeederSpec& spec, const SmoothPieces& pieces, const Exact& exact, Random& random,
             Count& count) {
  const std::size_t n = spec.variables.size(), m = static_cast<std::size_t>(pieces.residuals());
  std::vector<double> direction(n), zeros(n, 0.0), residuals(m), jacobian(m * n);
  for (double& d : direction) d = uniform(random, -1, 1);
  REQUIRE(pieces.evaluate(zeros, residuals.data(), jacobian.data()));
  const auto moved = [&](double by) {
    std::vector<double> values = zeros;
    for (std::size_t i = 0; i < n; ++i) values[i] += by * direction[i];
    return values;
  };
  const std::vector<std::optional<double>> here = exact(zeros), ahead = exact(moved(kStep)),
                                           behind = exact(moved(-kStep));
  for (std::size_t k = 0; k < m; ++k) {
    if (!here[k] || k >= ahead.size() || k >= behind.size() || !ahead[k] || !behind[k]) continue;
    CHECK(residuals[k] == Approx(*here[k]).margin(2e-6));
    const double forwards = (*ahead[k] - *here[k]) / kStep, backwards = (*here[k] - *behind[k]) / kStep;
    if (std::abs(forwards - backwards) > kBend) {
      ++count.bent;
      continue;
    }
    double slope = 0;
    for (std::size_t i = 0; i < n; ++i) slope += jacobian[k * n + i] * direction[i];
    CAPTURE(k, forwards, backwards);
    CHECK(slope == Approx(0.5 * (forwards + backwards)).epsilon(1e-4).margin(kBend));
    ++count.compared;
  }
}

feeder::FeatureSpec random_obstacle(Random& random) {
  switch (below(random, 3)) {
    case 0:
      return {feeder::Fence{literal(placed(random_polygon(random, 20), 0, {0, uniform(random, 0, 25)}).outer)}, {}};
    case 1:
      return {feeder::Pin{literal(uniform(random, -10, 10)), literal(uniform(random, 3, 25)),
                          literal(uniform(random, 2, 8))},
              {}};
    default:
      return {feeder::WallProfile{literal(Loop{{-15, 0}, {uniform(random, -10, 0), uniform(random, -5, 9)}, {15, 0}})},
              {}};
  }
}

constexpr double kFar_mm = 1000;  // asked for, so that every goal lacks something

}  // namespace

TEST_CASE(
    "clearance of a configuration: derivatives by all numbers of obstacles and part are those of the exact clearance") {
  Random random(11);
  Count count;
  for (int round = 0; round < 150; ++round) {
    feeder::FeederSpec spec = feeder_spec(flat_part(random_polygon(random, 12).outer, true), {}, 60);
    spec.designs.front() = {at(random_obstacle(random), 0), at(random_obstacle(random), uniform(random, 10, 40))};
    add_variables(spec, round % 2 == 0);
    for (int i = 0; i < 4; ++i) {
      const Configuration q{uniform(random, -20, 50), uniform(random, 0, 30), uniform(random, -3, 3)};
      spec.goal.configurations.push_back(
          {below(random, 2), q, i % 2 ? feeder::Must::Free : feeder::Must::Blocked, kFar_mm});
    }
    const feeder::FeederProblem problem(spec);
    const Case exact_case(spec);
    // One goal at a time, so that the residual's place is known.
    for (std::size_t g = 0; g < 4; ++g) {
      feeder::FeederSpec one = spec;
      one.goal.configurations = {spec.goal.configurations[g]};
      const feeder::FeederProblem alone(one);
      const auto pieces = alone.smooth()->pieces({0, std::vector<double>(spec.variables.size(), 0.0)}, {});
      ++(pieces ? count.traced : count.untraced);
      if (!pieces) continue;
      const Case of_one(one);
      compare(
          one, *pieces,
          [&](const std::vector<double>& values) {
            return of_one.with(values, [&](const feeder::DesignCase& design, const feeder::Layout& layout) {
              std::vector<std::optional<double>> lacking;
              for (const feeder::GoalAnswer& answer : feeder::goal_answers(design, layout))
                lacking.push_back(answer.got_mm && std::isfinite(*answer.got_mm)
                                      ? std::optional(answer.lacking_mm + 1e-3)
                                      : std::nullopt);
              return lacking;
            });
          },
          random, count);
    }
  }
  INFO("traced " << count.traced << " untraced " << count.untraced << " compared " << count.compared << " bent "
                 << count.bent);
  CHECK(count.untraced * 10 <= count.traced);
  CHECK(count.bent * 20 <= count.compared);
  CHECK(count.compared > 400);
}

TEST_CASE("support of a configuration: derivatives by all numbers of voids and part are those of the exact margin") {
  Random random(12);
  Count count;
  for (int round = 0; round < 400; ++round) {
    feeder::FeederSpec spec = random_feeder(random);
    add_variables(spec, round % 2 == 0);
    const Configuration q{uniform(random, -10, 60), uniform(random, 3, 25), uniform(random, -3, 3)};
    const int aspect = below(random, static_cast<int>(spec.part.aspects.size()));
    spec.goal.configurations = {{aspect, q, round % 2 ? feeder::Must::Supported : feeder::Must::Unsupported, kFar_mm}};
    const Case one(spec);
    const std::vector<double> zeros(spec.variables.size(), 0.0);
    const bool asked = one.with(zeros, [&](const feeder::DesignCase& design, const feeder::Layout& layout) {
      return layout.invalid.empty() && feeder::goal_answers(design, layout).front().got_mm.has_value();
    });
    if (!asked) continue;
    const feeder::FeederProblem problem(spec);
    const auto pieces = problem.smooth()->pieces({0, zeros}, {});
    ++(pieces ? count.traced : count.untraced);
    if (!pieces) continue;
    compare(
        spec, *pieces,
        [&](const std::vector<double>& values) {
          return one.with(values, [&](const feeder::DesignCase& design, const feeder::Layout& layout) {
            const feeder::GoalAnswer answer = feeder::goal_answers(design, layout).front();
            return std::vector<std::optional<double>>{answer.got_mm ? std::optional(answer.lacking_mm + 1e-3)
                                                                    : std::nullopt};
          });
        },
        random, count);
  }
  INFO("traced " << count.traced << " untraced " << count.untraced << " compared " << count.compared << " bent "
                 << count.bent);
  CHECK(count.untraced * 10 <= count.traced);
  CHECK(count.bent * 10 <= count.compared);
  CHECK(count.compared > 150);
}

TEST_CASE("least margins of travels past voids that are off: derivatives are those of the exact sweep") {
  Random random(13);
  Count count;
  int poses = 0;
  for (int round = 0; round < 120; ++round) {
    feeder::FeederSpec spec = random_feeder(random);
    add_variables(spec, round % 3 == 0);
    const Case one(spec);
    const std::vector<double> zeros(spec.variables.size(), 0.0);
    const double e = uniform(random, 0, 0.6);
    const auto residuals_at = [&](const std::vector<double>& values) {
      return one.with(values, [&](const feeder::DesignCase& design, const feeder::Layout& layout) {
        if (!layout.invalid.empty() || !design.part_defects.empty()) return std::vector<feeder::Residual>();
        std::vector<bool> kept(design.part.poses.size());
        for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = i % 2 == 0;
        if (values == zeros) poses += static_cast<int>(kept.size());
        return feeder::tolerance_residuals(design, layout, kept, e);
      });
    };
    std::vector<feeder::Residual> here = residuals_at(zeros);
    if (here.empty()) continue;
    for (feeder::Residual& residual : here) residual.wanted_mm = kFar_mm;
    count.traced += static_cast<int>(here.size());
    std::vector<int> used(zeros.size());
    std::iota(used.begin(), used.end(), 0);
    const double diameter = one.with(
        zeros, [](const feeder::DesignCase& design, const feeder::Layout&) { return design.part.diameter_mm; });
    const auto pieces = feeder::as_pieces(spec, 0, zeros, used, here, diameter);
    compare(
        spec, *pieces,
        [&](const std::vector<double>& values) {
          std::vector<std::optional<double>> lacking;
          for (const feeder::Residual& residual : residuals_at(values)) lacking.push_back(kFar_mm - residual.got_mm);
          if (lacking.size() != here.size()) lacking.assign(here.size(), std::nullopt);
          return lacking;
        },
        random, count);
  }
  INFO("poses " << poses << " traced " << count.traced << " compared " << count.compared << " bent " << count.bent);
  CHECK(count.compared > 150);
}

TEST_CASE("nine in ten travels that voids decide have a piece") {
  Random random(14);
  OffsetOptions fine;
  fine.arc_step_rad = 0.05;
  int decided = 0, traced = 0;
  for (int round = 0; round < 150; ++round) {
    const feeder::FeederSpec spec = random_feeder(random);
    const feeder::DesignSpec& design = spec.designs.front();
    if (std::any_of(design.begin(), design.end(), [](const auto& f) { return feeder::type_name(f) == "dish-out"; }))
      continue;  // arcs have none
    const std::vector<double> values;
    const feeder::PartModel part = feeder::part_model(spec.part, spec.environment, values);
    const feeder::Layout layout = feeder::lay_out(design, spec.environment, spec.manufacture, part.diameter_mm, values);
    const double e = uniform(random, 0, 0.6);
    for (const feeder::VoidGroup& group : feeder::grouped(layout, part.longest_mm + 2.2 * e)) {
      for (const double grow : {e, -e}) {
        const std::vector<Loop> loops = offset(group.loops, grow, fine);
        if (loops.empty()) continue;
        const VoidOutline outline = VoidOutline::of(loops);
        for (const feeder::PoseModel& pose : part.poses) {
          const LeastMargin least = least_margin({pose.travelling, outline});
          if (least.margin_mm >= pose.travelling.plain_margin_mm - 1e-9) continue;
          ++decided;
          const auto aspect = pose.stable.aspect;
          const auto shapes = feeder::traced_shapes<double>(spec, design, aspect, part.diameter_mm, values);
          const feeder::ActiveSearch search(shapes, spec.environment.track_width_mm);
          const auto& shape = part.shapes[static_cast<std::size_t>(aspect)];
          traced += search.travel(pose, shape, spec.environment, loops, grow, least).has_value();
        }
      }
    }
  }
  CAPTURE(decided, traced);
  CHECK(decided > 500);
  CHECK(traced * 10 >= decided * 9);
}
