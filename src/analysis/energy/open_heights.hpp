// The heights at which a part may be free, for all places and turns of a cell at once, and whether a straight motion
// is free.
//
// A convex piece P of the part, turned by theta with its centre of mass at q, overlaps a convex obstacle O where
//   n . q < h_O(n) + h_P(theta)(-n)     for the normals n of O,
//   m . q < h_O(m) + d                  for m = -n_e(theta), the normals of P turned, n_e . p = d on P's edge.
// So at one place across, a pair closes one open interval of heights. Its ends are convex and concave across: over a
// range across the ends decide. Over a range of theta each bound is least at an end, where an edge is parallel to one
// of the other piece, or where P's edge touches the circle of radius d about a corner of O: closed forms (derived;
// sampled by tests).
#pragma once

#include <vector>

#include "analysis/energy/convex_cover.hpp"
#include "analysis/energy/gravity.hpp"
#include "analysis/motion/contact_space.hpp"

namespace formotion {

struct RealRange {
  double low = 0, high = 0;
};

// A configuration in axes across gravity and up; turn counts from where the part is drawn in these axes.
struct Place {
  double across_mm = 0, height_mm = 0, turn_rad = 0;
};

class OpenHeights {
 public:
  // Everything given must outlive it. Polygons that stand for round corners miss them by sagitta_mm at most.
  OpenHeights(const ContactSpace& space, const Gravity& gravity, double sagitta_mm);

  Place place_of(const Configuration& q) const;
  Configuration configuration_of(const Place& place) const;

  // The heights, ascending, at which it may be free somewhere in the cell: at all others some piece of the part
  // overlaps one obstacle, everywhere in the cell, by more than kClosed_mm. turn: less than a quarter turn wide.
  std::vector<RealRange> open(const RealRange& across_mm, const RealRange& turn_rad) const;
  // The heights at which it is free (or touches) at one place and turn. Round corners count as larger by the sagitta.
  std::vector<RealRange> free(double across_mm, double turn_rad) const;
  // Whether the straight motion is free or touches all along. Proved: true is certain.
  bool is_straight_free(const Place& from, const Place& to) const;

  static constexpr double kClosed_mm = 1e-7;

 private:
  bool pieces_apart(const ConvexPiece& part, const ConvexPiece& fixed, const Place& from, const Place& to,
                    int depth) const;
  bool is_straight_free_exactly(const Place& from, const Place& to) const;

  const ContactSpace* space_;
  Gravity gravity_;
  double turned_rad_ = 0;  // of the axis across
  bool is_round_ = false;
  std::vector<ConvexPiece> part_, within_, around_;  // obstacles from within and from around
};

}  // namespace formotion
