// What of a part can touch what of the obstacles, ready for many configurations; and the contacts at one of them.
#pragma once

#include <vector>

#include "analysis/contact/contact_pair.hpp"

namespace formotion {

inline constexpr double kContact_mm = 1e-7;   // features nearer than this touch
inline constexpr double kContact_rad = 1e-8;  // slack of the orientations at which they can

// Both shapes must outlive it.
struct CornerMeeting;
struct ContactSpace {
  const MovingShape& part;
  const Obstacles& obstacles;
  std::vector<ContactPair> pairs;
  std::vector<DirectionRange> orientations;  // of each pair
  std::vector<Box> edge_boxes;               // of the fixed edges
  std::vector<Box> corner_boxes;             // of the fixed corners, with their radius
  // Convex corners at the ends of edges; -1 where the corner is not convex.
  std::vector<int> fixed_begin, fixed_end, moving_begin, moving_end;

  ContactSpace(const MovingShape& moving, const Obstacles& fixed);
  // Places in pairs of all that can touch where two convex corners meet: five at most.
  std::vector<std::size_t> pairs_of(const CornerMeeting& meeting) const;
  std::size_t index_of(const ContactPair& pair) const;  // its place in pairs; pairs.size() if there is none

 private:
  std::vector<std::size_t> table_[3];  // by kind: moving times the number of fixed ones plus fixed
};

struct Touch {
  ContactPair pair;
  ContactState state;
};

// Touches at one place: alternatives, where a convex corner meets a convex corner. The shapes do not overlap there as
// long as one of the alternatives' gaps is not negative; at most one of them carries. Elsewhere a single touch.
using TouchCluster = std::vector<Touch>;

// The convex corners that meet at a touch; -1 where it is in the middle of an edge, or the corner there not convex.
struct CornerMeeting {
  int moving = -1, fixed = -1;
  bool is_one() const { return moving >= 0 && fixed >= 0; }
  bool operator==(const CornerMeeting&) const = default;
};
CornerMeeting meeting_of(const ContactSpace& space, const Touch& touch);

// The clusters of all features that touch at a configuration (they are taken as not overlapping).
std::vector<TouchCluster> touches_at(const ContactSpace& space, const Configuration& q);

// Whether a touching pair's orientations and place on its features allow the contact, with the contact slack.
bool can_touch(const ContactSpace& space, std::size_t pair_index, const ContactState& state, double theta_rad);

}  // namespace formotion
