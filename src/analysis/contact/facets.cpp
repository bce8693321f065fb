#include "analysis/contact/facets.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace formotion {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kAngle_rad = 1e-12;  // orientations a rounding beyond their range
constexpr double kStretch_mm = 1e-9;  // boundaries that share less have a point in common, no stretch
constexpr double kStretch_rad = 1e-9;

Point direction(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

bool is_full(const DirectionRange& range) { return range.width_rad >= 2 * kPi; }

// What two ranges of less than a turn in all have in common.
std::optional<DirectionRange> common(const DirectionRange& a, const DirectionRange& b) {
  const double middles = std::remainder(b.from_rad + b.width_rad / 2 - a.from_rad - a.width_rad / 2, 2 * kPi);
  const double b_from = a.from_rad + a.width_rad / 2 + middles - b.width_rad / 2;
  const double from = std::max(a.from_rad, b_from), to = std::min(a.from_rad + a.width_rad, b_from + b.width_rad);
  if (to - from <= kStretch_rad) return std::nullopt;
  return DirectionRange{from, to - from};
}

// Which facet a pair is, and which corners the edges end at.
struct Lookup {
  const MovingShape& part;
  const Obstacles& obstacles;
  std::vector<int> corner_on_edge, edge_on_corner, corner_on_corner;  // tables moving x fixed; -1: none
  std::vector<int> moving_start, moving_end, fixed_start, fixed_end;  // corner at an edge's end; -1: not convex

  Lookup(const MovingShape& p, const Obstacles& o, const std::vector<ContactFacet>& facets)
      : part(p),
        obstacles(o),
        corner_on_edge(p.corners.size() * o.edges.size(), -1),
        edge_on_corner(p.edges.size() * o.corners.size(), -1),
        corner_on_corner(p.corners.size() * o.corners.size(), -1),
        moving_start(p.edges.size(), -1),
        moving_end(p.edges.size(), -1),
        fixed_start(o.edges.size(), -1),
        fixed_end(o.edges.size(), -1) {
    for (std::size_t k = 0; k < facets.size(); ++k) *slot(facets[k].pair) = static_cast<int>(k);
    for (std::size_t k = 0; k < p.corners.size(); ++k) {
      moving_start[p.corners[k].edge_after] = moving_end[p.corners[k].edge_before] = static_cast<int>(k);
    }
    for (std::size_t k = 0; k < o.corners.size(); ++k) {
      if (o.corners[k].edge_after) fixed_start[*o.corners[k].edge_after] = static_cast<int>(k);
      if (o.corners[k].edge_before) fixed_end[*o.corners[k].edge_before] = static_cast<int>(k);
    }
  }

  int* slot(const ContactPair& pair) {
    const std::size_t row = static_cast<std::size_t>(pair.moving), column = static_cast<std::size_t>(pair.fixed);
    switch (pair.kind) {
      case ContactKind::CornerOnEdge:
        return &corner_on_edge[row * obstacles.edges.size() + column];
      case ContactKind::EdgeOnCorner:
        return &edge_on_corner[row * obstacles.corners.size() + column];
      default:
        return &corner_on_corner[row * obstacles.corners.size() + column];
    }
  }
};

struct FacetEnd {
  int facet;
  FacetSide side;
};

// A list of facet sides that lie on one curve; nothing is added for features that are not there.
struct Meeting {
  Lookup& lookup;
  std::array<FacetEnd, 4> ends{};
  int count = 0;
  void add(ContactKind kind, std::optional<int> moving, std::optional<int> fixed, FacetSide side) {
    if (!moving || !fixed || *moving < 0 || *fixed < 0) return;
    const int facet = *lookup.slot({kind, *moving, *fixed});
    if (facet >= 0) ends[count++] = {facet, side};
  }
};

// The facets that end where a corner of the part is on a fixed corner; of a round one, on its facet `along` and theta.
Meeting at_corners(Lookup& lookup, int moving, int fixed) {
  Meeting meeting{lookup};
  const MovingCorner& a = lookup.part.corners[moving];
  const FixedCorner& b = lookup.obstacles.corners[fixed];
  meeting.add(ContactKind::CornerOnEdge, moving, b.edge_before, FacetSide::AlongEnd);
  meeting.add(ContactKind::CornerOnEdge, moving, b.edge_after, FacetSide::AlongStart);
  meeting.add(ContactKind::EdgeOnCorner, a.edge_before, fixed, FacetSide::AlongEnd);
  meeting.add(ContactKind::EdgeOnCorner, a.edge_after, fixed, FacetSide::AlongStart);
  return meeting;
}

// The facets that end where an edge of the part lies on a fixed edge.
Meeting at_edges(Lookup& lookup, int moving, int fixed) {
  Meeting meeting{lookup};
  meeting.add(ContactKind::CornerOnEdge, lookup.moving_start[moving], fixed, FacetSide::ThetaStart);
  meeting.add(ContactKind::CornerOnEdge, lookup.moving_end[moving], fixed, FacetSide::ThetaEnd);
  meeting.add(ContactKind::EdgeOnCorner, moving, lookup.fixed_start[fixed], FacetSide::ThetaEnd);
  meeting.add(ContactKind::EdgeOnCorner, moving, lookup.fixed_end[fixed], FacetSide::ThetaStart);
  return meeting;
}

FacetBoundary& side_of(ContactFacet& facet, FacetSide side) { return facet.boundary[static_cast<std::size_t>(side)]; }

void join_on_helix(std::vector<ContactFacet>& facets, const Meeting& meeting) {
  for (int i = 0; i < meeting.count; ++i) {
    for (int j = 0; j < meeting.count; ++j) {
      if (i == j) continue;
      const FacetEnd &one = meeting.ends[i], &other = meeting.ends[j];
      if (const auto both = common(facets[one.facet].orientations, facets[other.facet].orientations)) {
        side_of(facets[one.facet], one.side).neighbours.push_back({other.facet, other.side, *both});
      }
    }
  }
}

void join_on_line(std::vector<ContactFacet>& facets, const Meeting& meeting, const Point& along) {
  const auto stretch = [&](const FacetEnd& end) {
    const FacetBoundary& boundary = side_of(facets[end.facet], end.side);
    const double a = along.dot(boundary.from.position()), b = along.dot(boundary.to.position());
    return std::pair(std::min(a, b), std::max(a, b));
  };
  for (int i = 0; i < meeting.count; ++i) {
    for (int j = 0; j < meeting.count; ++j) {
      if (i == j) continue;
      const FacetEnd &one = meeting.ends[i], &other = meeting.ends[j];
      const auto [a0, a1] = stretch(one);
      const auto [b0, b1] = stretch(other);
      if (std::min(a1, b1) - std::max(a0, b0) <= kStretch_mm) continue;
      FacetBoundary& boundary = side_of(facets[one.facet], one.side);
      boundary.neighbours.push_back({other.facet, other.side, {boundary.from.theta_rad, 0}});
    }
  }
}

// A round corner's facet goes over into those of its edges and of the touching corner's edges.
void join_round(std::vector<ContactFacet>& facets, int round, const Meeting& meeting) {
  for (int i = 0; i < meeting.count; ++i) {
    const FacetEnd& end = meeting.ends[i];
    const bool corner = facets[end.facet].pair.kind == ContactKind::CornerOnEdge;
    const bool start = end.side == FacetSide::AlongStart;
    const FacetSide own = corner ? (start ? FacetSide::AlongEnd : FacetSide::AlongStart)
                                 : (start ? FacetSide::ThetaStart : FacetSide::ThetaEnd);
    const DirectionRange& where = facets[end.facet].orientations;
    side_of(facets[round], own).neighbours.push_back({end.facet, end.side, where});
    side_of(facets[end.facet], end.side).neighbours.push_back({round, own, where});
  }
}

void set_boundaries(const MovingShape& part, const Obstacles& obstacles, ContactFacet& facet) {
  const double start = facet.orientations.from_rad, end = start + facet.orientations.width_rad;
  const auto set = [&](FacetSide side, double theta_from, double theta_to, double along_from, double along_to) {
    FacetBoundary& boundary = side_of(facet, side);
    boundary.horizontal = theta_from == theta_to;
    boundary.from = configuration_on(part, obstacles, facet.pair, theta_from, along_from);
    boundary.to = configuration_on(part, obstacles, facet.pair, theta_to, along_to);
    boundary.along_from_mm = along_from;
    boundary.along_to_mm = along_to;
  };
  const auto none = [&](FacetSide side) { side_of(facet, side).exists = false; };
  if (facet.pair.kind != ContactKind::CornerOnCorner) {
    set(FacetSide::AlongStart, start, end, 0, 0);
    set(FacetSide::AlongEnd, start, end, facet.extent_mm, facet.extent_mm);
    if (is_full(facet.orientations)) {
      none(FacetSide::ThetaStart);
      none(FacetSide::ThetaEnd);
    } else {
      set(FacetSide::ThetaStart, start, start, 0, facet.extent_mm);
      set(FacetSide::ThetaEnd, end, end, 0, facet.extent_mm);
    }
    return;
  }
  // Direction on the round corner = theta + direction on the part's corner - pi: a parallelogram.
  const double moving = part.corners[facet.pair.moving].normals.width_rad;
  const double fixed = obstacles.corners[facet.pair.fixed].normals.width_rad;
  if (is_full({0, fixed})) {
    none(FacetSide::AlongStart);
    none(FacetSide::AlongEnd);
  } else {
    set(FacetSide::AlongStart, start, start + moving, 0, 0);
    set(FacetSide::AlongEnd, start + fixed, start + fixed + moving, facet.extent_mm, facet.extent_mm);
  }
  set(FacetSide::ThetaStart, start, start + fixed, 0, facet.extent_mm);
  set(FacetSide::ThetaEnd, start + moving, start + moving + fixed, 0, facet.extent_mm);
}

double extent(const MovingShape& part, const Obstacles& obstacles, const ContactPair& pair) {
  switch (pair.kind) {
    case ContactKind::CornerOnEdge:
      return obstacles.edges[pair.fixed].length_mm;
    case ContactKind::EdgeOnCorner:
      return part.edges[pair.moving].length_mm;
    default:
      return obstacles.corners[pair.fixed].radius_mm * obstacles.corners[pair.fixed].normals.width_rad;
  }
}

}  // namespace

