// A smooth stretch of a part's path on which the same contacts carry.
#pragma once

#include <vector>

#include "analysis/motion/contact_law.hpp"
#include "analysis/motion/contact_space.hpp"

namespace formotion {

inline ContactPoint point_of(const ContactState& state) { return {state.normal, state.lever}; }

class GuidedPath {
 public:
  virtual ~GuidedPath() = default;
  virtual const std::vector<ContactPair>& pairs() const = 0;
  // By the stretch's own parameter, from 0 at its start. Not a number where it cannot be followed so far.
  virtual Configuration at(double h) const = 0;
  // d configuration / d h, with q = at(h).
  virtual Twist rate(double h, const Configuration& q) const = 0;
};

}  // namespace formotion
