// What composition chooses from: stages that were tried, with the ends that a track may rely on.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "optimize/stage_pool.hpp"

namespace formotion {

using StateSet = std::uint64_t;  // bit i: state i
inline constexpr std::size_t kMostStates = 64;
inline bool has(StateSet set, int state) { return (set >> state & 1) != 0; }
inline StateSet only(int state) { return StateSet{1} << state; }
std::vector<int> members(StateSet set);  // ascending

// A tried stage, and one set of its ends that is relied on up to a tolerance.
struct StageChoice {
  std::size_t trial = 0;  // place in the list that it was made from
  int kind = 0;
  StateSet keeps = 0, loses = 0;  // relied on; in a guess one state may be in both
  StateSet fades = 0;             // lost, but not relied on
  StateSet blocks = 0;            // stuck
  std::vector<int> to;            // of a kind that is not passive: where every kept state leaves as
  double tolerance_mm = 0;
  double length_mm = 0;
};

// The choices whose tolerance was measured.
std::vector<StageChoice> measured_choices(const StagedProblem& problem, std::span<const StageRecord> stages);

// What tolerances may be hoped for before they are measured: the nominal margins, which no tolerance exceeds, but which
// a search around the trial may still widen. The ends of a trial are taken as relied on from the widest
// to the narrowest, one more in every choice. A state that ends against a wish counts with a negative tolerance, as
// wide as what is missing, so that the best choices tell what to search for next.
std::vector<StageChoice> guessed_choices(const StagedProblem& problem, std::span<const StageRecord> stages);

// How widely a state is lost: the depth of its loss, or minus what is missing.
double lost_by(const StageEnd& end);
double kept_by(const StageEnd& end);

}  // namespace formotion
