// What went wrong in a run, as files that repeat it: FOLDER/quarantine.
#pragma once

#include <string>

#include "applications/feeder/feeder_problem.hpp"
#include "optimize/quarantine.hpp"
#include "optimize/run_state.hpp"

namespace formotion {

// A design file for every candidate that crashed, took too long or threw, and list.json with the commands that repeat
// them. No folder where nothing went wrong. Throws StoreError.
void write_quarantine(const std::string& folder, const feeder::FeederProblem& problem, const Quarantine& quarantine,
                      const RunState& state);

}  // namespace formotion
