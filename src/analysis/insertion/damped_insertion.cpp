#include "analysis/insertion/damped_insertion.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/contact/clearance.hpp"
#include "analysis/insertion/inserter.hpp"
#include "analysis/motion/path_step.hpp"
#include "analysis/motion/projection.hpp"

namespace formotion {
namespace inserting {
namespace {

constexpr double kPiece_mm = 0.1;   // of stretches that turn: between two looks at the contacts' law
constexpr int kMostPieces = 64;     // of one stretch
constexpr double kBeside = 1e-4;    // of a piece: clear of the touches at a stretch's ends
constexpr double kSlack_mm = 1e-5;  // stretches within a few contact slacks, on which the law sees other touches, too
constexpr double kAlong = 0.99;     // cosine between a stretch and the motion that makes it
constexpr double kSameDepth_mm = 1e-6;  // legs begin where their contacts are, to within the contact slack
constexpr double kReached_mm = 1e-6;    // as reached() gives

enum class Halt { None, Goal, Travel, Force, Lost };

// What the part does at one place: velocity (mm/s, rad/s), the support's force on it, the contacts.
struct Pace {
  Eigen::Vector3d velocity, force;
  std::vector<CarriedContact> contacts;
};

// The way up to the end of a stretch.
struct Record {
  State state;
  Halt halt = Halt::None;
};

// The first root of a function with f(a) < 0 <= f(b), by halving.
template <class F>
double halved(const F& f, double a, double b) {
  for (int i = 0; i < 60 && b - a > 1e-15; ++i) {
    const double middle = (a + b) / 2;
    (f(middle) < 0 ? a : b) = middle;
  }
  return b;
}

class DampedRun {
 public:
  DampedRun(const InsertionTask& task, const ContactSpace& space, const InsertionOptions& options)
      : task_(task),
        space_(space),
        options_(options),
        b_(task.stiffness.kx_n_per_mm, task.stiffness.ky_n_per_mm, task.stiffness.ktheta_nmm_per_rad),
        drive_(*task.damper_speed_mm_s * task.approach.direction.x(),
               *task.damper_speed_mm_s * task.approach.direction.y(), 0),
        ways_(space, b_, task.friction) {}

  Insertion run(const Configuration& start) {
    State state;
    state.q = start;
    if (!is_free(space_.part, space_.obstacles, start)) {
      state.result.why = "the part overlaps a fixed shape at the start";
      return finished(std::move(state), InsertionOutcome::Blocked).result;
    }
    note(state, {drive_, Eigen::Vector3d::Zero(), {}}, "start");
    if (reached(task_, start) >= 0) return finished(std::move(state), InsertionOutcome::Assembled).result;
    records_.push_back({std::move(state), Halt::None});
    ProjectionOptions options;
    options.max_legs = options_.max_legs;
    options.max_branching = options_.max_branching;
    options.keep_path = false;
    options.watch = [this](const PathStretch& stretch) { return see(stretch); };
    const Projection found = project(space_, {task_.approach.direction, task_.friction}, start, options);
    State end = ended(found);
    end.result.solves = solves_;
    return std::move(end.result);
  }

 private:
  double depth(const Configuration& q) const {
    return task_.approach.direction.dot(q.position() - task_.drawn.position());
  }
  double axial(const Eigen::Vector3d& force) const { return task_.approach.direction.dot(force.head<2>()); }
  double lateral(const Eigen::Vector3d& force) const {
    return turned_left(task_.approach.direction).dot(force.head<2>());
  }

