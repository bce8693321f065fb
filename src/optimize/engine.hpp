// Where the tasks of a batch run. Results do not depend on it.
#pragma once

#include <atomic>
#include <stdexcept>
#include <vector>

#include "optimize/search_task.hpp"

namespace formotion {

// The engine cannot go on; the text is one line for the user. What was committed before is safe.
struct EngineError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Engine {
 public:
  virtual ~Engine() = default;
  // The results in the order of the tasks. Throws SearchStopped when told to stop, EngineError where it cannot go on.
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
