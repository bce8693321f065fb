// What a search says at its end besides its designs: how topologies rank, what no composition reaches, what is proved.
#pragma once

#include <atomic>

#include "optimize/run_state.hpp"

namespace formotion {

// Pure in problem and state. Throws SearchStopped when told to stop.
std::vector<Finding> closing_findings(const Problem& problem, const RunState& state, const std::atomic<bool>& stop);

}  // namespace formotion
