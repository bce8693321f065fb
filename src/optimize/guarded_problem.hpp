// A problem with its scoring watched: what is quarantined is not scored, what is being scored is marked.
#pragma once

#include "optimize/crash_marks.hpp"
#include "optimize/quarantine.hpp"
#include "problem/smooth_problem.hpp"
#include "problem/staged_problem.hpp"

namespace formotion {

class GuardedProblem final : public Problem {
 public:
  // All must outlive it; marks may be null. What is quarantined fails as its incident says: a pure rule, so whoever
  // scores with the same quarantine gets the same scores.
  GuardedProblem(const Problem& problem, const Quarantine& quarantine, CrashMarks* marks);
  ~GuardedProblem() override;

  std::span<const Variable> variables() const override { return problem_.variables(); }
  std::span<const Topology> topologies() const override { return problem_.topologies(); }
  std::span<const Objective> objectives() const override { return problem_.objectives(); }
  Score score(const Candidate& candidate, Memory* memory) const override;
  std::unique_ptr<Memory> memory() const override { return problem_.memory(); }
  const StagedProblem* staged() const override;
  const SmoothProblem* smooth() const override;

 private:
  const Problem& problem_;
  const Quarantine& quarantine_;
  CrashMarks* marks_;
  std::unique_ptr<StagedProblem> staged_;
  std::unique_ptr<SmoothProblem> smooth_;
};

}  // namespace formotion
