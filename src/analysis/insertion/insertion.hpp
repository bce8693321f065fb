// Forward projection of one start of a compliant insertion: a part on a spring is carried along an approach into fixed
// shapes, with friction, and its path is followed from event to event.
//
// Quasi-static: K (carrier - q) + sum of contact wrenches = 0 at every place of the carrier, K = diag(kx, ky, ktheta)
// at the compliance centre, along the world's axes (remote centre of compliance: Whitney 1982). Between events the
// contacts keep their modes and q is a smooth function of the carrier's travel. Where no continuous way goes on the
// part snaps: it moves while the carrier stands still (docs/assembly.md).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/motion/contact_law.hpp"
#include "analysis/motion/contact_space.hpp"

namespace formotion {

// Stiffness of the support at the compliance centre, world axes.
struct Stiffness {
  double kx_n_per_mm = 1, ky_n_per_mm = 1, ktheta_nmm_per_rad = 1000;
};

// The carrier's way.
struct Approach {
  Point direction = Point(0, -1);  // unit
  double distance_mm = 0;
  std::optional<double> max_force_n;  // along the approach: reaching it ends the run
};

// Reached as soon as all three hold at once: the travel of the compliance centre along the approach; its offset across
// the approach (either way) and the tilt (either way), both from the drawn pose.
struct SeatedGoal {
  double depth_mm = 0;
  double lateral_mm = 0;
  double tilt_rad = 0;
};

// What is the same for every start. The configuration's reference point is the compliance centre: part and obstacles of
// the space are made relative to it (the part's outline minus the centre).
struct InsertionTask {
  const ContactSpace* space = nullptr;
  Stiffness stiffness;
  double friction = 0;
  Approach approach;
  Configuration drawn;  // the pose of no errors and depth 0
  SeatedGoal goal;
  // The support is a damper whose carrier has this speed: stiffness holds N s/mm and N mm s/rad (damped_insertion.hpp).
  std::optional<double> damper_speed_mm_s = {};
};

enum class InsertionOutcome { Assembled, Wedged, Jammed, Blocked, Ambiguous, Undecided };
inline constexpr int kInsertionOutcomes = 6;
const char* name(InsertionOutcome outcome);  // "assembled", ...

struct CarriedContact {
  ContactPair pair;
  Point point, normal;  // world; the normal points into the part
  ContactMode mode = ContactMode::Stick;
  ContactForce force;  // N: on the part, along the normal and along the normal turned left
};

// One instant of an insertion.
struct InsertionMoment {
  double travel_mm = 0;  // of the carrier
  Configuration q;
  double depth_mm = 0;                   // of the compliance centre along the approach
  double axial_n = 0, lateral_n = 0;     // of the support on the part: along the approach, across (to its left)
  double moment_nmm = 0;                 // about the compliance centre
  std::string event;                     // "start", "touches", ...; empty between events
  bool is_snap = false;                  // the part moves while the carrier stands: forces are not in balance
  std::vector<CarriedContact> contacts;  // that carry
};

struct Insertion {
  InsertionOutcome outcome = InsertionOutcome::Undecided;
  double depth_mm = 0;    // at the end
  double deepest_mm = 0;  // of the way, over all branches
  double lateral_mm = 0, tilt_rad = 0;
  double travel_mm = 0;  // of the carrier, at the end
  // The largest sizes on the way; the carrier's work along the approach, up to the end.
  double peak_axial_n = 0, peak_lateral_n = 0, work_nmm = 0;
  std::uint64_t history = 0;             // of events and modes: equal for starts that go the same way
  std::string why;                       // a sentence: what stopped it, ambiguous between what
  std::vector<CarriedContact> contacts;  // at the end
  std::vector<InsertionMoment> path;     // with keep_path
  int solves = 0;                        // of contact equations: the work done
};

struct InsertionOptions {
  bool keep_path = false;
  int max_legs = 400;
  int most_solves = 20000;  // of contact equations, in one branch: more is undecided
  int max_branching = 3;    // ambiguities in a row that are followed
};

// On a spring or, as the task says, on a damper.
// start: where the part (and with it the carrier) begins. Starts that overlap an obstacle are blocked.
Insertion insert(const InsertionTask& task, const Configuration& start, const InsertionOptions& options = {});

// The pose of a start with errors: turned by theta about the compliance centre, then moved by x_mm across the approach
// (positive to the left of the approach: +x for an approach of -90 degrees) and by y_mm along the world's y.
Configuration start_with_errors(const InsertionTask& task, double x_mm, double y_mm, double theta_rad);

}  // namespace formotion
