// One driver's run on a kind of stage: which values keep and lose what, and with how much tolerance.
#pragma once

#include <atomic>
#include <optional>
#include <vector>

#include "optimize/search_task.hpp"

namespace formotion {

// What is wrong with a stage for an aim, positive; none if every state of the aim ends as wanted. Invalid stages rank
// behind all others; of the others the sum over states counts: how deep one to keep is lost, with what margin one to
// lose is kept, how much one that is stuck lacks.
// A stage that is not passive may keep a state as another one. Then a kept state is to leave as it does from
// `reference`, if there is one that keeps it; else any state will do.
std::optional<double> wrong(const StageResult& result, const StageAim& aim, bool passive, const StageResult* reference);

// What it tried, in that order, everything once. A pure function of problem and task, whose `stage` must be set. With a
// start, and a kind that is not passive, the start is the reference. Tolerances are asked for where the aim is met; by
// drivers other than SBPLX only where they can be the task's best.
std::vector<StageTrial> run_stage_task(const StagedProblem& problem, const SearchTask& task,
                                       const std::atomic<bool>& stop);

}  // namespace formotion
