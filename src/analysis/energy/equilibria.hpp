// Static equilibria with friction: of one configuration, and all of a part among fixed shapes (Brost 1991, STATIC),
// under a force through the centre of mass whose direction and friction may be uncertain.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "analysis/motion/contact_law.hpp"
#include "analysis/motion/contact_space.hpp"

namespace formotion {

// Directions counter-clockwise from from_rad to to_rad (at most pi apart; one direction: equal), coefficients of
// friction.
struct PushSet {
  double from_rad = 0, to_rad = 0;
  double friction_min = 0, friction_max = 0;
};

enum class Verdict { Impossible, Possible, Certain };
const char* name(Verdict verdict);

// Certain: contact forces can hold the part for every member of the set (the forces that contacts can hold are a convex
// cone that grows with friction, so the ends decide). Possible: for some member. What may move all the same, where
// several solutions exist, is contact_law.hpp's.
Verdict can_hold(std::span<const ContactPoint> contacts, const PushSet& push, double gyration_mm);

// The largest force, in multiples of the applied force (unit, along `along_rad`), that can be added through the centre
// of mass in the direction towards_rad, and be held; infinite where contacts hold any. And the least of them over all
// directions. Zero where the applied force alone cannot be held.
double resisted(std::span<const ContactPoint> contacts, double along_rad, double friction, double towards_rad);
double least_resisted(std::span<const ContactPoint> contacts, double along_rad, double friction);
// The same for a moment about the centre of mass (N mm for each N of the applied force), either way: the lesser.
double resisted_moment_mm(std::span<const ContactPoint> contacts, double along_rad, double friction);

// A connected set of configurations that can be at rest on two or more contacts (on one contact alone a part
// balances: its height is at a saddle there, but where a corner hangs on a level edge straight over the mass; derived).
struct EquilibriumSet {
  std::vector<Configuration> samples;   // along it, ends included
  Verdict verdict = Verdict::Possible;  // the strongest of its members
  Configuration certain;                // a member with this verdict
  double size_mm = 0;                   // the farthest that a point of the part is apart in two members
};

struct EquilibriaOptions {
  double grid_rad = 0.017453292519943295;
  double join_mm = 0.01;  // ends of curves that are nearer are one
};

// Sets are closed: at an end where a wedge begins, forces have grown beyond all bounds. A set that branches, or comes
// back, lists its pieces one after the other; samples then jump.
std::vector<EquilibriumSet> equilibria(const ContactSpace& space, const PushSet& push,
                                       const EquilibriaOptions& options = {});

}  // namespace formotion
