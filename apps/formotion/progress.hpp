// Progress of a run on stderr: one line that renews itself on a terminal, plain lines elsewhere, or JSON lines.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "optimize/run_state.hpp"

namespace formotion {

class Progress {
 public:
  Progress(const Problem& problem, std::int64_t budget, const RunState& state, bool json);
  ~Progress();
  void show(const RunState& state);
  void say(const std::string& text);  // a line that stays

 private:
  using Clock = std::chrono::steady_clock;
  void end_line();

  std::vector<Objective> objectives_;
  std::int64_t budget_, before_;
  bool json_, terminal_, open_line_ = false;
  Clock::time_point begin_ = Clock::now(), last_{};
};

}  // namespace formotion
