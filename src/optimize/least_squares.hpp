// Ceres on a problem's residuals: fits the pieces that decide at a candidate, looks again which pieces decide there,
// and goes on as long as the scores say that candidates become better.
#pragma once

#include <functional>

#include "optimize/search_task.hpp"

namespace formotion {

// A run from the task's start, or the user's guess. score: exactly, of one candidate; it is asked at most
// task.evaluations times. What Ceres says counts for nothing: a step is kept if the merit of its end is less, else it
// is halved. Where nothing is missing, the merit's objective is raised step by step. Problems without residuals get
// their start scored.
void fit(const Problem& problem, const SearchTask& task, const std::function<Score(const Candidate&)>& score);

}  // namespace formotion
