// What composed tracks ask of single stages, and why some topologies get no track.
#pragma once

#include <string>

#include "optimize/composition.hpp"

namespace formotion {

struct Demand {
  int kind = 0;
  StateSet keep = 0, lose = 0;
  auto operator<=>(const Demand&) const = default;
};

// Of every stage of a track; every lost state is asked of the passive stage that loses it most widely.
std::vector<Demand> demands_of(const StagedProblem& problem, const Composed& track,
                               std::span<const StageChoice> choices, std::span<const StageRecord> stages);

// Why no composition of the choices serves a topology: one sentence.
std::string why_unreached(const StagedProblem& problem, int topology, std::span<const StageChoice> choices);

}  // namespace formotion