  // Takes the motion of the contacts' law that goes the stretch's way; of several the fastest.
  std::optional<Pace> pace_at(const Configuration& q, const Eigen::Vector3d& way, MotionKind kind) {
    if (kind == MotionKind::Free) return Pace{drive_, Eigen::Vector3d::Zero(), {}};
    ++solves_;
    const Eigen::Vector3d scale = b_.cwiseSqrt();
    const Eigen::Vector3d along = scale.cwiseProduct(way).normalized();
    std::optional<FirstMotion> best;
    double fastest = 0;
    for (const FirstMotion& motion : ways_.first_motions(q, vector_of(q) + drive_)) {
      const Eigen::Vector3d scaled = scale.cwiseProduct(motion.velocity);
      if (along.dot(scaled) < kAlong * scaled.norm() || scaled.norm() <= fastest) continue;
      fastest = scaled.norm();
      best = motion;
    }
    if (!best) return std::nullopt;
    Pace pace{best->velocity, b_.cwiseProduct(drive_ - best->velocity), {}};
    std::vector<ContactPoint> points;
    const double c = std::cos(q.theta_rad), s = std::sin(q.theta_rad);
    for (std::size_t i = 0; i < best->pairs.size(); ++i) {
      const ContactState state = contact_state(space_.part, space_.obstacles, best->pairs[i], q.position(), c, s);
      points.push_back({state.normal, state.lever});
      pace.contacts.push_back({best->pairs[i], q.position() + state.lever, state.normal, best->modes[i], {}});
    }
    MotionLaw law;
    law.load = b_.cwiseProduct(drive_);
    law.mobility = b_.cwiseInverse().asDiagonal();
    law.friction = task_.friction;
    law.length_mm = space_.part.gyration_mm;
    if (const auto motion = motion_of_modes(points, best->modes, law)) {
      for (std::size_t i = 0; i < points.size(); ++i) pace.contacts[i].force = motion->forces[i];
    }
    return pace;
  }

  // Depth grows along every path, for v' B v <= v' B v0: a stretch that begins less deep than the last one ended is the
  // first of another branch.
  State before(const Configuration& from) const {
    for (std::size_t i = records_.size(); i-- > 1;) {
      if (depth(records_[i].state.q) <= depth(from) + kSameDepth_mm) return records_[i].state;
    }
    return records_.front().state;
  }

  std::optional<double> see(const PathStretch& stretch) {
    const Configuration from = stretch.at(0), to = stretch.at(1), middle = stretch.at(0.5);
    Record record{before(from), Halt::None};
    record.state.q = from;
    const bool turns = middle.theta_rad != from.theta_rad || to.theta_rad != from.theta_rad;
    const double size = chord(from, to, space_.part.reach_mm);
    const int pieces = turns ? std::clamp(static_cast<int>(std::ceil(size / kPiece_mm)), 2, kMostPieces) : 1;
    std::optional<double> ends;
    for (int i = 0; i < pieces && !ends && size > 0; ++i)
      ends = piece(record, stretch, turns, double(i) / pieces, double(i + 1) / pieces);
    records_.push_back(std::move(record));
    return ends;
  }

  // One piece of a stretch, on which the velocity counts as that in its middle. Where it ends the run: at which place.
  std::optional<double> piece(Record& record, const PathStretch& stretch, bool turns, double a, double b) {
    State& state = record.state;
    const Configuration from = stretch.at(a), to = stretch.at(b);
    const Eigen::Vector3d way = vector_of(to) - vector_of(from);
    const auto pace_in = [&](double t) { return pace_at(stretch.at(t), way, stretch.motion); };
    const std::optional<Pace> pace = solves_ < options_.most_solves ? pace_in((a + b) / 2) : std::nullopt;
    if (!pace && solves_ < options_.most_solves && chord(from, to, space_.part.reach_mm) < kSlack_mm) {
      state.q = to;
      return std::nullopt;
    }
    if (!pace) {
      state.result.why = solves_ < options_.most_solves
                             ? "its contacts leave no motion along its way"
                             : "it takes more than " + std::to_string(options_.most_solves) + " solutions";
      record.halt = Halt::Lost;
      return a;
    }
    // The carrier goes on meanwhile by its speed times this way over the part's speed.
    const Eigen::Vector3d momentum = b_.cwiseProduct(pace->velocity);
    const double travel = drive_.norm() * way.dot(momentum) / pace->velocity.dot(momentum);
    double end = b;
    const auto halts = [&](double at, Halt halt) {
      if (at > end || (at == end && record.halt != Halt::None)) return;
      end = at;
      record.halt = halt;
    };
    if (const auto at = goal_on(stretch, a, b)) halts(*at, Halt::Goal);
    const double left = task_.approach.distance_mm - state.travel_mm;
    if (travel >= left) halts(a + (b - a) * std::max(0.0, left / travel), Halt::Travel);
    const std::optional<Pace> first = turns ? pace_in(a + kBeside * (b - a)) : pace;
    const std::optional<Pace> last = turns ? pace_in(b - kBeside * (b - a)) : pace;
    if (const auto limit = task_.approach.max_force_n) {
      const auto over = [&](const std::optional<Pace>& at) { return at ? axial(at->force) - *limit : -1.0; };
      if (over(first) >= 0) {
        halts(a, Halt::Force);
      } else if (over(pace) >= 0 || over(last) >= 0) {
        const auto over_at = [&](double t) { return over(pace_in(t)); };
        halts(halved(over_at, a, over(pace) >= 0 ? (a + b) / 2 : b - kBeside * (b - a)), Halt::Force);
      }
    }
    note(state, first ? *first : *pace, a == 0 ? "moves" : "");
    const double share = (end - a) / (b - a);
    state.q = stretch.at(end);
    state.travel_mm += share * travel;
    state.result.work_nmm += axial(pace->force) * share * travel;
    if (share > 0) note(state, *pace, nullptr);
    const char* event = record.halt == Halt::Goal    ? "reaches the goal"
                        : record.halt == Halt::Force ? "reaches the force's limit"
                                                     : "";
    note(state, last && share == 1 ? *last : *pace, event);
    return record.halt == Halt::None ? std::nullopt : std::optional<double>(end);
  }

