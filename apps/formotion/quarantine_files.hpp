// What went wrong in a run, as files that repeat it: FOLDER/quarantine.
#pragma once

#include <string>

#include "optimize/quarantine.hpp"
#include "optimize/run_state.hpp"
#include "report/kind.hpp"

namespace formotion {

// A design file for every candidate that crashed, took too long or threw, and list.json with the commands that repeat
// them. No folder where nothing went wrong. Throws StoreError.
void write_quarantine(const std::string& folder, const Kind& kind, const Quarantine& quarantine, const RunState& state);

}  // namespace formotion
