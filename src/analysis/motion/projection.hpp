// Forward projection of one start: where a part goes under a constant force, with friction, among fixed obstacles.
//
// First-order (quasi-static) motion: twist = D (force + contact forces), D = diag(1, 1, 1 / gyration^2). The path is
// followed from event to event; between events the part translates, pivots about a sticking contact, slides on a
// facet, or moves along a curve of two contacts.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/contact/contact_pair.hpp"

namespace formotion {

struct Drive {
  Point force = Point(1, 0);  // through the centre of mass; its size does not matter
  double friction = 0;        // at all contacts
};

enum class ProjectionEnd {
  Steady,     // it translates for ever, without meeting anything more
  AtRest,     // an equilibrium
  Ambiguous,  // several consistent motions
  Undecided,  // work limit, or no consistent motion found
  Stopped,    // by the watch
};

enum class MotionKind { Free, Slide, Pivot, Curve, Translation };

struct ActiveContact {
  ContactPair pair;
  Point point, normal;
  bool sticks = false;
};

// What the part does from `start` on until the next leg's start.
struct Leg {
  Configuration start;
  MotionKind motion = MotionKind::Free;
  std::vector<ActiveContact> contacts;  // those that carry or guide
  std::string event;                    // what happened at its start: "start", "touches", "corner", "lifts off", ...
  std::vector<Configuration> between;   // further configurations of the leg, for pictures and support (not the ends)
};

struct Projection {
  ProjectionEnd end = ProjectionEnd::Undecided;
  std::uint64_t history = 0;  // of contacts, motions and events: equal for paths that go the same way
  bool funnelled = false;     // it went along a guided translation of two contacts or more: many starts end alike
  Configuration last;         // at rest, or where the last steady translation begins
  Twist last_twist;           // of the steady translation
  std::vector<Leg> legs;
  std::string why;        // a sentence: ambiguous between what, which limit
  bool may_rest = false;  // Ambiguous: staying is one of the ways
  // Ambiguous: where each of the consistent motions leads (of branches in branches: to some depth). Without legs.
  std::vector<Projection> branches;
};

// A stretch of a path, at(0) to at(1). A last, steady translation is one that goes on far beyond all obstacles.
struct PathStretch {
  MotionKind motion = MotionKind::Free;
  std::function<Configuration(double)> at;
};
// Sees every stretch in turn; where it says so (0 to 1) the path ends: support lost, a gate shut.
using PathWatch = std::function<std::optional<double>(const PathStretch&)>;

// Ends of paths that are known by the place where a guided translation ends: many starts run into few of these.
// Valid for one space, drive and watch.
struct Funnels;

struct ProjectionOptions {
  int max_legs = 2000;
  int max_branching = 3;  // how many ambiguities in a row are followed
  bool keep_path = true;  // legs with their configurations in between
  PathWatch watch;
  Funnels* funnels = nullptr;  // without keep_path
};

struct Funnels {
  struct Funnel {
    std::vector<ContactPair> pairs;
    Configuration mouth;
    Projection end;
  };
  std::vector<Funnel> known;
};

// Prepared once for many starts (contact_space.hpp).
struct ContactSpace;
Projection project(const ContactSpace& space, const Drive& drive, const Configuration& start,
                   const ProjectionOptions& options = {});
Projection project(const MovingShape& part, const Obstacles& obstacles, const Drive& drive, const Configuration& start,
                   const ProjectionOptions& options = {});

}  // namespace formotion
