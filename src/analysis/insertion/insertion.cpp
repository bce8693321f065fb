#include "analysis/insertion/insertion.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>

#include "analysis/contact/clearance.hpp"
#include "analysis/insertion/ways_on.hpp"
#include "analysis/motion/first_touch.hpp"

namespace formotion {
namespace {

constexpr double kLookAhead_mm = 2e-5;  // of the carrier
constexpr double kNudge_mm = 1e-5;      // the carrier's way in a snap
constexpr double kShortest = 1e-10;     // steps, of the leg's length
constexpr double kReached_mm = 1e-6;    // short of the goal
constexpr int kMostSnaps = 200;         // legs of one snap
constexpr double kWork = 1e-6;          // of work, to its share
constexpr int kHalvings = 12;           // of a step, for its work

template <class F>
double falling_root(const F& f, double a, double b, double fa, double fb) {
  if (fa <= 0) return a;
  std::uintmax_t most = 200;
  const auto close = [width = b - a](double low, double high) { return high - low <= 1e-13 * width; };
  return boost::math::tools::toms748_solve(f, a, b, fa, fb, close, most).second;
}

// Simpson's rule on halves until they agree with the whole. fa, fm, fb: at the ends and in the middle.
template <class F>
double integral(const F& f, double a, double b, double fa, double fm, double fb, int halvings) {
  const double m = (a + b) / 2, left = f((a + m) / 2), right = f((m + b) / 2);
  const double whole = (b - a) / 6 * (fa + 4 * fm + fb);
  const double halves = (b - a) / 12 * (fa + 4 * left + 2 * fm + 4 * right + fb);
  const double size = (b - a) * (std::abs(fa) + std::abs(fm) + std::abs(fb));
  if (halvings == 0 || std::abs(halves - whole) <= kWork * size) return halves;
  return integral(f, a, m, fa, left, fm, halvings - 1) + integral(f, m, b, fm, right, fb, halvings - 1);
}

// FNV-1a
void mix(std::uint64_t& history, std::uint64_t word) { history = (history ^ word) * 1099511628211ull; }

// A leg seen from one of its places on.
struct ShiftedLeg final : GuidedPath {
  const CompliantLeg& leg;
  double by;
  ShiftedLeg(const CompliantLeg& of, double from) : leg(of), by(from) {}
  const std::vector<ContactPair>& pairs() const override { return leg.pairs(); }
  Configuration at(double h) const override { return leg.at(by + h); }
  Twist rate(double h, const Configuration& q) const override { return leg.rate(by + h, q); }
};

// Ends a step earlier.
void cut(const ShiftedLeg& path, FlowStep& step, double h, double reach_mm) {
  if (h == step.h) return;
  if (h > 0) {
    step_to(path, step, h, path.at(h), reach_mm);
    return;
  }
  step.h = 0;
  step.end = step.start;
  step.rate_end = step.rate;
}

// Where the carrier goes, and on what spring: the real way, or a ride while the part snaps.
struct Stretch {
  Eigen::Vector3d stiffness;
  CarrierLine line;
  double length = 0;  // of the line
  bool is_real = true;
};

enum class Ride { Arrived, Ended, Broken };  // Ended: the outcome is there

// How far a stretch was followed.
struct Went {
  Ride end = Ride::Arrived;
  double h = 0;
};

// Everything of one start's way so far.
struct State {
  Configuration q;
  double travel_mm = 0;
  bool is_stopped = false;  // it rests, and the carrier goes on
  std::vector<CarriedContact> contacts;
  Insertion result;
};

class Inserter {
 public:
  Inserter(const InsertionTask& task, const InsertionOptions& options)
      : task_(task),
        space_(*task.space),
        options_(options),
        stiffness_(task.stiffness.kx_n_per_mm, task.stiffness.ky_n_per_mm, task.stiffness.ktheta_nmm_per_rad),
        ways_(space_, stiffness_, task.friction),
        aside_(turned_left(task.approach.direction)) {}
  Insertion run(const Configuration& start) {
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

 private:
  Eigen::Vector3d carrier(double travel) const {
    const Point& d = task_.approach.direction;
    return start_ + travel * Eigen::Vector3d(d.x(), d.y(), 0);
  }
  double depth(const Configuration& q) const {
    return task_.approach.direction.dot(q.position() - task_.drawn.position());
  }
  // How much is left of the goal's three conditions; not negative once it is reached.
  double reached(const Configuration& q) const {
    const double lateral = std::abs(aside_.dot(q.position() - task_.drawn.position()));
    const double tilt = std::abs(q.theta_rad - task_.drawn.theta_rad);
    return std::min({depth(q) - task_.goal.depth_mm, task_.goal.lateral_mm - lateral,
                     (task_.goal.tilt_rad - tilt) * space_.part.reach_mm}) +
           kReached_mm;
  }

  // The real carrier's way, until an outcome.
  void follow(State& state, int branching) const {
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
      if (ways.size() > 1) {
        branch(state, ways, stretch, branching);
        return;
      }
      if (take(state, ways.front(), stretch).end == Ride::Ended) return;
    }
    state.result.why = "it makes more than " + std::to_string(options_.max_legs) + " legs";
    finish(state, InsertionOutcome::Undecided);
  }

