// How insert() follows one start: the state of a way, and what it does next. Shared by the files that make it
// (insertion.cpp: choices and outcomes; insertion_legs.cpp: legs and rest; insertion_snaps.cpp).
#pragma once

#include <vector>

#include "analysis/insertion/ways_on.hpp"

namespace formotion::inserting {

inline constexpr double kLookAhead_mm = 2e-5;  // of the carrier

// FNV-1a
inline void mix(std::uint64_t& history, std::uint64_t word) { history = (history ^ word) * 1099511628211ull; }

// Where the carrier goes, and on what spring: the real way, or a ride while the part snaps.
struct Stretch {
  Eigen::Vector3d stiffness;
  CarrierLine line;
  double length = 0;  // of the line
  bool is_real = true;
};

enum class Ride { Arrived, Event, Ended, Broken };  // Ended: the outcome is there

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
  // What touched where it last had the choice to rest: rest and the ways beside it have been followed from there, and
  // are not again while the same features touch.
  std::vector<ContactPair> left_rest;
  std::vector<CarriedContact> contacts;
  unsigned ends = 0;  // a bit for every outcome that it may come to
  Insertion result;
};

// The worst end stands for all; different outcomes are ambiguous.
void join(State& state, std::vector<State>& ends);

// Why a part comes to no goal that stands (is_stopped) or still moves on these contacts. Adds to `why`.
InsertionOutcome stopped_as(const std::vector<CarriedContact>& contacts, double friction, bool is_stopped,
                            std::string& why);

// How much is left of the goal's three conditions; not negative once it is reached.
double reached(const InsertionTask& task, const Configuration& q);

class Inserter {
 public:
  Inserter(const InsertionTask& task, const InsertionOptions& options)
      : task_(task),
        space_(*task.space),
        options_(options),
        stiffness_(task.stiffness.kx_n_per_mm, task.stiffness.ky_n_per_mm, task.stiffness.ktheta_nmm_per_rad),
        ways_(space_, stiffness_, task.friction),
        aside_(turned_left(task.approach.direction)) {}
  Insertion run(const Configuration& start);

 private:
  Eigen::Vector3d carrier(double travel) const {
    const Point& d = task_.approach.direction;
    return start_ + travel * Eigen::Vector3d(d.x(), d.y(), 0);
  }
  double depth(const Configuration& q) const {
    return task_.approach.direction.dot(q.position() - task_.drawn.position());
  }
  double reached(const Configuration& q) const { return inserting::reached(task_, q); }

  // The real carrier's way, until an outcome.
  void follow(State& state, int branching) const;

  // Goes one way to its end.
  Went take(State& state, Continuation& way, const Stretch& stretch) const {
    return way.leg ? slide(state, *way.leg, stretch) : rest(state, stretch);
  }

  bool has_left_rest(const State& state) const {
    return !state.left_rest.empty() && state.left_rest == touching(state.q);
  }
  std::vector<ContactPair> touching(const Configuration& q) const;

  // The first motions of snaps, less those that are the beginning of a continuous way.
  std::vector<FirstMotion> falls_beside(const Configuration& q, const std::vector<Continuation>& ways,
                                        const Eigen::Vector3d& at) const;
  // The cosine between two motions.
  double likeness(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
    const Eigen::Vector3d scale(1, 1, space_.part.reach_mm);
    return scale.cwiseProduct(a).normalized().dot(scale.cwiseProduct(b).normalized());
  }

  void branch(State& state, std::vector<Continuation>& ways, const std::vector<FirstMotion>& falls,
              const Stretch& stretch, int branching) const;

  // The part's way while the carrier all but stands. False: the outcome is there.
  bool snap(State& state, int branching) const;

  // A snap from one contact to the next, until the part rests or is in balance: every first motion is that of a part
  // whose damping is as its stiffness (D = 1 / K). It is followed by steps in time, each one the way to where spring,
  // damper and contacts are in balance at its end: a ride on a spring that is stiffer by the damper's share. As long a
  // step as can be followed is taken; where the way folds back on itself a short one.
  bool fall(State& state, int branching, bool is_begun) const;

  void several_falls(State& state, const std::vector<FirstMotion>& motions, bool may_rest, int branching) const;

  // Where the part ends that begins to fall with this motion.
  State fallen(State state, const FirstMotion& motion, int branching) const;

  // One leg of a snap. Broken: there is none.
  Ride ride(State& state, const Eigen::Vector3d& home, const FirstMotion& motion, double stiffer) const;

  // The part stands while the carrier goes on, as long as forces can hold it: they do for an interval of the carrier's
  // places, since cones are convex.
  Went rest(State& state, const Stretch& stretch) const;

  double axial(const Eigen::Vector3d& force) const {
    return task_.approach.direction.x() * force[0] + task_.approach.direction.y() * force[1];
  }
  double lateral(const Eigen::Vector3d& force) const { return aside_.x() * force[0] + aside_.y() * force[1]; }

  // The carrier's work on a step, and the largest forces on it: both may lie between its ends.
  template <class At>
  void add_work(State& state, const CarrierLine& line, double from, double to, const At& at) const;

  Went slide(State& state, const CompliantLeg& leg, const Stretch& stretch) const;

  std::vector<CarriedContact> carried_by(const CompliantLeg& leg, double h, const Configuration& q) const;

  // The support's force: a snap's damper is no part of it.
  Eigen::Vector3d supported(const State& state, const Stretch& stretch, double h) const {
    return spring_load(stiffness_, stretch.is_real ? stretch.line.at(h) : carrier(state.travel_mm), state.q);
  }

  // Takes down an instant, with the spring's force: peaks always, the path if it is kept.
  void note(State& state, const Eigen::Vector3d& force, const char* event, std::vector<CarriedContact> contacts,
            bool is_snap = false) const;

  void stop(State& state, const std::string& why) const;

  void finish(State& state, InsertionOutcome outcome) const;

  static constexpr const char* kReaches = "reaches the goal";
  static constexpr const char* kLimit = "reaches the force's limit";

  const InsertionTask& task_;
  const ContactSpace& space_;
  const InsertionOptions& options_;
  Eigen::Vector3d stiffness_, start_ = Eigen::Vector3d::Zero();
  WaysOn ways_;
  Point aside_;
};

}  // namespace formotion::inserting
