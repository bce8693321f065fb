#include "analysis/motion/contact_space.hpp"

#include <algorithm>
#include <limits>

namespace formotion {
namespace {

bool overlap(const Box& a, const Box& b) {
  return a.min.x() <= b.max.x() && b.min.x() <= a.max.x() && a.min.y() <= b.max.y() && b.min.y() <= a.max.y();
}

int end_of(const std::vector<int>& begin, const std::vector<int>& end, int edge, const ContactState& state) {
  // Contacts that have run off an edge stand beyond its end by up to the contact slack.
  if (state.along_mm <= 3 * kContact_mm) return begin[edge];
  if (state.along_mm >= state.extent_mm - 3 * kContact_mm) return end[edge];
  return -1;
}

}  // namespace

ContactSpace::ContactSpace(const MovingShape& moving, const Obstacles& fixed)
    : part(moving),
      obstacles(fixed),
      fixed_begin(fixed.edges.size(), -1),
      fixed_end(fixed.edges.size(), -1),
      moving_begin(moving.edges.size(), -1),
      moving_end(moving.edges.size(), -1) {
  const std::size_t fixed_edges = fixed.edges.size(), fixed_corners = fixed.corners.size();
  const std::size_t none = std::numeric_limits<std::size_t>::max();
  table_[0].assign(moving.corners.size() * fixed_edges, none);
  table_[1].assign(moving.edges.size() * fixed_corners, none);
  table_[2].assign(moving.corners.size() * fixed_corners, none);
  for (const ContactPair& pair : contact_pairs(part, obstacles)) {
    const auto range = contact_orientations(part, obstacles, pair);
    if (!range) continue;
    const std::size_t row = pair.kind == ContactKind::CornerOnEdge ? fixed_edges : fixed_corners;
    table_[static_cast<int>(pair.kind)][pair.moving * row + pair.fixed] = pairs.size();
    pairs.push_back(pair);
    orientations.push_back(*range);
  }
  for (const FixedEdge& edge : obstacles.edges) {
    edge_boxes.emplace_back();
    edge_boxes.back().include(edge.from);
    edge_boxes.back().include(edge.to);
  }
  for (int i = 0; i < static_cast<int>(obstacles.corners.size()); ++i) {
    const FixedCorner& corner = obstacles.corners[i];
    const Point radius = Point::Constant(corner.radius_mm);
    corner_boxes.push_back({corner.centre - radius, corner.centre + radius});
    if (corner.edge_after) fixed_begin[*corner.edge_after] = i;
    if (corner.edge_before) fixed_end[*corner.edge_before] = i;
  }
  for (int i = 0; i < static_cast<int>(part.corners.size()); ++i) {
    moving_begin[part.corners[i].edge_after] = i;
    moving_end[part.corners[i].edge_before] = i;
  }
}

std::size_t ContactSpace::index_of(const ContactPair& pair) const {
  const std::size_t row = pair.kind == ContactKind::CornerOnEdge ? obstacles.edges.size() : obstacles.corners.size();
  return std::min(pairs.size(), table_[static_cast<int>(pair.kind)][pair.moving * row + pair.fixed]);
}

std::vector<std::size_t> ContactSpace::pairs_of(const CornerMeeting& meeting) const {
  const MovingCorner& moving = part.corners[meeting.moving];
  const FixedCorner& fixed = obstacles.corners[meeting.fixed];
  std::vector<std::size_t> found;
  const auto add = [&](ContactKind kind, int a, std::optional<int> b) {
    if (const std::size_t i = b ? index_of({kind, a, *b}) : pairs.size(); i < pairs.size()) found.push_back(i);
  };
  add(ContactKind::CornerOnEdge, meeting.moving, fixed.edge_before);
  add(ContactKind::CornerOnEdge, meeting.moving, fixed.edge_after);
  add(ContactKind::EdgeOnCorner, moving.edge_before, meeting.fixed);
  add(ContactKind::EdgeOnCorner, moving.edge_after, meeting.fixed);
  add(ContactKind::CornerOnCorner, meeting.moving, meeting.fixed);
  return found;
}

bool can_touch(const ContactSpace& space, std::size_t pair_index, const ContactState& state, double theta_rad) {
  if (state.along_mm < -kContact_mm || state.along_mm > state.extent_mm + kContact_mm) return false;
  if (!space.orientations[pair_index].contains(theta_rad, kContact_rad)) return false;
  const ContactPair& pair = space.pairs[pair_index];
  if (pair.kind != ContactKind::CornerOnCorner) return true;
  const double facing = std::atan2(-state.normal.y(), -state.normal.x()) - theta_rad;
  return space.part.corners[pair.moving].normals.contains(facing, kContact_rad);
}

CornerMeeting meeting_of(const ContactSpace& space, const Touch& touch) {
  const auto& [pair, state] = touch;
  switch (pair.kind) {
    case ContactKind::CornerOnEdge:
      return {pair.moving, end_of(space.fixed_begin, space.fixed_end, pair.fixed, state)};
    case ContactKind::EdgeOnCorner:
      return {end_of(space.moving_begin, space.moving_end, pair.moving, state), pair.fixed};
    case ContactKind::CornerOnCorner:
      return {pair.moving, pair.fixed};
  }
  return {};
}

std::vector<TouchCluster> touches_at(const ContactSpace& space, const Configuration& q) {
  const double c = std::cos(q.theta_rad), s = std::sin(q.theta_rad);
  const Point reach = Point::Constant(space.part.reach_mm + 2 * kContact_mm);
  const Box around{q.position() - reach, q.position() + reach};
  std::vector<TouchCluster> clusters;
  std::vector<CornerMeeting> meetings;
  for (std::size_t i = 0; i < space.pairs.size(); ++i) {
    const ContactPair& pair = space.pairs[i];
    const Box& box =
        pair.kind == ContactKind::CornerOnEdge ? space.edge_boxes[pair.fixed] : space.corner_boxes[pair.fixed];
    if (!overlap(box, around)) continue;
    const ContactState state = contact_state(space.part, space.obstacles, pair, q.position(), c, s);
    if (std::abs(state.gap_mm) > kContact_mm || !can_touch(space, i, state, q.theta_rad)) continue;
    const Touch touch{pair, state};
    const CornerMeeting meeting = meeting_of(space, touch);
    bool joined = false;
    if (meeting.is_one()) {
      for (std::size_t k = 0; k < clusters.size() && !joined; ++k) {
        if (meetings[k] != meeting) continue;
        clusters[k].push_back(touch);
        joined = true;
      }
    }
    if (joined) continue;
    clusters.push_back({touch});
    meetings.push_back(meeting);
  }
  return clusters;
}

}  // namespace formotion
