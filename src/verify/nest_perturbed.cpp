// Nests made a little wrong: every corner somewhere else.
#include <algorithm>

#include "applications/nest/judge.hpp"
#include "io/nest_json.hpp"
#include "io/problem_reader.hpp"
#include "verify/checks.hpp"
#include "verify/perturbation.hpp"

namespace formotion {
namespace {

using namespace nest;

constexpr double kDefault_mm = 0.02;                    // what shapes are off by where the problem does not say
constexpr std::uint64_t kPurpose = 0x6e657374206f6666;  // of random numbers: perturbed nests

}  // namespace

Check check_perturbed(const TestedNest& tested, const VerifyOptions& options) {
  Check check{"perturbed"};
  check.unit = "perturbations";
  if (!tested.evaluation.feasible) {
    check.note = "the design is not feasible as drawn";
    return check;
  }
  // The part's own errors count as the nest's, as in the worst case.
  const ShapeUncertainty& u = tested.spec().uncertainty;
  const double given_mm = u.outline_mm + u.feature_mm, most_mm = given_mm > 0 ? given_mm : kDefault_mm;
  const std::vector<Loop> shapes = tested.problem.nest_mm(tested.topology, tested.values);
  NestSpec spec = tested.spec();
  spec.uncertainty = {};
  spec.robust = false;
  const bool is_pallet = spec.purpose == Purpose::Pallet;
  // The seat of a nest whose corners have moved is near the one that was asked for, not in it.
  double least = 1e300;
  for (int k = 0; k < options.perturbations; ++k) {
    RandomStream random(options.seed, kPurpose ^ static_cast<std::uint64_t>(tested.stored.number),
                        static_cast<std::uint64_t>(k));
    DesignSpec design;
    for (const Loop& shape : shapes) design.nest_mm.push_back(literal_loop(perturbed(shape, most_mm, random)));
    spec.designs = {design};
    const NestEvaluation found = judge(spec, 0, tested.values, false).evaluation;
    ++check.count;
    const auto& metric = is_pallet ? found.metrics.selectivity_mm : found.metrics.seated_fraction;
    if (metric) least = std::min(least, *metric);
    if (found.feasible) continue;
    if (check.holds) {
      check.design = shapes_json(design);
      (*check.design)["values"] = values_json(tested.problem, tested.topology, tested.values);
    }
    check.fail("perturbation " + std::to_string(k + 1) + ": " + found.violations.front().what);
  }
  if (check.count > 0 && least < 1e300) {
    check.worst = least;
    check.worst_of = is_pallet ? "mm of selectivity at least" : "of the placements seated at least";
  }
  if (given_mm <= 0) check.note = "the problem does not say what shapes may be off by: 0.02 mm";
  return check;
}

}  // namespace formotion
