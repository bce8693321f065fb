// Where the tasks of a batch run. Results do not depend on it.
#pragma once

#include <atomic>
#include <vector>

#include "optimize/search_task.hpp"

namespace formotion {

class Engine {
 public:
  virtual ~Engine() = default;
  // The results in the order of the tasks. Throws SearchStopped when told to stop.
  virtual std::vector<TaskResult> run(const std::vector<SearchTask>& tasks, const std::atomic<bool>& stop) = 0;
};

// The threads of this process.
class LocalEngine final : public Engine {
 public:
  LocalEngine(const Problem& problem, int threads) : problem_(problem), threads_(threads) {}  // 0: one per core
  std::vector<TaskResult> run(const std::vector<SearchTask>& tasks, const std::atomic<bool>& stop) override;

 private:
  const Problem& problem_;
  int threads_;
};

}  // namespace formotion
