// Sequences of belt fences that bring a part into one orientation, by search over sets of orientations with the push
// function (Goldberg 1993 for the search; Berretty, Goldberg, Overmars, van der Stappen 1998 for fences).
//
// The belt runs along +x. A right fence has its material on the right of the belt and rises at its angle to the belt; a
// left fence is its mirror image. Their tips curve until they run along the belt, so that a part leaves with the edge
// that lay on the fence along the belt. Between two fences on the same side the direction of pushing turns by less than
// a right angle, between opposite ones by more: the constraint of Berretty et al.
#pragma once

#include <optional>
#include <vector>

#include "witness/push_function.hpp"

namespace formotion::witness {

enum class FenceSide { Right, Left };

struct Fence {
  FenceSide side = FenceSide::Right;
  double angle_rad = 0;  // to the belt, in (0, pi / 2)
};

struct FencePlan {
  std::vector<Fence> fences;
  double orientation_rad = 0;  // with which every part leaves, up to the part's symmetry
};

struct FencePlanOptions {
  double least_angle_rad = 0.2, greatest_angle_rad = 1.2;
  double margin_rad = 0.01;  // every orientation stays this far from the bounds of the push function
};

// Orientation with which a part that arrives with start_rad leaves a fence with a curved tip.
double after_fence(const Loop& corners, double friction, const Fence& fence, double start_rad);

// A shortest plan. symmetry: the part's rotational order. None if no plan with the margin exists.
std::optional<FencePlan> fence_plan(const Loop& corners, double friction, int symmetry,
                                    const FencePlanOptions& options = {});

// Turn from one facet of a tip to the next, at most: a part whose bounds of the push function are nearer to a rest than
// that may roll on at a tip.
inline constexpr double kTipFacet_rad = 0.14;

struct Belt {
  std::vector<Polygon> fences;
  double end_x_mm = 0;  // beyond the last tip
};

// The fences as solid polygons for a part that starts about the origin and fits in a disc of reach_mm about its centre
// of mass. Each fence is long enough to settle on (settle_mm) and ends in a tip of short facets.
Belt belt(const std::vector<Fence>& fences, double reach_mm, double settle_mm);

}  // namespace formotion::witness
