// A toy that does something bad at one candidate: what the engine's tests send to workers.
#pragma once

#include <unistd.h>

#include <csignal>
#include <stdexcept>
#include <string>

#include "optimize/toy_problem.hpp"

namespace formotion {

inline const Candidate kTrap{0, {9.5}};

class TrappedProblem final : public Problem {
 public:
  explicit TrappedProblem(std::string act) : act_(std::move(act)) {}
  std::span<const Variable> variables() const override { return toy_.variables(); }
  std::span<const Topology> topologies() const override { return toy_.topologies(); }
  std::span<const Objective> objectives() const override { return toy_.objectives(); }
  Score score(const Candidate& candidate, Memory*) const override {
    if (candidate.topology == kTrap.topology && candidate.values == kTrap.values) act();
    return toy_.score(candidate);
  }

 private:
  void act() const {
    if (act_ == "crash") ::raise(SIGSEGV);
    if (act_ == "kill") ::kill(::getpid(), SIGKILL);
    if (act_ == "throw") throw std::runtime_error("a bug");
    while (act_ == "hang") ::pause();
  }
  ToyProblem toy_;
  std::string act_;
};

}  // namespace formotion
