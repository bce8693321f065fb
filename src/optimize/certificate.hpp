// Proofs that no track of a catalogue has a tolerance above a bound (docs/composition.md has the argument).
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "optimize/stage_choices.hpp"

namespace formotion {

// What a proof can speak of.
struct ProofScope {
  std::vector<int> topologies;          // whose kinds all allow it
  std::vector<std::string> hindrances;  // of the other ones: "cutout(3) has 6 free variables"
};
ProofScope proof_scope(const StagedProblem& problem, int topologies);

struct ProofWork {
  std::int64_t done = 0, limit = 0;  // in sweeps
  bool spent() const { return done >= limit; }
};

// Whether it is proved that no design of these topologies has a tolerance of tolerance_mm or more; false also where the
// work does not suffice. Deterministic. Throws SearchStopped when told to stop.
bool is_excluded(const StagedProblem& problem, const std::vector<int>& topologies, double tolerance_mm, ProofWork& work,
                 const std::atomic<bool>& stop);

// The least tolerance above best_mm that it can exclude within the work, looking ever nearer.
std::optional<double> least_excluded(const StagedProblem& problem, const std::vector<int>& topologies, double best_mm,
                                     ProofWork& work, const std::atomic<bool>& stop);

}  // namespace formotion
