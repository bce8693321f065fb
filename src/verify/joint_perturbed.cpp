// Assemblies whose fixed shapes are made a little wrong: every corner somewhere else.
#include "applications/assembly/judge.hpp"
#include "io/assembly_json.hpp"
#include "io/problem_reader.hpp"
#include "verify/checks.hpp"
#include "verify/perturbed_shapes.hpp"

namespace formotion {
namespace {

using namespace assembly;

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
  if (!joint.evaluation.feasible) {
    Check check{"perturbed"};
    check.note = "the design is not feasible as drawn";
    return check;
  }
  const auto judged = [&](const std::vector<Loop>& shapes, double) {
    PerturbedMember member;
    DesignSpec design = joint.problem.literal_design(joint.topology, joint.values);
    design.fixed_mm.clear();
    for (const Loop& shape : shapes) design.fixed_mm.push_back(literal_loop(shape));
    const AssemblySpec spec = spec_of(joint, design);
    member.usable = defects(spec, 0, joint.values).empty();
    if (!member.usable) return member;
    AssemblyEvaluation found = judge(spec, 0, joint.values, false).evaluation;
    // As evaluate will say it.
    if (!found.feasible) found = judge(spec, 0, joint.values, true).evaluation;
    member.figure = found.metrics.success_fraction;
    member.feasible = found.feasible;
    if (member.feasible) return member;
    member.why = found.violations.front().what;
    member.design = shapes_json(design);
    member.design["values"] = values_json(joint.problem, joint.topology, joint.values);
    return member;
  };
  return check_perturbed_shapes(joint.problem.joint(joint.topology, joint.values).fixed_mm, joint.spec().uncertainty,
                                kPurpose ^ static_cast<std::uint64_t>(joint.stored.number), "of the box assembles",
                                options, judged);
}

}  // namespace formotion
