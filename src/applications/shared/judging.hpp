// What judging a design has in common for all kinds whose metrics are looked up by name.
#pragma once

#include <span>

#include "applications/shared/worst_members.hpp"
#include "problem/problem.hpp"

namespace formotion {

// The worst metrics over the ends of what is uncertain, and which quantity bites, into the evaluation; nothing where
// nothing is uncertain. value(metrics, name): of an objective. judged(member, worst): the member's metrics, gathered
// into the worst ones.
template <class Spec, class Value, class Evaluation, class Judged>
void judge_worst_case(const Spec& spec, const std::string& centre_name, const Value& value, Evaluation& evaluation,
                      const Judged& judged) {
  if (!spec.uncertainty.any() || spec.objectives.empty()) return;
  const Objective& first = spec.objectives.front();
  auto worst = evaluation.metrics;
  evaluation.bites =
      judge_ends(spec.uncertainty, centre_name, first.loss(value(worst, first.name)),
                 [&](const Member& member) { return first.loss(value(judged(member, worst), first.name)); });
  evaluation.worst_case = worst;
}

// add(what, where, by) for every bound that is not kept.
template <class Value, class Add>
void judge_bounds(std::span<const Bound> bounds, const Value& value_of, const Add& add) {
  for (const Bound& bound : bounds) {
    const double value = value_of(bound.metric);
    if (bound.min && value < *bound.min)
      add(bound.metric + " is below its bound", "/goal/require/" + bound.metric, *bound.min - value);
    if (bound.max && value > *bound.max)
      add(bound.metric + " is above its bound", "/goal/require/" + bound.metric, value - *bound.max);
  }
}

// What search sees of a judged design.
template <class Spec, class Value, class Judged>
Score score_of(const Spec& spec, const Judged& judged, const Value& value) {
  const auto& evaluation = judged.evaluation;
  Score score;
  score.feasible = evaluation.feasible;
  score.violation = judged.violation;
  score.work = judged.work;
  const auto& worst = evaluation.worst_case;
  for (const Objective& o : spec.objectives) {
    score.objectives.push_back(value(spec.robust && worst ? *worst : evaluation.metrics, o.name));
    if (worst) score.worst_case.push_back(value(*worst, o.name));
  }
  score.bites = evaluation.bites;
  if (!spec.uncertainty.any()) score.worst_case = score.objectives;
  return score;
}

}  // namespace formotion
