// Tracks composed of stages: along the kinds of a topology, the multi-objective shortest paths over sets of states.
#pragma once

#include <span>
#include <vector>

#include "optimize/stage_choices.hpp"

namespace formotion {

struct Composed {
  Composition composition;
  std::size_t goal = 0;              // the alternative that it serves
  std::vector<std::size_t> choices;  // of every stage, in the order of travel
};

// Of one topology and one alternative: none of two has at least as much tolerance on at most as much length with the
// same ends. Most tolerance first.
struct ComposedTracks {
  std::vector<Composed> tracks;  // by topology, then by alternative
  bool cut = false;              // there were more partial tracks than are followed up: better ones may be missing
};

struct CompositionLimits {
  std::size_t labels = 3000;             // partial tracks that are followed up after a stage
  std::size_t choices_alike = 24;        // choices of a kind that rely on the same
  std::size_t topologies_in_full = 200;  // with more of them, only tracks that no shorter one of others beats
};

// All topologies that compose. Exact for the choices given (docs/composition.md), within the limits.
ComposedTracks compose(const StagedProblem& problem, int topologies, std::span<const StageChoice> choices,
                       const CompositionLimits& limits = {});

// The candidate whose stages are the track's; variables of no stage keep their starting values.
Candidate candidate_of(const Problem& problem, const Composed& track, std::span<const StageChoice> choices,
                       std::span<const StageRecord> stages);

}  // namespace formotion
