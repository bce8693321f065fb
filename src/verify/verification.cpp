#include "verify/verification.hpp"

#include <sstream>

#include "verify/checks.hpp"

namespace formotion {

Verification verify_design(const feeder::FeederProblem& problem, const Evaluated& stored, bool same_program,
                           const VerifyOptions& options) {
  const TestedDesign design = tested_design(problem, stored);
  Verification result{design_id(stored)};
  result.checks.push_back(check_repeatable(design, same_program));
  if (design.layout.invalid.empty()) {  // else there is no track
    result.checks.push_back(check_exact(design));
    result.checks.push_back(check_drawn(design));
    result.checks.push_back(check_finer(design));
    result.checks.push_back(check_perturbed(design, options));
    result.checks.push_back(check_starts(design));
  }
  for (const Check& check : result.checks) result.holds = result.holds && check.holds;
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
