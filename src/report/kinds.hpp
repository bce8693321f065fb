// The kinds that there are.
#pragma once

#include "report/kind.hpp"

namespace formotion {

std::unique_ptr<Kind> feeder_kind(ProblemFile file);
std::unique_ptr<Kind> assembly_kind(ProblemFile file);

}  // namespace formotion
