// Worker processes on this machine.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <string>
#include <vector>

namespace formotion {

class LocalWorkers {
 public:
  // Every worker runs this command (found on PATH) in a process group of its own.
  LocalWorkers(int count, std::vector<std::string> command);
  LocalWorkers(const LocalWorkers&) = delete;
  LocalWorkers& operator=(const LocalWorkers&) = delete;
  ~LocalWorkers();  // ends them

  // Starts those anew that have ended, one at most a second. Throws EngineError if they cannot be started at all.
  void look_after();

 private:
  void start(pid_t& worker);

  std::vector<std::string> command_;
  std::vector<pid_t> workers_;  // 0: none
  std::chrono::steady_clock::time_point last_start_;
};

}  // namespace formotion
