// All rests of a part among fixed shapes: the local minima of its height over free configurations, without friction.
//
// At a rest the height is also least among the positions of its own orientation. So every rest lies on a branch
// p(theta) of locally lowest positions of the free slices (free_slice.hpp), where its height is least over theta
// (derived).
#pragma once

#include <vector>

#include "analysis/contact/contact_pair.hpp"
#include "analysis/energy/gravity.hpp"
#include "analysis/motion/contact_space.hpp"

namespace formotion {

// A connected set of configurations of one height that have nothing lower nearby; mostly a single point. A level set
// may end where a way leads on down (the verge of a ledge): its interior has nothing lower nearby.
struct Rest {
  Configuration at;  // theta in [0, 2 pi); of a set, a member in its middle
  double height_mm = 0;
  std::vector<ContactPair> contacts;  // at `at`
  std::vector<Configuration> set;     // of a set that is more than a point, its ends, or its four corners in turn (a
                                      // part that turns at one height, on a level floor); else empty
  bool holds(const Configuration& q, double reach_mm, double tolerance_mm) const;  // q belongs to it, that nearly
};

struct RestOptions {
  double grid_rad = 0.017453292519943295;  // slices are at most this apart; orientations of flat contact always are
  double tolerance_mm = 1e-6;              // rests that are nearer are one
};

// Ascending in height, then in theta, then across. Rests of a part that may leave sideways (a flat floor without walls)
// are sets, too. Branches that exist only between two neighbouring slices are missed (grid_rad).
std::vector<Rest> rests(const ContactSpace& space, const Gravity& gravity, const RestOptions& options = {});

}  // namespace formotion
