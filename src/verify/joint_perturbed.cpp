// Assemblies whose fixed shapes are made a little wrong: every corner somewhere else.
#include <algorithm>

#include "applications/assembly/judge.hpp"
#include "io/assembly_json.hpp"
#include "io/problem_reader.hpp"
#include "verify/checks.hpp"
#include "verify/perturbation.hpp"

namespace formotion {
namespace {

using namespace assembly;

constexpr double kDefault_mm = 0.02;                    // what shapes are off by where the problem does not say
constexpr std::uint64_t kPurpose = 0x6a6f696e746f6666;  // of random numbers: perturbed joints

// The problem of this one design, without uncertainties of its own.
AssemblySpec spec_of(const TestedJoint& joint, DesignSpec design) {
  AssemblySpec spec = joint.spec();
  spec.designs = {std::move(design)};
  spec.uncertainty = {};
  spec.robust = false;
  return spec;
}

}  // namespace

Check check_perturbed(const TestedJoint& joint, const VerifyOptions& options) {
  Check check{"perturbed"};
  check.unit = "perturbations";
  if (!joint.evaluation.feasible) {
    check.note = "the design is not feasible as drawn";
    return check;
  }
  // The part's own errors count as the fixed shapes', as in the worst case.
  const ShapeUncertainty& u = joint.spec().uncertainty;
  const double given_mm = u.outline_mm + u.feature_mm, most_mm = given_mm > 0 ? given_mm : kDefault_mm;
  const std::vector<Loop> shapes = joint.problem.joint(joint.topology, joint.values).fixed_mm;
  double least = 1;
  int failures = 0;
  for (int k = 0; k < options.perturbations; ++k) {
    RandomStream random(options.seed, kPurpose ^ static_cast<std::uint64_t>(joint.stored.number),
                        static_cast<std::uint64_t>(k));
    DesignSpec design = joint.problem.literal_design(joint.topology, joint.values);
    design.fixed_mm.clear();
    for (const Loop& shape : shapes) design.fixed_mm.push_back(literal_loop(perturbed(shape, most_mm, random)));
    const AssemblySpec spec = spec_of(joint, design);
    if (!defects(spec, 0, joint.values).empty()) {
      ++check.skipped;
      continue;
    }
    ++check.count;
    AssemblyEvaluation found = judge(spec, 0, joint.values, false).evaluation;
    // As evaluate will say it.
    if (!found.feasible) found = judge(spec, 0, joint.values, true).evaluation;
    least = std::min(least, found.metrics.success_fraction);
    if (found.feasible) continue;
    ++failures;
    if (!check.holds) continue;
    nlohmann::ordered_json member = shapes_json(design);
    member["values"] = values_json(joint.problem, joint.topology, joint.values);
    check.design = std::move(member);
    check.fail("perturbation " + std::to_string(k + 1) + " (corners off by up to " + number_text(most_mm) +
               " mm): " + found.violations.front().what);
  }
  if (check.count > 0) {
    check.worst = least;
    check.worst_of = "of the box assembles at least, with corners off by up to " + number_text(most_mm) + " mm";
  }
  if (given_mm <= 0) check.note = "the problem does not say what shapes may be off by";
  if (failures > 1) check.failure += " (" + std::to_string(failures) + " of " + std::to_string(check.count) + " fail)";
  return check;
}

}  // namespace formotion