  // The first place of a piece at which the goal's conditions hold. Along a straight way they do on an interval.
  std::optional<double> goal_on(const PathStretch& stretch, double a, double b) const {
    const auto reached_at = [&](double t) { return reached(task_, stretch.at(t)); };
    if (reached_at(a) >= 0) return a;
    if (reached_at(b) >= 0) return halved(reached_at, a, b);
    const Eigen::Vector3d from = vector_of(stretch.at(a)) - vector_of(task_.drawn);
    const Eigen::Vector3d way = vector_of(stretch.at(b)) - vector_of(task_.drawn) - from;
    double low = 0, high = 1;                           // of the piece
    const auto keep = [&](double value, double rate) {  // value + rate t >= 0
      if (rate > 0) low = std::max(low, -value / rate);
      if (rate < 0) high = std::min(high, value / -rate);
      if (rate == 0 && value < 0) high = -1;
    };
    keep(axial(from) - task_.goal.depth_mm + kReached_mm, axial(way));
    for (const double side : {-1.0, 1.0}) {
      keep(task_.goal.lateral_mm - side * lateral(from) + kReached_mm, -side * lateral(way));
      keep(task_.goal.tilt_rad - side * from[2] + kReached_mm / space_.part.reach_mm, -side * way[2]);
    }
    if (!(low <= high)) return std::nullopt;
    const double inside = a + (b - a) * (low + high) / 2;
    if (reached_at(inside) < 0) return std::nullopt;
    return halved(reached_at, a, inside);
  }

  // event: null where only the peaks count.
  void note(State& state, const Pace& pace, const char* event) const {
    Insertion& result = state.result;
    result.peak_axial_n = std::max(result.peak_axial_n, std::abs(axial(pace.force)));
    result.peak_lateral_n = std::max(result.peak_lateral_n, std::abs(lateral(pace.force)));
    result.deepest_mm = std::max(result.deepest_mm, depth(state.q));
    state.contacts = pace.contacts;
    if (!event || !options_.keep_path) return;
    result.path.push_back({state.travel_mm, state.q, depth(state.q), axial(pace.force), lateral(pace.force),
                           pace.force[2], event, false, pace.contacts});
  }

  State finished(State state, InsertionOutcome outcome) const {
    Insertion& result = state.result;
    state.ends = 1u << static_cast<int>(outcome);
    result.outcome = outcome;
    result.depth_mm = depth(state.q);
    result.deepest_mm = std::max(result.deepest_mm, result.depth_mm);
    result.lateral_mm = turned_left(task_.approach.direction).dot(state.q.position() - task_.drawn.position());
    result.tilt_rad = state.q.theta_rad - task_.drawn.theta_rad;
    result.travel_mm = state.travel_mm;
    result.contacts = state.contacts;
    mix(result.history, static_cast<std::uint64_t>(outcome) + 1000);
    return state;
  }