std::vector<ContactFacet> contact_facets(const MovingShape& part, const Obstacles& obstacles) {
  std::vector<ContactFacet> facets;
  for (const ContactPair& pair : contact_pairs(part, obstacles)) {
    const auto orientations = contact_orientations(part, obstacles, pair);
    if (!orientations) continue;
    facets.push_back({pair, *orientations, extent(part, obstacles, pair), {}});
    set_boundaries(part, obstacles, facets.back());
  }
  Lookup lookup(part, obstacles, facets);
  for (int i = 0; i < static_cast<int>(part.corners.size()); ++i) {
    for (int j = 0; j < static_cast<int>(obstacles.corners.size()); ++j) {
      const Meeting meeting = at_corners(lookup, i, j);
      const int round = *lookup.slot({ContactKind::CornerOnCorner, i, j});
      round >= 0 ? join_round(facets, round, meeting) : join_on_helix(facets, meeting);
    }
  }
  for (int i = 0; i < static_cast<int>(part.edges.size()); ++i) {
    for (int j = 0; j < static_cast<int>(obstacles.edges.size()); ++j) {
      join_on_line(facets, at_edges(lookup, i, j), obstacles.edges[j].along);
    }
  }
  return facets;
}

std::vector<AlongRange> along_ranges(const MovingShape& part, const Obstacles& obstacles, const ContactPair& pair,
                                     double theta_rad) {
  const auto orientations = contact_orientations(part, obstacles, pair);
  if (!orientations || !orientations->contains(theta_rad, kAngle_rad)) return {};
  if (pair.kind != ContactKind::CornerOnCorner) return {{0, extent(part, obstacles, pair)}};
  const FixedCorner& corner = obstacles.corners[pair.fixed];
  const DirectionRange& normals = part.corners[pair.moving].normals;
  // Directions in which the part's corner faces the round one, from the round corner's start on.
  const double r = corner.radius_mm, width = corner.normals.width_rad;
  double start = std::remainder(normals.from_rad + theta_rad + kPi - corner.normals.from_rad, 2 * kPi);
  if (start < 0) start += 2 * kPi;
  if (is_full(corner.normals)) return {{r * start, r * (start + normals.width_rad)}};
  std::vector<AlongRange> ranges;
  for (const double turn : {-2 * kPi, 0.0}) {
    const double from = std::max(0.0, start + turn), to = std::min(width, start + turn + normals.width_rad);
    if (to - from > kAngle_rad) ranges.push_back({r * from, r * to});
  }
  return ranges;
}

