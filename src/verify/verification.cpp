#include "verify/verification.hpp"

#include <memory>
#include <sstream>

#include "verify/checks.hpp"

namespace formotion {

namespace {

template <class ProblemOfKind, class Spec>
Verifier verifier(const Spec& spec) {
  const auto problem = std::make_shared<const ProblemOfKind>(spec);
  return [problem](const Evaluated& stored, bool same_program, const VerifyOptions& options) {
    return verify_design(*problem, stored, same_program, options);
  };
}

}  // namespace

Verifier verifier_of(const ProblemFile& file) {
  return file.assembly ? verifier<assembly::AssemblyProblem>(*file.assembly)
         : file.nest   ? verifier<nest::NestProblem>(*file.nest)
                       : verifier<feeder::FeederProblem>(file.feeder);
}

Verification verify_design(const feeder::FeederProblem& problem, const Evaluated& stored, bool same_program,
                           const VerifyOptions& options) {
  const TestedDesign design = tested_design(problem, stored);
  Verification result{design_id(stored)};
  result.add(check_repeatable(problem, stored, same_program));
  if (!design.layout.invalid.empty()) return result;  // there is no track
  result.add(check_exact(design));
  result.add(check_drawn(design));
  result.add(check_finer(design));
  result.add(check_perturbed(design, options));
  result.add(check_starts(design));
  return result;
}

Verification verify_design(const assembly::AssemblyProblem& problem, const Evaluated& stored, bool same_program,
                           const VerifyOptions& options) {
  const TestedJoint joint = tested_joint(problem, stored);
  Verification result{design_id(stored)};
  result.add(check_repeatable(problem, stored, same_program));
  if (joint.evaluation.regions.empty()) return result;  // shapes that are not valid
  result.add(check_drawn(joint));
  result.add(check_finer(joint));
  result.add(check_perturbed(joint, options));
  result.add(check_starts(joint, options));
  return result;
}

Verification verify_design(const nest::NestProblem& problem, const Evaluated& stored, bool same_program,
                           const VerifyOptions& options) {
  const int topology = stored.candidate.topology;
  std::vector<double> values = all_values(problem, stored.candidate);
  nest::NestEvaluation evaluation = problem.evaluate(topology, values);
  const TestedNest tested{problem, stored, topology, std::move(values), std::move(evaluation)};
  Verification result{design_id(stored)};
  result.add(check_repeatable(problem, stored, same_program));
  if (tested.evaluation.rests.empty()) return result;  // shapes that are not valid, or that hold nothing
  result.add(check_drawn(tested));
  result.add(check_finer(tested));
  result.add(check_perturbed(tested, options));
  if (problem.spec().environment.table) result.add(check_shaken(tested, options));
  return result;
}

std::string says(const Check& check) {
  if (!check.holds) return check.failure;
  std::ostringstream out;
  if (check.count > 0) {
    out << check.count << " " << check.unit;
    if (check.skipped > 0) out << ", " << check.skipped << " skipped";
    if (check.worst) out << "; " << *check.worst << " " << check.worst_of;
  }
  if (!check.note.empty()) out << (check.count > 0 ? "; " : "") << check.note;
  return out.str();
}

}  // namespace formotion