  State stopped(State state, const char* why) const {
    state.result.why = why;
    const InsertionOutcome outcome = stopped_as(state.contacts, task_.friction, state.is_stopped, state.result.why);
    return finished(std::move(state), outcome);
  }

  // The part rests under the whole force B v0, until the carrier's way or force ends.
  State rested(State state) const {
    const Eigen::Vector3d force = b_.cwiseProduct(drive_);
    const auto contacts = ways_.held(state.q, vector_of(state.q) + drive_);
    const Pace pace{Eigen::Vector3d::Zero(), force, contacts ? *contacts : state.contacts};
    state.is_stopped = true;
    note(state, pace, "rests");
    if (task_.approach.max_force_n && axial(force) >= *task_.approach.max_force_n)
      return stopped(std::move(state), "the force's limit is reached");
    state.result.work_nmm += axial(force) * std::max(0.0, task_.approach.distance_mm - state.travel_mm);
    state.travel_mm = task_.approach.distance_mm;
    note(state, pace, "");
    return stopped(std::move(state), "the carrier's travel ends");
  }

  // The outcome of a path, by what was seen last on the way to its end.
  State ended(const Projection& found) const {
    if (!found.branches.empty()) {
      std::vector<State> ends;
      for (const Projection& branch : found.branches) ends.push_back(ended(branch));
      State state;
      state.result.solves = 0;
      join(state, ends);
      mix(state.result.history, found.history);
      return state;
    }
    const Record* record = nullptr;
    double nearest = 0;
    for (const Record& one : records_) {
      const double apart = chord(one.state.q, found.last, space_.part.reach_mm);
      if (record && apart > nearest) continue;
      record = &one;
      nearest = apart;
    }
    State state = record->state;
    state.q = found.last;
    mix(state.result.history, found.history);
    switch (found.end) {
      case ProjectionEnd::AtRest:
        return rested(std::move(state));
      case ProjectionEnd::Stopped:
        if (record->halt == Halt::Goal) return finished(std::move(state), InsertionOutcome::Assembled);
        if (record->halt == Halt::Travel) return stopped(std::move(state), "the carrier's travel ends");
        if (record->halt == Halt::Force) return stopped(std::move(state), "the force's limit is reached");
        return finished(std::move(state), InsertionOutcome::Undecided);
      case ProjectionEnd::Ambiguous:
        state.result.why = "several motions are consistent with friction, again and again";
        return finished(std::move(state), InsertionOutcome::Ambiguous);
      case ProjectionEnd::Steady:
      case ProjectionEnd::Undecided:
        break;
    }
    // A part in balance on a single contact is no rest to project().
    if (found.end == ProjectionEnd::Undecided && ways_.held(state.q, vector_of(state.q) + drive_))
      return rested(std::move(state));
    state.result.why = found.why.empty() ? "it goes on beyond all shapes" : found.why;
    return finished(std::move(state), InsertionOutcome::Undecided);
  }

  const InsertionTask& task_;
  const ContactSpace& space_;
  const InsertionOptions& options_;
  Eigen::Vector3d b_, drive_;  // the carrier's velocity
  WaysOn ways_;
  std::vector<Record> records_;
  int solves_ = 0;
};

}  // namespace
}  // namespace inserting

Insertion insert_damped(const InsertionTask& task, const Configuration& start, const InsertionOptions& options) {
  const Stiffness& b = task.stiffness;
  if (!(std::abs(b.kx_n_per_mm - b.ky_n_per_mm) <= 1e-9 * b.kx_n_per_mm)) {
    Insertion refused;
    refused.why = "the damper's bx and by differ";
    return refused;
  }
  // project() takes the support's turning from the part's radius of gyration.
  const double gyration = std::sqrt(b.ktheta_nmm_per_rad / b.kx_n_per_mm);
  if (std::abs(task.space->part.gyration_mm - gyration) <= 1e-12 * gyration)
    return inserting::DampedRun(task, *task.space, options).run(start);
  MovingShape part = task.space->part;
  part.gyration_mm = gyration;
  const ContactSpace space(part, task.space->obstacles);
  return inserting::DampedRun(task, space, options).run(start);
}

}  // namespace formotion
