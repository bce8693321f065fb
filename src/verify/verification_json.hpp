// What a verification says, for machines, for the run's store and for people.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "verify/verification.hpp"

namespace formotion {

// {"id", "holds", "program", "perturbations", "seed", "checks": [{"name", "holds", "says", ...}]}
nlohmann::ordered_json verification_json(const Verification& verification, const VerifyOptions& options,
                                         const std::string& program_version);
// "d123 holds: 6 checks, 64 perturbations, ...", or a line for each check that fails.
std::string verification_text(const Verification& verification);

}  // namespace formotion