Configuration configuration_on(const MovingShape& part, const Obstacles& obstacles, const ContactPair& pair,
                               double theta_rad, double along_mm) {
  Point p;
  switch (pair.kind) {
    case ContactKind::CornerOnEdge: {
      const FixedEdge& edge = obstacles.edges[pair.fixed];
      p = edge.from + along_mm * edge.along - rotated(part.corners[pair.moving].at, theta_rad);
      break;
    }
    case ContactKind::EdgeOnCorner: {
      const MovingEdge& edge = part.edges[pair.moving];
      const FixedCorner& corner = obstacles.corners[pair.fixed];
      p = corner.centre - rotated(corner.radius_mm * edge.normal + edge.from + along_mm * edge.along, theta_rad);
      break;
    }
    default: {
      const FixedCorner& corner = obstacles.corners[pair.fixed];
      p = corner.centre + corner.radius_mm * direction(corner.normals.from_rad + along_mm / corner.radius_mm) -
          rotated(part.corners[pair.moving].at, theta_rad);
    }
  }
  return {p.x(), p.y(), theta_rad};
}

std::vector<Configuration> boundary_points(const MovingShape& part, const Obstacles& obstacles,
                                           const ContactFacet& facet, FacetSide side, int count) {
  const FacetBoundary& boundary = facet.boundary[static_cast<std::size_t>(side)];
  std::vector<Configuration> points;
  for (int i = 0; i < count && boundary.exists; ++i) {
    const double t = static_cast<double>(i) / (count - 1);
    points.push_back(configuration_on(part, obstacles, facet.pair,
                                      std::lerp(boundary.from.theta_rad, boundary.to.theta_rad, t),
                                      std::lerp(boundary.along_from_mm, boundary.along_to_mm, t)));
  }
  return points;
}

Eigen::Vector3d scaled_normal(const ContactState& state, double gyration_mm) {
  Eigen::Vector3d normal = state.gradient();
  normal.z() /= gyration_mm;
  return normal.normalized();
}

}  // namespace formotion
