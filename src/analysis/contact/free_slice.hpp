// The boundary of free space at one orientation: the configuration-space obstacle as a drawing shows it.
#pragma once

#include <optional>
#include <vector>

#include "analysis/contact/contact_pair.hpp"
#include "analysis/contact/facets.hpp"

namespace formotion {

// Where a facet bounds the free positions of the centre of mass. Just beyond it on the right of from -> to positions
// are free, or, in a slot without width, the piece of the slot's other side lies there.
struct SlicePiece {
  ContactPair pair;
  AlongRange along;
  Point from = Point::Zero(), to = Point::Zero();  // the same point: an isolated free position
  // A corner on a round corner: the arc about centre, counter-clockwise from direction from_rad.
  Point centre = Point::Zero();
  double radius_mm = 0;  // 0: straight
  double from_rad = 0, width_rad = 0;
};

struct FreeSlice {
  double theta_rad = 0;
  std::vector<SlicePiece> pieces;
};

// Facets cut at their crossings with each other; a piece bounds free space iff the part, placed at its middle, touches
// without overlapping anything (interiors.hpp). Positions that are free alone (a part that fits in one place only) are
// pieces of no length. Cost: a^2 for the a facets that exist at theta (about n + m for n and m corners, more for
// shapes with many reflex ones), and one overlap test a piece.
FreeSlice free_slice(const MovingShape& part, const Obstacles& obstacles, double theta_rad);

// The point of the slice that is nearest to a position: where a part in there must move to. None where nothing can
// touch (no obstacles). Does not build the slice: looks at near facets first, down to this distance.
struct NearestBoundary {
  ContactPair pair;
  Point position = Point::Zero();
  Point contact = Point::Zero();  // the contact point with the part at `position`
};
std::optional<NearestBoundary> nearest_boundary(const MovingShape& part, const Obstacles& obstacles, double theta_rad,
                                                const Point& position);

}  // namespace formotion
