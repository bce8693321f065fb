// How much energy the first impact of a fall must take away: what sharpens the set of surely captured starts. Only the
// first place of impact is known; from then on energy does not grow, whatever happens.
#pragma once

#include <optional>

#include "analysis/energy/gravity.hpp"
#include "analysis/motion/contact_law.hpp"
#include "analysis/motion/contact_space.hpp"

namespace formotion {

struct ImpactLaw {
  double restitution = 1;  // of energy (Stronge 1990), at most this
  double friction = 0;     // at most this
  double gyration_mm = 1;  // of the part's mass about its centre
};

// The largest share of its kinetic energy that a part falling along `down` without turning keeps in the impact at one
// contact. With normal n, lever r from the centre of mass, t across n, f the friction and rho the radius of gyration
//
//   1 - (1 - e^2) (n . down)^2 / (1 + (r x n)^2 / rho^2 + f |(r x n) (r x t)| / rho^2).
//
// Derived: restitution of energy gives back e^2 of the work that compression does, and friction takes the rest of what
// is lost. Each unit of normal impulse changes the normal speed by at most a = (1 + ... + f ...) / m, however the
// contact slides or sticks, so compression of a normal speed v does at least v^2 / 2a. 1 where it is not approached.
double share_kept(const ContactPoint& contact, const Point& down, const ImpactLaw& law);

struct Landing {
  Configuration at;
  double energy_mm = 0;  // its height if all energy that it can still have were height
};
// A part let go at rest at `from`, just after its first impact; of contacts that meet at once any may be first. None
// where it overlaps an obstacle at `from`, or falls past all.
std::optional<Landing> landing(const ContactSpace& space, const Gravity& gravity, const Configuration& from,
                               const ImpactLaw& law);

}  // namespace formotion
