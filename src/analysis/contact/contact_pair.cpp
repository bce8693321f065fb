#include "analysis/contact/contact_pair.hpp"

#include <numbers>

namespace formotion {
namespace {

constexpr double kPi = std::numbers::pi;
double angle(const Point& direction) { return std::atan2(direction.y(), direction.x()); }

}  // namespace

ContactState contact_state(const MovingShape& part, const Obstacles& obstacles, const ContactPair& pair,
                           const Point& position, double c, double s) {
  ContactState state;
  switch (pair.kind) {
    case ContactKind::CornerOnEdge: {
      const FixedEdge& edge = obstacles.edges[pair.fixed];
      state.lever = rotated(part.corners[pair.moving].at, c, s);
      const Point from_start = position + state.lever - edge.from;
      state.normal = edge.normal;
      state.gap_mm = edge.normal.dot(from_start);
      state.along_mm = edge.along.dot(from_start);
      state.extent_mm = edge.length_mm;
      break;
    }
    case ContactKind::EdgeOnCorner: {
      const MovingEdge& edge = part.edges[pair.moving];
      const FixedCorner& corner = obstacles.corners[pair.fixed];
      const Point normal = rotated(edge.normal, c, s), to_centre = corner.centre - position;
      state.normal = -normal;
      state.lever = to_centre - corner.radius_mm * normal;
      state.gap_mm = normal.dot(to_centre) - edge.normal.dot(edge.from) - corner.radius_mm;
      state.along_mm = rotated(edge.along, c, s).dot(to_centre) - edge.along.dot(edge.from);
      state.extent_mm = edge.length_mm;
      break;
    }
    case ContactKind::CornerOnCorner: {
      const FixedCorner& corner = obstacles.corners[pair.fixed];
      state.lever = rotated(part.corners[pair.moving].at, c, s);
      const Point from_centre = position + state.lever - corner.centre;
      const double distance = from_centre.norm();
      state.normal = distance > 0 ? Point(from_centre / distance) : Point(1, 0);
      state.gap_mm = distance - corner.radius_mm;
      const double half = corner.normals.width_rad / 2;
      const double off = std::remainder(angle(state.normal) - corner.normals.from_rad - half, 2 * kPi);
      state.along_mm = (off + half) * corner.radius_mm;
      state.extent_mm = 2 * half * corner.radius_mm;
      break;
    }
  }
  return state;
}

std::optional<DirectionRange> contact_orientations(const MovingShape& part, const Obstacles& obstacles,
                                                   const ContactPair& pair) {
  switch (pair.kind) {
    case ContactKind::CornerOnEdge: {
      const DirectionRange& cone = part.corners[pair.moving].normals;
      const double facing = angle(obstacles.edges[pair.fixed].normal) + kPi;
      return DirectionRange{facing - cone.from_rad - cone.width_rad, cone.width_rad};
    }
    case ContactKind::EdgeOnCorner: {
      const DirectionRange& cone = obstacles.corners[pair.fixed].normals;
      return DirectionRange{cone.from_rad - kPi - angle(part.edges[pair.moving].normal), cone.width_rad};
    }
    case ContactKind::CornerOnCorner: {
      const DirectionRange& moving = part.corners[pair.moving].normals;
      const DirectionRange& fixed = obstacles.corners[pair.fixed].normals;
      if (obstacles.corners[pair.fixed].radius_mm <= 0) return std::nullopt;
      const double width = std::min(2 * kPi, moving.width_rad + fixed.width_rad);
      return DirectionRange{fixed.from_rad + kPi - moving.from_rad - moving.width_rad, width};
    }
  }
  return std::nullopt;
}

std::vector<ContactPair> contact_pairs(const MovingShape& part, const Obstacles& obstacles) {
  std::vector<ContactPair> pairs;
  const int moving_corners = static_cast<int>(part.corners.size()), moving_edges = static_cast<int>(part.edges.size());
  const int fixed_corners = static_cast<int>(obstacles.corners.size());
  for (int i = 0; i < moving_corners; ++i) {
    for (int j = 0; j < static_cast<int>(obstacles.edges.size()); ++j) {
      if (obstacles.edges[j].length_mm > 0) pairs.push_back({ContactKind::CornerOnEdge, i, j});
    }
  }
  for (int i = 0; i < moving_edges; ++i) {
    for (int j = 0; j < fixed_corners; ++j) pairs.push_back({ContactKind::EdgeOnCorner, i, j});
  }
  for (int i = 0; i < moving_corners; ++i) {
    for (int j = 0; j < fixed_corners; ++j) {
      if (obstacles.corners[j].radius_mm > 0) pairs.push_back({ContactKind::CornerOnCorner, i, j});
    }
  }
  return pairs;
}

}  // namespace formotion
