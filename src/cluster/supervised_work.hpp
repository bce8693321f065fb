// Tasks run in a child process, so that a candidate that crashes or never ends is named and does not take its worker
// along.
#pragma once

#include <functional>
#include <memory>

#include "optimize/task_codec.hpp"

namespace formotion {

// Runs the order's tasks in a child of this process, which must have no other threads. The problem is made in the
// child. Nothing is thrown for what happens there: the report says it. What ends the child becomes an incident: Crash
// for a fatal signal of its own, TimeOut for a candidate that takes longer than it may, Lost for a signal from outside.
WorkReport supervised(const WorkOrder& order, const std::function<std::unique_ptr<Problem>()>& make_problem);

}  // namespace formotion
