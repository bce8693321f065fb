#include "optimize/stage_choices.hpp"

#include <algorithm>
#include <bit>

namespace formotion {
namespace {

StageChoice choice_of(const StagedProblem& problem, const StageTrial& trial, std::size_t place) {
  StageChoice choice;
  choice.trial = place;
  choice.kind = trial.kind;
  choice.length_mm = trial.result.length_mm;
  if (problem.kinds()[static_cast<std::size_t>(trial.kind)].passive) return choice;
  for (const StageEnd& end : trial.result.ends) choice.to.push_back(end.to);
  return choice;
}

}  // namespace

std::vector<int> members(StateSet set) {
  std::vector<int> states;
  for (; set != 0; set &= set - 1) states.push_back(std::countr_zero(set));
  return states;
}

double lost_by(const StageEnd& end) {
  if (end.to == kStuckState) return -end.lacking_mm;
  return end.to == kLostState ? end.nominal_mm : -end.nominal_mm;
}
double kept_by(const StageEnd& end) {
  if (end.to == kStuckState) return -end.lacking_mm;
  return end.to == kLostState ? -end.nominal_mm : end.nominal_mm;
}

std::vector<StageChoice> measured_choices(const StagedProblem& problem, std::span<const StageRecord> stages) {
  std::vector<StageChoice> choices;
  for (std::size_t place = 0; place < stages.size(); ++place) {
    const StageTrial& trial = stages[place].trial;
    if (trial.demanded.empty() || trial.tolerance_mm <= 0) continue;
    StageChoice choice = choice_of(problem, trial, place);
    for (std::size_t i = 0; i < trial.demanded.size(); ++i) {
      const StateSet bit = only(static_cast<int>(i));
      const int to = trial.result.ends[i].to;
      if (to == kStuckState)
        choice.blocks |= bit;
      else if (trial.demanded[i])
        (to == kLostState ? choice.loses : choice.keeps) |= bit;
      else if (to == kLostState)
        choice.fades |= bit;
    }
    choice.tolerance_mm = trial.tolerance_mm;
    choices.push_back(std::move(choice));
  }
  return choices;
}

std::vector<StageChoice> guessed_choices(const StagedProblem& problem, std::span<const StageRecord> stages) {
  std::vector<StageChoice> choices;
  std::vector<double> thresholds;
  for (std::size_t place = 0; place < stages.size(); ++place) {
    const StageTrial& trial = stages[place].trial;
    if (!trial.result.valid) continue;
    const bool passive = problem.kinds()[static_cast<std::size_t>(trial.kind)].passive;
    thresholds.clear();
    for (const StageEnd& end : trial.result.ends) {
      thresholds.push_back(std::max(lost_by(end), kept_by(end)));
      if (passive) thresholds.push_back(std::min(lost_by(end), kept_by(end)));
    }
    std::sort(thresholds.begin(), thresholds.end());
    thresholds.erase(std::unique(thresholds.begin(), thresholds.end()), thresholds.end());
    for (const double threshold : thresholds) {
      StageChoice choice = choice_of(problem, trial, place);
      for (std::size_t i = 0; i < trial.result.ends.size(); ++i) {
        const StateSet bit = only(static_cast<int>(i));
        const StageEnd& end = trial.result.ends[i];
        const bool keeps = kept_by(end) >= threshold, loses = lost_by(end) >= threshold;
        if (keeps && (passive || end.to >= 0)) choice.keeps |= bit;
        if (loses && (passive || end.to == kLostState)) choice.loses |= bit;
        if (keeps || loses) continue;
        if (end.to == kStuckState) choice.blocks |= bit;
        if (end.to == kLostState) choice.fades |= bit;
      }
      choice.tolerance_mm = threshold;
      choices.push_back(std::move(choice));
    }
  }
  return choices;
}

}  // namespace formotion
