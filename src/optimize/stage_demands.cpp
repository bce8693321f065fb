#include "optimize/stage_demands.hpp"

#include <algorithm>
#include <limits>

namespace formotion {

std::vector<Demand> demands_of(const StagedProblem& problem, const Composed& track,
                               std::span<const StageChoice> choices, std::span<const StageRecord> stages) {
  std::vector<Demand> demands;
  std::vector<int> at;  // as what every state that arrived travels
  for (std::size_t i = 0; i < problem.states().size(); ++i) at.push_back(static_cast<int>(i));
  const bool passive =
      std::all_of(problem.kinds().begin(), problem.kinds().end(), [](const StageKind& kind) { return kind.passive; });
  std::vector<std::size_t> by(at.size(), track.choices.size());  // the passive stage that loses a state most widely
  for (std::size_t i = 0; passive && i < at.size(); ++i) {
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t s = 0; s < track.choices.size(); ++s) {
      const double lost = lost_by(stages[choices[track.choices[s]].trial].trial.result.ends[i]);
      if (lost > most) by[i] = s;
      most = std::max(most, lost);
    }
  }
  for (std::size_t s = 0; s < track.choices.size(); ++s) {
    const StageChoice& choice = choices[track.choices[s]];
    Demand demand{choice.kind, 0, 0};
    for (std::size_t i = 0; i < at.size(); ++i) {
      if (at[i] == kLostState) continue;
      const bool stays = track.composition.ends[i] != kLostState;
      if (passive) {
        if (stays)
          demand.keep |= only(at[i]);
        else if (by[i] == s)
          demand.lose |= only(at[i]);
      } else if (has(choice.loses, at[i])) {
        demand.lose |= only(at[i]);
        at[i] = kLostState;
      } else {
        demand.keep |= only(at[i]);
        if (!choice.to.empty()) at[i] = choice.to[static_cast<std::size_t>(at[i])];
      }
    }
    demands.push_back(demand);
  }
  return demands;
}

namespace {

// What is known of one wanted state and a topology's kinds.
struct Reach {
  std::vector<int> never_kept_by;  // kinds
  std::vector<int> never_lost;     // unwanted states that no stage that keeps it loses
  std::size_t missing() const { return never_kept_by.size() * kMostStates + never_lost.size(); }
};

Reach reach_of(const StagedProblem& problem, int topology, const std::vector<int>& goal, int kept,
               std::span<const StageChoice> choices) {
  Reach reach;
  StateSet lost = 0;
  for (const StageUse& use : problem.stages(topology)) {
    bool any = false;
    for (const StageChoice& choice : choices) {
      if (choice.kind != use.kind || !has(choice.keeps, kept)) continue;
      any = true;
      lost |= choice.loses;
    }
    if (!any) reach.never_kept_by.push_back(use.kind);
  }
  for (int state = 0; state < static_cast<int>(problem.states().size()); ++state) {
    const bool wanted = std::find(goal.begin(), goal.end(), state) != goal.end();
    if (!wanted && !has(lost, state)) reach.never_lost.push_back(state);
  }
  return reach;
}

}  // namespace

std::string why_unreached(const StagedProblem& problem, int topology, std::span<const StageChoice> choices) {
  Reach nearest;
  int nearest_state = -1;
  for (const std::vector<int>& goal : problem.goals()) {
    for (const int kept : goal) {
      const Reach reach = reach_of(problem, topology, goal, kept, choices);
      if (nearest_state >= 0 && reach.missing() >= nearest.missing()) continue;
      nearest = reach;
      nearest_state = kept;
    }
  }
  const auto state = [&](int s) { return problem.states()[static_cast<std::size_t>(s)].name; };
  if (nearest_state >= 0 && !nearest.never_kept_by.empty()) {
    const auto kind = static_cast<std::size_t>(nearest.never_kept_by.front());
    return "no " + problem.kinds()[kind].label + " that was tried keeps " + state(nearest_state);
  }
  if (nearest_state >= 0 && !nearest.never_lost.empty()) {
    return "no stage that was tried loses " + state(nearest.never_lost.front()) + " and keeps " + state(nearest_state);
  }
  return "no stages that were tried let a wanted state pass and together lose all others";
}

}  // namespace formotion
