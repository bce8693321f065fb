#include "analysis/insertion/insertion.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/contact/clearance.hpp"
#include "analysis/insertion/damped_insertion.hpp"
#include "analysis/insertion/inserter.hpp"
#include "analysis/motion/path_step.hpp"

namespace formotion {
namespace inserting {
namespace {

constexpr double kReached_mm = 1e-6;  // short of the goal
constexpr double kLike = 0.99;        // cosine between motions that are taken as one

}  // namespace

Insertion Inserter::run(const Configuration& start) {
  State state;
  state.q = start;
  start_ = vector_of(start);
  if (!is_free(space_.part, space_.obstacles, start)) {
    state.result.why = "the part overlaps a fixed shape at the start";
    finish(state, InsertionOutcome::Blocked);
    return state.result;
  }
  note(state, spring_load(stiffness_, start_, start), "start", {});
  follow(state, options_.max_branching);
  return state.result;
}

double reached(const InsertionTask& task, const Configuration& q) {
  const Point moved = q.position() - task.drawn.position();
  const double lateral = std::abs(turned_left(task.approach.direction).dot(moved));
  const double tilt = std::abs(q.theta_rad - task.drawn.theta_rad);
  return std::min({task.approach.direction.dot(moved) - task.goal.depth_mm, task.goal.lateral_mm - lateral,
                   (task.goal.tilt_rad - tilt) * task.space->part.reach_mm}) +
         kReached_mm;
}

void Inserter::follow(State& state, int branching) const {
  const Point& d = task_.approach.direction;
  const Eigen::Vector3d way(d.x(), d.y(), 0);
  for (int legs = 0; legs < options_.max_legs; ++legs) {
    if (reached(state.q) >= 0) return finish(state, InsertionOutcome::Assembled);
    const double left = task_.approach.distance_mm - state.travel_mm;
    if (left <= 0) return stop(state, "the carrier's travel ends");
    if (state.result.solves > options_.most_solves) {
      state.result.why = "it takes more than " + std::to_string(options_.most_solves) + " solutions";
      return finish(state, InsertionOutcome::Undecided);
    }
    const Stretch stretch{stiffness_, {carrier(state.travel_mm), way}, left, true};
    const double ahead = std::min(kLookAhead_mm, left / 2);
    std::vector<Continuation> ways = ways_.continuous(state.q, stretch.line, ahead, state.result.solves);
    if (ways.empty()) {
      if (!snap(state, branching)) return;
      continue;
    }
    // A part that may rest may also snap from there.
    std::vector<FirstMotion> falls;
    const auto is_rest = [](const Continuation& next) { return !next.leg; };
    const bool may_rest = std::any_of(ways.begin(), ways.end(), is_rest);
    if (may_rest && has_left_rest(state)) {
      if (ways.size() > 1) std::erase_if(ways, is_rest);
    } else if (may_rest) {
      falls = falls_beside(state.q, ways, stretch.line.at(ahead));
    }
    if (ways.size() + falls.size() > 1) {
      branch(state, ways, falls, stretch, branching);
      return;
    }
    if (take(state, ways.front(), stretch).end == Ride::Ended) return;
  }
  state.result.why = "it makes more than " + std::to_string(options_.max_legs) + " legs";
  finish(state, InsertionOutcome::Undecided);
}

std::vector<ContactPair> Inserter::touching(const Configuration& q) const {
  std::vector<ContactPair> pairs;
  for (const TouchCluster& cluster : touches_at(space_, q)) {
    for (const Touch& touch : cluster) pairs.push_back(touch.pair);
  }
  return pairs;
}

std::vector<FirstMotion> Inserter::falls_beside(const Configuration& q, const std::vector<Continuation>& ways,
                                                const Eigen::Vector3d& at) const {
  std::vector<FirstMotion> falls = ways_.first_motions(q, at);
  std::erase_if(falls, [&](const FirstMotion& motion) {
    return std::any_of(ways.begin(), ways.end(), [&](const Continuation& way) {
      return way.leg && likeness(motion.velocity, vector_of(way.ahead) - vector_of(q)) > kLike;
    });
  });
  return falls;
}

void Inserter::branch(State& state, std::vector<Continuation>& ways, const std::vector<FirstMotion>& falls,
                      const Stretch& stretch, int branching) const {
  if (branching <= 0) {
    state.result.why = "several motions are consistent with friction, again and again";
    return finish(state, InsertionOutcome::Ambiguous);
  }
  std::vector<State> ends;
  for (Continuation& way : ways) {
    State other = state;
    other.left_rest = touching(state.q);
    if (take(other, way, stretch).end == Ride::Arrived) follow(other, branching - 1);
    ends.push_back(std::move(other));
  }
  for (const FirstMotion& motion : falls) {
    State other = state;
    other.left_rest = touching(state.q);
    ends.push_back(fallen(std::move(other), motion, branching - 1));
  }
  join(state, ends);
}

void join(State& state, std::vector<State>& ends) {
  unsigned outcomes = 0;
  double deepest = 0, axial = 0, lateral = 0;
  std::uint64_t history = 0;
  for (const State& end : ends) {
    outcomes |= end.ends;
    deepest = std::max(deepest, end.result.deepest_mm);
    axial = std::max(axial, end.result.peak_axial_n);
    lateral = std::max(lateral, end.result.peak_lateral_n);
    history = history * 31 + end.result.history;
  }
  const auto worst = std::min_element(ends.begin(), ends.end(), [](const State& a, const State& b) {
    return std::pair(a.result.outcome == InsertionOutcome::Assembled, a.result.depth_mm) <
           std::pair(b.result.outcome == InsertionOutcome::Assembled, b.result.depth_mm);
  });
  int solves = 0;
  for (const State& end : ends) solves += end.result.solves - state.result.solves;
  const int before = state.result.solves;
  state = std::move(*worst);
  state.result.solves = before + solves;
  state.result.deepest_mm = deepest;
  state.result.peak_axial_n = axial;
  state.result.peak_lateral_n = lateral;
  state.result.history = history;
  state.ends = outcomes;
  if ((outcomes & (outcomes - 1)) == 0) return;
  state.result.outcome = InsertionOutcome::Ambiguous;
  state.result.why = "several motions are consistent with friction: ";
  const char* between = "";
  for (int i = 0; i < kInsertionOutcomes; ++i) {
    if (!(outcomes >> i & 1)) continue;
    state.result.why += between;
    state.result.why += name(static_cast<InsertionOutcome>(i));
    between = " or ";
  }
}

void Inserter::note(State& state, const Eigen::Vector3d& force, const char* event, std::vector<CarriedContact> contacts,
                    bool is_snap) const {
  Insertion& result = state.result;
  result.peak_axial_n = std::max(result.peak_axial_n, std::abs(axial(force)));
  result.peak_lateral_n = std::max(result.peak_lateral_n, std::abs(lateral(force)));
  result.deepest_mm = std::max(result.deepest_mm, depth(state.q));
  if (options_.keep_path) {
    InsertionMoment moment{state.travel_mm, state.q, depth(state.q), axial(force), lateral(force),
                           force[2],        event,   is_snap,        contacts};
    result.path.push_back(std::move(moment));
  }
  state.contacts = std::move(contacts);
}

InsertionOutcome stopped_as(const std::vector<CarriedContact>& contacts, double friction, bool is_stopped,
                            std::string& why) {
  const bool sticks = std::any_of(contacts.begin(), contacts.end(), [&](const CarriedContact& contact) {
    return friction > 0 && contact.mode == ContactMode::Stick && contact.force.normal > 0;
  });
  if (sticks && is_stopped && is_wedged(contacts, friction)) {
    why += " with two contacts inside each other's friction cones";
    return InsertionOutcome::Wedged;
  }
  why += sticks ? " with a contact that sticks" : contacts.empty() ? " short of the goal" : " with no contact sticking";
  return sticks ? InsertionOutcome::Jammed : InsertionOutcome::Blocked;
}

void Inserter::stop(State& state, const std::string& why) const {
  state.result.why = why;
  finish(state, stopped_as(state.contacts, task_.friction, state.is_stopped, state.result.why));
}

void Inserter::finish(State& state, InsertionOutcome outcome) const {
  Insertion& result = state.result;
  state.ends = 1u << static_cast<int>(outcome);
  result.outcome = outcome;
  result.depth_mm = depth(state.q);
  result.deepest_mm = std::max(result.deepest_mm, result.depth_mm);
  result.lateral_mm = aside_.dot(state.q.position() - task_.drawn.position());
  result.tilt_rad = state.q.theta_rad - task_.drawn.theta_rad;
  result.travel_mm = state.travel_mm;
  result.contacts = state.contacts;
  mix(result.history, static_cast<std::uint64_t>(outcome) + 1000);
}

}  // namespace inserting

const char* name(InsertionOutcome outcome) {
  switch (outcome) {
    case InsertionOutcome::Assembled:
      return "assembled";
    case InsertionOutcome::Wedged:
      return "wedged";
    case InsertionOutcome::Jammed:
      return "jammed";
    case InsertionOutcome::Blocked:
      return "blocked";
    case InsertionOutcome::Ambiguous:
      return "ambiguous";
    case InsertionOutcome::Undecided:
      return "undecided";
  }
  return "undecided";
}

Insertion insert(const InsertionTask& task, const Configuration& start, const InsertionOptions& options) {
  if (task.damper_speed_mm_s) return insert_damped(task, start, options);
  return inserting::Inserter(task, options).run(start);
}

Configuration start_with_errors(const InsertionTask& task, double x_mm, double y_mm, double theta_rad) {
  const Point at = task.drawn.position() + x_mm * turned_left(task.approach.direction) + Point(0, y_mm);
  return {at.x(), at.y(), task.drawn.theta_rad + theta_rad};
}

}  // namespace formotion
