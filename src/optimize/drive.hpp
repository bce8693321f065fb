// A task's driver at work on a space, whatever is searched there.
#pragma once

#include <functional>

#include "optimize/design_space.hpp"
#include "optimize/search_task.hpp"

namespace formotion {

// Calls merit with the candidates that the task's driver wants to know: those listed, spread points, or what NLopt asks
// for. LeastSquares is none of these.
void drive(const DesignSpace& space, const SearchTask& task, const std::function<double(const Candidate&)>& merit);

}  // namespace formotion
