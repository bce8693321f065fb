// The single checks of a verification.
#pragma once

#include "verify/tested_design.hpp"
#include "verify/tested_joint.hpp"
#include "verify/tested_nest.hpp"
#include "verify/verification.hpp"

namespace formotion {

Check check_repeatable(const Problem& problem, const Evaluated& stored, bool same_program);

// Feeders.
Check check_exact(const TestedDesign& design);
Check check_drawn(const TestedDesign& design);
Check check_finer(const TestedDesign& design);
Check check_perturbed(const TestedDesign& design, const VerifyOptions& options);
Check check_starts(const TestedDesign& design);

// Assemblies.
Check check_drawn(const TestedJoint& joint);
Check check_finer(const TestedJoint& joint);
Check check_perturbed(const TestedJoint& joint, const VerifyOptions& options);
Check check_starts(const TestedJoint& joint, const VerifyOptions& options);

// Fixtures and pallets.
Check check_drawn(const TestedNest& nest);
Check check_finer(const TestedNest& nest);
Check check_perturbed(const TestedNest& nest, const VerifyOptions& options);
Check check_shaken(const TestedNest& nest, const VerifyOptions& options);

}  // namespace formotion
