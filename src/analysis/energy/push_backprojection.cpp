#include "analysis/energy/push_backprojection.hpp"

#include <cmath>
#include <map>
#include <utility>

#include "analysis/contact/clearance.hpp"
#include "analysis/motion/projection.hpp"

namespace formotion {
namespace {

constexpr double kFarAlong = 1000;  // in reaches of the part: of a translation that never ends

using IsGoal = std::function<bool(const Configuration&)>;

// Of two ways that can both be gone.
Verdict either(Verdict a, Verdict b) { return a == b ? a : Verdict::Possible; }

Verdict leads_to(const Projection& path, const IsGoal& is_goal, double reach_mm) {
  switch (path.end) {
    case ProjectionEnd::AtRest:
      return is_goal(path.last) ? Verdict::Certain : Verdict::Impossible;
    case ProjectionEnd::Steady: {
      const double speed = path.last_twist.linear.norm();
      if (!is_goal(path.last) || !(speed > 0)) return Verdict::Impossible;
      const Point far = path.last.position() + kFarAlong * reach_mm / speed * path.last_twist.linear;
      return is_goal({far.x(), far.y(), path.last.theta_rad}) ? Verdict::Certain : Verdict::Impossible;
    }
    case ProjectionEnd::Ambiguous: {
      if (path.branches.empty()) return Verdict::Possible;  // not followed
      Verdict all = leads_to(path.branches.front(), is_goal, reach_mm);
      for (const Projection& branch : path.branches) all = either(all, leads_to(branch, is_goal, reach_mm));
      if (path.may_rest) all = either(all, is_goal(path.last) ? Verdict::Certain : Verdict::Impossible);
      return all;
    }
    case ProjectionEnd::Undecided:
    case ProjectionEnd::Stopped:
      return Verdict::Possible;  // neither is shown
  }
  return Verdict::Possible;
}

// One set of pushes, many starts.
class Members {
 public:
  Members(const ContactSpace& space, const PushSet& push, const IsGoal& is_goal)
      : space_(space), is_goal_(is_goal), box_{{push.from_rad, push.to_rad}, {push.friction_min, push.friction_max}} {}

  StartOutcome outcome(const Configuration& start) {
    if (!is_free(space_.part, space_.obstacles, start)) return {static_cast<int>(Verdict::Impossible), 0};
    std::uint64_t history = 14695981039346656037u;  // FNV-1a, over members as they are looked at
    const SetOutcome all = outcome_of_set(
        [&](std::span<const double> member) {
          const StartOutcome one = end_of(start, member[0], member[1]);
          history = (history ^ one.history) * 1099511628211u;
          return one;
        },
        box_);
    return {all.is_one ? all.outcome : static_cast<int>(Verdict::Possible), history};
  }

 private:
  StartOutcome end_of(const Configuration& start, double direction_rad, double friction) {
    const Drive drive{{std::cos(direction_rad), std::sin(direction_rad)}, friction};
    ProjectionOptions options;
    options.keep_path = false;
    options.funnels = &funnels_[{direction_rad, friction}];
    const Projection path = project(space_, drive, start, options);
    return {static_cast<int>(leads_to(path, is_goal_, space_.part.reach_mm)), path.history};
  }

  const ContactSpace& space_;
  const IsGoal& is_goal_;
  std::vector<std::pair<double, double>> box_;
  std::map<std::pair<double, double>, Funnels> funnels_;
};

}  // namespace

Verdict ends_in(const ContactSpace& space, const PushSet& push, const Configuration& start, const IsGoal& is_goal) {
  return static_cast<Verdict>(Members(space, push, is_goal).outcome(start).outcome);
}

OutcomeRegion backprojection(const ContactSpace& space, const PushSet& push, const ErrorBox& box,
                             const std::function<Configuration(double, double)>& start, const IsGoal& is_goal,
                             const RegionOptions& options) {
  Members members(space, push, is_goal);
  return outcome_region(
      box, [&](double u, double v) { return members.outcome(start(u, v)); }, options);
}

}  // namespace formotion
