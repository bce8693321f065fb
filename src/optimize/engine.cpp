#include "optimize/engine.hpp"

#include "optimize/executor.hpp"

namespace formotion {

std::vector<TaskResult> LocalEngine::run(const std::vector<SearchTask>& tasks, const std::atomic<bool>& stop) {
  std::vector<TaskResult> results(tasks.size());
  run_parallel(static_cast<int>(tasks.size()), threads_, [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    results[at] = run_task(problem_, tasks[at], stop);
  });
  return results;
}

}  // namespace formotion
