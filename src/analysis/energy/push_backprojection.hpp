// Which starts surely end in a goal when a part is pushed (or let go) with uncertain direction and friction: Brost's
// BPi, by forward projection of whole sets of pushes. Quasi-static, first order (projection.hpp).
#pragma once

#include <functional>
#include <vector>

#include "analysis/energy/equilibria.hpp"
#include "analysis/insertion/success_region.hpp"
#include "analysis/motion/contact_space.hpp"

namespace formotion {

// Certain: every member of the set that was projected ends in the goal, and none was ambiguous with a way elsewhere;
// Possible: some do; Impossible: none does. Members: the ends of both intervals, and within by their histories
// (outcome_of_set): what is between projected members of one history is taken to share it. A steady translation ends in
// the goal if it begins there and is still there a thousand of the part's reaches on. Paths that are undecided, and
// ambiguities that are not followed, are Possible: neither is shown.
Verdict ends_in(const ContactSpace& space, const PushSet& push, const Configuration& start,
                const std::function<bool(const Configuration&)>& is_goal);

// The starts of a box over (across, theta) at one distance from the goal: a region by verdict, its boundaries located
// (success_region.hpp); outcomes are Verdict's numbers. Starts that overlap obstacles are Impossible. Free starts and
// starts in contact alike.
OutcomeRegion backprojection(const ContactSpace& space, const PushSet& push, const ErrorBox& box,
                             const std::function<Configuration(double across_mm, double theta_rad)>& start,
                             const std::function<bool(const Configuration&)>& is_goal,
                             const RegionOptions& options = {});

}  // namespace formotion
