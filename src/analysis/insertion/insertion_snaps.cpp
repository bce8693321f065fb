// Snaps: the part moves while the carrier all but stands.
#include <algorithm>
#include <cmath>

#include "analysis/insertion/inserter.hpp"
#include "analysis/motion/path_step.hpp"

namespace formotion::inserting {
namespace {

constexpr double kNudge_mm = 1e-5;  // the carrier's way in a snap
constexpr double kStill_mm = 1e-9;
constexpr int kMostSnaps = 300;            // legs of one snap
constexpr double kLeastDamper = 1.0 / 32;  // of a snap's steps in time, as a share of the spring

}  // namespace

bool Inserter::snap(State& state, int branching) const {
  const double nudge = std::min(kNudge_mm, task_.approach.distance_mm - state.travel_mm);
  state.result.work_nmm += nudge * axial(spring_load(stiffness_, carrier(state.travel_mm), state.q));
  state.travel_mm += nudge;
  return fall(state, branching, true);
}

bool Inserter::fall(State& state, int branching, bool is_begun) const {
  const Eigen::Vector3d home = carrier(state.travel_mm);
  double damper = 0;
  for (int legs = 0; legs < kMostSnaps && state.result.solves <= options_.most_solves; ++legs) {
    const std::vector<FirstMotion> motions = ways_.first_motions(state.q, home);
    const bool looks = motions.empty() || (!is_begun && !has_left_rest(state));
    const bool may_rest = looks && ways_.held(state.q, home);
    if (motions.empty()) {
      if (!is_begun || may_rest) return true;
      state.result.why = "no motion is consistent with its contacts";
      finish(state, InsertionOutcome::Undecided);
      return false;
    }
    if (motions.size() + may_rest > 1) {
      several_falls(state, motions, may_rest, branching);
      return false;
    }
    const Configuration before = state.q;
    const Ride ridden = ride(state, home, motions.front(), 1 + damper);
    if (ridden == Ride::Ended) return false;
    const double moved = chord(before, state.q, space_.part.reach_mm);
    if (ridden == Ride::Arrived && (damper == 0 || moved < kStill_mm)) return true;
    if (ridden == Ride::Broken || moved < kStill_mm) {
      if (damper > 1e4) break;
      damper = std::max(kLeastDamper, 2 * damper);
    } else {
      is_begun = false;
      damper = damper > kLeastDamper ? 0.7 * damper : 0;
    }
  }
  state.result.why = "a snap cannot be followed";
  finish(state, InsertionOutcome::Undecided);
  return false;
}

void Inserter::several_falls(State& state, const std::vector<FirstMotion>& motions, bool may_rest,
                             int branching) const {
  if (branching <= 0) {
    state.result.why = "several snaps are consistent with friction, again and again";
    return finish(state, InsertionOutcome::Ambiguous);
  }
  std::vector<State> ends;
  for (const FirstMotion& motion : motions) {
    State other = state;
    if (may_rest) other.left_rest = touching(state.q);
    ends.push_back(fallen(std::move(other), motion, branching - 1));
  }
  if (may_rest) {
    ends.push_back(state);
    ends.back().left_rest = touching(state.q);
    follow(ends.back(), branching - 1);
  }
  join(state, ends);
}

State Inserter::fallen(State state, const FirstMotion& motion, int branching) const {
  const Eigen::Vector3d home = carrier(state.travel_mm);
  for (double damper = 0; damper < 1e4; damper = std::max(kLeastDamper, 2 * damper)) {
    const Ride ridden = ride(state, home, motion, 1 + damper);
    if (ridden == Ride::Broken) continue;
    if (ridden != Ride::Ended && ((ridden == Ride::Arrived && damper == 0) || fall(state, branching, false)))
      follow(state, branching);
    return state;
  }
  state.result.why = "a snap cannot be followed";
  finish(state, InsertionOutcome::Undecided);
  return state;
}

Ride Inserter::ride(State& state, const Eigen::Vector3d& home, const FirstMotion& motion, double stiffer) const {
  const Eigen::Vector3d q = vector_of(state.q), &v = motion.velocity;
  const Stretch stretch{stiffness_ * stiffer, {q + (home - q - v) / stiffer, v / stiffer}, 1, false};
  const WaysOn ways_of_ride(space_, stretch.stiffness, task_.friction);
  const double size = std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2]) * space_.part.reach_mm}) / stiffer;
  const double ahead = std::min(kLookAhead_mm / size, 0.5);
  auto way = ways_of_ride.continued(state.q, motion, stretch.line, ahead, state.result.solves);
  if (!way) return Ride::Broken;
  const Went went = slide(state, *way->leg, stretch);
  if (went.end == Ride::Ended) return Ride::Ended;
  return 1 - went.h < 1e-9 ? Ride::Arrived : Ride::Event;
}

}  // namespace formotion::inserting
