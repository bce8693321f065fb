#include "verify/verification.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>

#include "optimize/random_stream.hpp"
#include "verify/perturbation.hpp"
#include "verify/settling.hpp"
#include "verify/tested_design.hpp"
#include "witness/feeder_specs.hpp"

using namespace formotion;

namespace {

// A design of a problem, scored.
struct Case {
  feeder::FeederProblem problem;
  Evaluated stored = {};
  explicit Case(feeder::FeederSpec spec) : problem(std::move(spec)) {
    stored.number = 7;
    stored.score = problem.score(stored.candidate);
  }
  double& claimed_tolerance() {
    const auto objectives = problem.objectives();
    const auto found = std::find_if(objectives.begin(), objectives.end(),
                                    [](const Objective& objective) { return objective.name == "tolerance_mm"; });
    REQUIRE(found != objectives.end());
    return stored.score.objectives[static_cast<std::size_t>(found - objectives.begin())];
  }
};

// The el-shaped part past one cut-out that lets one of its poses through, with a tolerance of 0.06 mm.
std::unique_ptr<Case> robust_case() {
  feeder::FeederSpec spec =
      witness::feeder_spec(witness::flat_part(witness::el_outline(), true),
                           {witness::cutout({{54.868, 15.189}, {5.56, 0.126}, {24.136, 38.458}})}, 40);
  spec.environment.tilt_rad = 5 * std::acos(-1.0) / 180;
  auto found = std::make_unique<Case>(std::move(spec));
  REQUIRE(found->stored.score.feasible);
  REQUIRE(found->claimed_tolerance() > 0.05);
  return found;
}

const Check& named(const Verification& verification, const std::string& name) {
  return *std::find_if(verification.checks.begin(), verification.checks.end(),
                       [&](const Check& check) { return check.name == name; });
}

}  // namespace

TEST_CASE("a feasible design as it was scored holds, in all its checks") {
  const auto sound = robust_case();
  const Verification verification = verify_design(sound->problem, sound->stored, true, {16, 1});
  for (const Check& check : verification.checks) {
    CAPTURE(check.name, check.failure);
    CHECK(check.holds);
    CHECK(check.count > 0);
  }
  CHECK(verification.holds);
  CHECK(verification.checks.size() == 6);
}

TEST_CASE("a claimed tolerance twice the true one fails, perturbed, finer and by its bits") {
  const auto boastful = robust_case();
  boastful->claimed_tolerance() *= 2;
  const Verification verification = verify_design(boastful->problem, boastful->stored, true, {16, 1});
  CHECK_FALSE(verification.holds);
  CHECK_FALSE(named(verification, "perturbed").holds);
  CHECK(named(verification, "perturbed").design.has_value());
  CHECK_FALSE(named(verification, "finer").holds);
  CHECK_FALSE(named(verification, "repeatable").holds);
  CHECK(named(verification, "exact").holds);
}

TEST_CASE("one wrong bit of a stored score is noticed, but not where another program scored it") {
  const auto wrong = robust_case();
  wrong->stored.score.objectives[0] = std::nextafter(wrong->stored.score.objectives[0], 2);
  CHECK_FALSE(named(verify_design(wrong->problem, wrong->stored, true, {0, 1}), "repeatable").holds);
  CHECK(named(verify_design(wrong->problem, wrong->stored, false, {0, 1}), "repeatable").holds);
}

TEST_CASE("a verification is the same whenever it is made") {
  const auto sound = robust_case();
  const VerifyOptions options{8, 3};
  const Verification a = verify_design(sound->problem, sound->stored, true, options),
                     b = verify_design(sound->problem, sound->stored, true, options);
  for (std::size_t i = 0; i < a.checks.size(); ++i) {
    CHECK(says(a.checks[i]) == says(b.checks[i]));
    CHECK(a.checks[i].worst == b.checks[i].worst);
  }
}

TEST_CASE("no point of a perturbed void's edges is farther from where it was than the error") {
  const auto sound = robust_case();
  const feeder::Layout plain = tested_design(sound->problem, sound->stored).plain;
  const double most = 0.3;
  int moved = 0;
  for (std::uint64_t k = 0; k < 40; ++k) {
    RandomStream random(5, 1, k);
    const auto layout = perturbed(plain, sound->problem.spec().environment, {most, true}, random);
    if (!layout) continue;
    ++moved;
    for (std::size_t f = 0; f < plain.features.size(); ++f) {
      for (std::size_t v = 0; v < plain.features[f].voids.size(); ++v) {
        const Loop &before = plain.features[f].voids[v], &after = layout->features[f].voids[v];
        REQUIRE(before.size() == after.size());
        for (std::size_t i = 0; i < before.size(); ++i) CHECK((before[i] - after[i]).norm() <= most * (1 + 1e-12));
      }
    }
  }
  CHECK(moved > 20);
}

TEST_CASE("a rectangle settles on the side that its corner balances towards") {
  const Loop box{{-10, -5}, {10, -5}, {10, 5}, {-10, 5}};
  const double half_turn = std::acos(-1.0), corner = std::atan2(10.0, 5.0);  // balances at this turn from flat
  CHECK(*settled(box, 0, 0.1) == Approx(0).margin(1e-12));
  CHECK(*settled(box, 0, corner - 0.01) == Approx(0).margin(1e-12));
  CHECK(*settled(box, 0, corner + 0.01) == Approx(half_turn / 2));
  CHECK(*settled(box, 0, half_turn + 0.1) == Approx(half_turn));
  // With friction the line that must meet the edge leans by atan f, and so the balance moves.
  CHECK(*settled(box, 0.2, corner + std::atan(0.2) - 0.01) == Approx(0).margin(1e-12));
  CHECK(*settled(box, 0.2, corner + std::atan(0.2) + 0.01) == Approx(half_turn / 2));
}