  // Goes one way to its end.
  Went take(State& state, Continuation& way, const Stretch& stretch) const {
    return way.leg ? slide(state, *way.leg, stretch) : rest(state, stretch);
  }

  void branch(State& state, std::vector<Continuation>& ways, const Stretch& stretch, int branching) const {
    if (branching <= 0) {
      state.result.why = "several motions are consistent with friction, again and again";
      return finish(state, InsertionOutcome::Ambiguous);
    }
    std::vector<State> ends;
    for (Continuation& way : ways) {
      State other = state;
      if (take(other, way, stretch).end == Ride::Arrived) follow(other, branching - 1);
      ends.push_back(std::move(other));
    }
    join(state, ends);
  }

  // The worst end stands for all; different outcomes are ambiguous.
  void join(State& state, std::vector<State>& ends) const {
    bool same = true;
    double deepest = 0, axial = 0, lateral = 0;
    std::uint64_t history = 0;
    std::string list;
    for (const State& end : ends) {
      same = same && end.result.outcome == ends.front().result.outcome;
      deepest = std::max(deepest, end.result.deepest_mm);
      axial = std::max(axial, end.result.peak_axial_n);
      lateral = std::max(lateral, end.result.peak_lateral_n);
      history = history * 31 + end.result.history;
      const std::string word = name(end.result.outcome);
      if (list.find(word) == std::string::npos) list += (list.empty() ? "" : " or ") + word;
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
    if (same) return;
    state.result.outcome = InsertionOutcome::Ambiguous;
    state.result.why = "several motions are consistent with friction: " + list;
  }

  // The part's way while the carrier all but stands: from where it would be in balance with the forces of its first
  // motion the carrier rides to where it is. That motion is the one of a part whose damping is as its stiffness
  // (D = 1 / K). Where the way folds back on itself the ride is made with a stiffer spring that is let go again and
  // again. False: the outcome is there.
  bool snap(State& state, int branching) const {
    const double nudge = std::min(kNudge_mm, task_.approach.distance_mm - state.travel_mm);
    state.result.work_nmm += nudge * axial(spring_load(stiffness_, carrier(state.travel_mm), state.q));
    state.travel_mm += nudge;
    const Eigen::Vector3d home = carrier(state.travel_mm);
    double stiffer = 1;
    for (int legs = 0; legs < kMostSnaps && state.result.solves <= options_.most_solves; ++legs) {
      const std::vector<Eigen::Vector3d> motions = ways_.first_motions(state.q, home);
      if (motions.empty()) {
        if (legs > 0 || ways_.held(state.q, home)) return true;
        state.result.why = "no motion is consistent with its contacts";
        finish(state, InsertionOutcome::Undecided);
        return false;
      }
      if (motions.size() > 1) {
        if (branching <= 0) {
          state.result.why = "several snaps are consistent with friction, again and again";
          finish(state, InsertionOutcome::Ambiguous);
          return false;
        }
        std::vector<State> ends;
        for (const Eigen::Vector3d& motion : motions) {
          State other = state;
          const Ride ridden = ride(other, home, motion, 1);
          if (ridden != Ride::Ended) follow(other, branching - 1);
          ends.push_back(std::move(other));
        }
        join(state, ends);
        return false;
      }
      const Configuration before = state.q;
      const Ride ridden = ride(state, home, motions.front(), stiffer);
      if (ridden == Ride::Ended) return false;
      if (ridden == Ride::Arrived && stiffer == 1) return true;
      // A stiffer spring's ride gets nearer to balance by its share: it has come to an end where it hardly moves.
      const double moved = chord(before, state.q, space_.part.reach_mm);
      if (ridden == Ride::Arrived && moved < kNudge_mm / 10) return true;
      if (ridden == Ride::Broken && moved < 1e-9) {
        if (stiffer > 1e4) break;
        stiffer *= 4;
      } else {
        stiffer = std::max(1.0, stiffer / 4);
      }
    }
    state.result.why = "a snap cannot be followed";
    finish(state, InsertionOutcome::Undecided);
    return false;
  }

  // Broken: it got as far as the state says and must be looked at anew.
  Ride ride(State& state, const Eigen::Vector3d& home, const Eigen::Vector3d& motion, double stiffer) const {
    const Eigen::Vector3d q = vector_of(state.q);
    const CarrierLine line{q + (home - q - motion) / stiffer, motion / stiffer};
    const Eigen::Vector3d stiffness = stiffness_ * stiffer;
    const WaysOn ways_of_ride(space_, stiffness, task_.friction);
    const double size =
        std::max({std::abs(motion[0]), std::abs(motion[1]), std::abs(motion[2]) * space_.part.reach_mm}) / stiffer;
    double done = 0;
    for (int legs = 0; legs < kMostSnaps && state.result.solves <= options_.most_solves; ++legs) {
      const Stretch stretch{stiffness, {line.at(done), line.way}, 1 - done, false};
      const double ahead = std::min(kLookAhead_mm / size, (1 - done) / 2);
      std::vector<Continuation> ways = ways_of_ride.continuous(state.q, stretch.line, ahead, state.result.solves);
      if (ways.empty()) return Ride::Broken;
      // Among several the one with the most in reserve: the snap's own first motion chose its branch.
      const Went went = take(state, ways.front(), stretch);
      if (went.end == Ride::Ended) return Ride::Ended;
      done += went.h;
      if (1 - done < 1e-9) return Ride::Arrived;
    }
    return Ride::Broken;
  }

  // The part stands while the carrier goes on, as long as forces can hold it: they do for an interval of the carrier's
  // places, since cones are convex.
  Went rest(State& state, const Stretch& stretch) const {
    const auto& [stiffness, line, length, is_real] = stretch;
    const WaysOn ways(space_, stiffness, task_.friction);
    double far = length;
    bool by_force = false;
    if (is_real && task_.approach.max_force_n) {
      const double until = (*task_.approach.max_force_n - axial(spring_load(stiffness_, line.from, state.q))) /
                           axial(stiffness.cwiseProduct(line.way));
      if (until < far) {
        far = std::max(0.0, until);
        by_force = true;
      }
    }
    auto carried = ways.held(state.q, line.at(far));
    if (!carried) {
      double low = 0, high = far;
      for (int i = 0; i < 60 && high - low > 1e-12 * far; ++i) {
        const double middle = (low + high) / 2;
        if (auto found = ways.held(state.q, line.at(middle))) {
          low = middle;
          carried = std::move(found);
        } else {
          high = middle;
        }
      }
      far = high;
      by_force = false;
    }
    mix(state.result.history, 77);
    const std::vector<CarriedContact> contacts = carried ? *carried : state.contacts;
    if (is_real) {
      add_work(state, line, 0, far, [&](double) { return state.q; });
      state.travel_mm += far;
    }
    state.is_stopped = true;
    note(state, spring_load(stiffness, line.at(far), state.q), is_real ? "rests" : "rests while it snaps", contacts);
    if (by_force) {
      stop(state, "the force's limit is reached");
      return {Ride::Ended, far};
    }
    return {Ride::Arrived, far};
  }

  double axial(const Eigen::Vector3d& force) const {
    return task_.approach.direction.x() * force[0] + task_.approach.direction.y() * force[1];
  }
  double lateral(const Eigen::Vector3d& force) const { return aside_.x() * force[0] + aside_.y() * force[1]; }

  // The carrier's work on a step, and the largest forces on it: both may lie between its ends.
  template <class At>
  void add_work(State& state, const CarrierLine& line, double from, double to, const At& at) const {
    Insertion& result = state.result;
    const auto force = [&](double h) {
      const Eigen::Vector3d load = spring_load(stiffness_, line.at(h), at(h));
      result.peak_axial_n = std::max(result.peak_axial_n, std::abs(axial(load)));
      result.peak_lateral_n = std::max(result.peak_lateral_n, std::abs(lateral(load)));
      return axial(load);
    };
    result.work_nmm += integral(force, from, to, force(from), force((from + to) / 2), force(to), kHalvings);
  }

  Went slide(State& state, const CompliantLeg& leg, const Stretch& stretch) const {
    const auto& [stiffness, line, length, is_real] = stretch;
    const double reach = space_.part.reach_mm;
    state.is_stopped = false;
    mix(state.result.history, is_real ? 1 : 2);
    for (std::size_t i = 0; i < leg.pairs().size(); ++i) {
      const ContactPair& pair = leg.pairs()[i];
      mix(state.result.history, static_cast<std::uint64_t>(pair.kind) << 40 |
                                    static_cast<std::uint64_t>(pair.moving) << 20 |
                                    static_cast<std::uint64_t>(pair.fixed));
      mix(state.result.history, static_cast<std::uint64_t>(leg.modes()[i]));
    }
    note(state, spring_load(stiffness, line.from, state.q), is_real ? "moves" : "snaps", carried_by(leg, 0, state.q));
    const int before = leg.solves();
    double from = 0, longest = length;
    const char* event = nullptr;
    const auto at = [&](double h) { return leg.at(h); };
    for (int steps = 0; steps < 20000 && from < length && !event; ++steps) {
      double h = std::min(longest, length - from);
      const ShiftedLeg shifted{leg, from};
      FlowStep step;
      step.start = shifted.at(0);
      step.rate = shifted.rate(0, step.start);
      while (!step_to(shifted, step, h, shifted.at(h), reach) && h > kShortest * length) h /= 2;
      if (!(h > kShortest * length)) {
        event = "stalls";
        break;
      }
      longest = 2 * h;
      double end = h;
      const auto left = [&](double t) { return leg.reserve(from + t) + kLegReserve; };
      double begun = 0;
      for (const double t : {h / 2, h}) {
        if (const double at_end = left(t); at_end < 0) {
          const double at_begun = left(begun);
          end = at_begun <= 0 ? begun : falling_root(left, begun, t, at_begun, at_end);
          event = "contact changes";
          break;
        }
        begun = t;
      }
      cut(shifted, step, end, reach);
      if (step.h > 0) {
        const double touch = first_touch(space_, shifted, step);
        if (touch < step.h || (touch == step.h && !event)) {
          event = "touches";
          cut(shifted, step, touch, reach);
        }
      }
      const auto ends_at = [&](const auto& missing, const char* what) {
        const double now = missing(0.0), then = missing(step.h);
        if (then > 0) return;
        event = what;
        cut(shifted, step, now <= 0 ? 0.0 : falling_root(missing, 0.0, step.h, now, then), reach);
      };
      ends_at([&](double t) { return -reached(leg.at(from + t)); }, kReaches);
      if (is_real && task_.approach.max_force_n) {
        ends_at(
            [&](double t) {
              return *task_.approach.max_force_n - axial(spring_load(stiffness, line.at(from + t), leg.at(from + t)));
            },
            kLimit);
      }
      if (is_real) add_work(state, line, from, from + step.h, at);
      from += step.h;
      state.q = leg.at(from);
      leg.restart(from);
      if (is_real) state.travel_mm += step.h;
      note(state, spring_load(stiffness, line.at(from), state.q), event ? event : "", carried_by(leg, from, state.q));
      if (!event && step.h <= 0) event = "stalls";
    }
    state.result.solves += leg.solves() - before;
    if (event == kReaches) {
      finish(state, InsertionOutcome::Assembled);
      return {Ride::Ended, from};
    }
    if (event == kLimit) {
      stop(state, "the force's limit is reached");
      return {Ride::Ended, from};
    }
    return {Ride::Arrived, from};
  }

  std::vector<CarriedContact> carried_by(const CompliantLeg& leg, double h, const Configuration& q) const {
    std::vector<CarriedContact> contacts;
    const double c = std::cos(q.theta_rad), s = std::sin(q.theta_rad);
    const std::vector<ContactForce> forces = leg.forces(h);
    for (std::size_t i = 0; i < leg.pairs().size(); ++i) {
      const ContactState state = contact_state(space_.part, space_.obstacles, leg.pairs()[i], q.position(), c, s);
      contacts.push_back({leg.pairs()[i], q.position() + state.lever, state.normal, leg.modes()[i], forces[i]});
    }
    return contacts;
  }

  // Takes down an instant, with the spring's force: peaks always, the path if it is kept.
  void note(State& state, const Eigen::Vector3d& force, const char* event, std::vector<CarriedContact> contacts) const {
    Insertion& result = state.result;
    result.peak_axial_n = std::max(result.peak_axial_n, std::abs(axial(force)));
    result.peak_lateral_n = std::max(result.peak_lateral_n, std::abs(lateral(force)));
    result.deepest_mm = std::max(result.deepest_mm, depth(state.q));
    if (options_.keep_path) {
      InsertionMoment moment{state.travel_mm, state.q,  depth(state.q), axial(force),
                             lateral(force),  force[2], event,          contacts};
      result.path.push_back(std::move(moment));
    }
    state.contacts = std::move(contacts);
  }

  void stop(State& state, const std::string& why) const {
    const bool sticks = std::any_of(state.contacts.begin(), state.contacts.end(), [&](const CarriedContact& contact) {
      return task_.friction > 0 && contact.mode == ContactMode::Stick && contact.force.normal > 0;
    });
    state.result.why = why;
    if (sticks && state.is_stopped && is_wedged(state.contacts, task_.friction)) {
      state.result.why += " with two contacts inside each other's friction cones";
      return finish(state, InsertionOutcome::Wedged);
    }
    state.result.why += sticks                   ? " with a contact that sticks"
                        : state.contacts.empty() ? " short of the goal"
                                                 : " with no contact sticking";
    finish(state, sticks ? InsertionOutcome::Jammed : InsertionOutcome::Blocked);
  }

  void finish(State& state, InsertionOutcome outcome) const {
    Insertion& result = state.result;
    result.outcome = outcome;
    result.depth_mm = depth(state.q);
    result.deepest_mm = std::max(result.deepest_mm, result.depth_mm);
    result.lateral_mm = aside_.dot(state.q.position() - task_.drawn.position());
    result.tilt_rad = state.q.theta_rad - task_.drawn.theta_rad;
    result.travel_mm = state.travel_mm;
    result.contacts = state.contacts;
    mix(result.history, static_cast<std::uint64_t>(outcome) + 1000);
  }

  static constexpr const char* kReaches = "reaches the goal";
  static constexpr const char* kLimit = "reaches the force's limit";

  const InsertionTask& task_;
  const ContactSpace& space_;
  const InsertionOptions& options_;
  Eigen::Vector3d stiffness_, start_ = Eigen::Vector3d::Zero();
  WaysOn ways_;
  Point aside_;
};

}  // namespace

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
  return Inserter(task, options).run(start);
}

Configuration start_with_errors(const InsertionTask& task, double x_mm, double y_mm, double theta_rad) {
  const Point at = task.drawn.position() + x_mm * turned_left(task.approach.direction) + Point(0, y_mm);
  return {at.x(), at.y(), task.drawn.theta_rad + theta_rad};
}

}  // namespace formotion
