// The single checks of a verification.
#pragma once

#include "verify/tested_design.hpp"
#include "verify/verification.hpp"

namespace formotion {

Check check_exact(const TestedDesign& design);
Check check_drawn(const TestedDesign& design);
Check check_finer(const TestedDesign& design);
Check check_perturbed(const TestedDesign& design, const VerifyOptions& options);
Check check_starts(const TestedDesign& design);
Check check_repeatable(const TestedDesign& design, bool same_program);

}  // namespace formotion
