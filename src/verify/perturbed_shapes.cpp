#include "verify/perturbed_shapes.hpp"

#include <algorithm>

#include "optimize/random_stream.hpp"
#include "verify/perturbation.hpp"
#include "verify/tested_joint.hpp"

namespace formotion {

Check check_perturbed_shapes(
    const std::vector<Loop>& shapes, const ShapeUncertainty& uncertainty, std::uint64_t stream,
    const std::string& figure, const VerifyOptions& options,
    const std::function<PerturbedMember(const std::vector<Loop>& shapes, double most_mm)>& judged) {
  constexpr double kDefault_mm = 0.02;
  Check check{"perturbed"};
  check.unit = "perturbations";
  const double given_mm = uncertainty.outline_mm + uncertainty.feature_mm;
  const double most_mm = given_mm > 0 ? given_mm : kDefault_mm;
  int failures = 0;
  for (int k = 0; k < options.perturbations; ++k) {
    RandomStream random(options.seed, stream, static_cast<std::uint64_t>(k));
    std::vector<Loop> moved;
    for (const Loop& shape : shapes) moved.push_back(perturbed(shape, most_mm, random));
    PerturbedMember member = judged(moved, most_mm);
    if (!member.usable) {
      ++check.skipped;
      continue;
    }
    ++check.count;
    if (member.figure) check.worst = std::min(check.worst.value_or(*member.figure), *member.figure);
    if (member.feasible) continue;
    ++failures;
    if (!check.holds) continue;
    check.design = std::move(member.design);
    check.fail("perturbation " + std::to_string(k + 1) + " (corners off by up to " + number_text(most_mm) +
               " mm): " + member.why);
  }
  if (check.worst) check.worst_of = figure + " at least, with corners off by up to " + number_text(most_mm) + " mm";
  if (given_mm <= 0) check.note = "the problem does not say what shapes may be off by";
  if (failures > 1) check.failure += " (" + std::to_string(failures) + " of " + std::to_string(check.count) + " fail)";
  return check;
}

}  // namespace formotion
