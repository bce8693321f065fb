#include "analysis/contact/interiors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace formotion {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kNear_mm = 2 * kTouching_mm;    // so that ends that spoil a proper crossing are cuts
constexpr double kShort_mm = 10 * kTouching_mm;  // pieces shorter than this say nothing

Point direction(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

Box box_of(const Point& a, const Point& b) { return {a.cwiseMin(b), a.cwiseMax(b)}; }

bool apart(const Box& a, const Box& b) {
  return (a.max.array() + kNear_mm < b.min.array()).any() || (b.max.array() + kNear_mm < a.min.array()).any();
}

bool holds(const Box& box, const Point& p) {
  return (p.array() >= box.min.array() && p.array() <= box.max.array()).all();
}

void add_segment(Boundary& boundary, const Point& from, const Point& to, const Point& along, double length_mm) {
  if (boundary.segments.empty() || boundary.segments.back().to != from) {
    boundary.runs.push_back(static_cast<int>(boundary.segments.size()));
  }
  boundary.segments.push_back({from, to, along, {along.y(), -along.x()}, length_mm, box_of(from, to)});
  boundary.box.include(from);
  boundary.box.include(to);
}

// How far round the arc a direction is, from 0 to width; nothing beyond its ends by more than tolerance_rad.
std::optional<double> place_on(const BoundaryArc& arc, const Point& from_centre, double tolerance_rad) {
  const double half = arc.directions.width_rad / 2;
  const double off =
      std::remainder(std::atan2(from_centre.y(), from_centre.x()) - arc.directions.from_rad - half, 2 * kPi);
  if (std::abs(off) > half + tolerance_rad) return std::nullopt;
  return std::clamp(off + half, 0.0, 2 * half);
}

// Counts of an arc's y-monotone pieces crossed by the ray from p towards +x.
int arc_winding(const BoundaryArc& arc, const Point& p) {
  const double end = arc.directions.from_rad + arc.directions.width_rad;
  double angle = arc.directions.from_rad, y = arc.from.y();
  int count = 0;
  while (angle < end) {
    // The next direction in which y turns round: an odd multiple of 90 degrees.
    const double turn = (std::floor(angle / kPi + 0.5) + 0.5) * kPi;
    const bool last = turn >= end;
    const bool rising = std::cos(0.5 * (angle + (last ? end : turn))) > 0;
    const double next = last ? arc.to.y() : arc.centre.y() + (rising ? arc.radius_mm : -arc.radius_mm);
    if ((y > p.y()) != (next > p.y())) {
      const double dy = p.y() - arc.centre.y();
      const double dx = std::sqrt(std::max(0.0, arc.radius_mm * arc.radius_mm - dy * dy));
      if (arc.centre.x() + (rising ? dx : -dx) > p.x()) count += next > y ? 1 : -1;
    }
    if (last) break;
    angle = std::max(turn, std::nextafter(angle, end));
    y = next;
  }
  return count;
}

// A place at which an element of one boundary touches the other.
struct Cut {
  int element = 0;
  double at_mm = 0;
  bool operator<(const Cut& other) const {
    return element < other.element || (element == other.element && at_mm < other.at_mm);
  }
};

struct Cuts {
  std::vector<Cut> part, segments, arcs;
};

// True if they cross properly.
bool cross_or_touch(const BoundarySegment& a, int i, const BoundarySegment& b, int j, Cuts& cuts) {
  const double a0 = b.normal.dot(a.from - b.from), a1 = b.normal.dot(a.to - b.from);
  if (std::min(a0, a1) > kNear_mm || std::max(a0, a1) < -kNear_mm) return false;
  const double b0 = a.normal.dot(b.from - a.from), b1 = a.normal.dot(b.to - a.from);
  if (std::min(b0, b1) > kNear_mm || std::max(b0, b1) < -kNear_mm) return false;
  if (std::min(a0, a1) < -kTouching_mm && std::max(a0, a1) > kTouching_mm && std::min(b0, b1) < -kTouching_mm &&
      std::max(b0, b1) > kTouching_mm) {
    return true;
  }
  const auto touch = [](const BoundarySegment& edge, const Point& end, double off, double& at) {
    at = edge.along.dot(end - edge.from);
    return std::abs(off) <= kNear_mm && at >= -kNear_mm && at <= edge.length_mm + kNear_mm;
  };
  double at = 0;
  const auto both = [&](double on_a, double on_b) {
    cuts.part.push_back({i, on_a});
    cuts.segments.push_back({j, on_b});
  };
  if (touch(b, a.from, a0, at)) both(0, at);
  if (touch(b, a.to, a1, at)) both(a.length_mm, at);
  if (touch(a, b.from, b0, at)) both(at, 0);
  if (touch(a, b.to, b1, at)) both(at, b.length_mm);
  return false;
}

bool cross_or_touch(const BoundarySegment& a, int i, const BoundaryArc& arc, int j, Cuts& cuts) {
  const double middle = a.along.dot(arc.centre - a.from), r = arc.radius_mm;
  const double foot = std::clamp(middle, 0.0, a.length_mm);
  const Point at_foot = a.from + foot * a.along - arc.centre;
  const double nearest = at_foot.norm();
  if (nearest > r + kNear_mm) return false;
  const auto touch = [&](double at_mm, const Point& from_centre) {
    if (std::abs(from_centre.norm() - r) > kNear_mm) return;
    if (const auto place = place_on(arc, from_centre, kNear_mm / r)) {
      cuts.part.push_back({i, at_mm});
      cuts.arcs.push_back({j, *place * r});
    }
  };
  const Point from = a.from - arc.centre, to = a.to - arc.centre;
  touch(0, from);
  touch(a.length_mm, to);
  if (foot > 0 && foot < a.length_mm) touch(foot, at_foot);
  if (nearest >= r - kTouching_mm) return false;
  const double off = a.normal.dot(from), half_chord = std::sqrt(std::max(0.0, r * r - off * off));
  const auto leaves = [&](double at_mm, const Point& end) {
    if (end.norm() <= r + kTouching_mm) return false;
    return place_on(arc, from + at_mm * a.along, -kTouching_mm / r).has_value();
  };
  return leaves(middle - half_chord, from) || leaves(middle + half_chord, to);
}

// Calls test(element, from, to) for the pieces of the touched elements until it says yes.
template <typename Length, typename Test>
bool any_piece(std::vector<Cut>& cuts, const Length& length, const Test& test) {
  std::sort(cuts.begin(), cuts.end());
  for (std::size_t k = 0; k < cuts.size();) {
    const int element = cuts[k].element;
    const double end = length(element);
    double from = 0;
    for (;; ++k) {
      const bool last = k == cuts.size() || cuts[k].element != element;
      const double to = last ? end : std::clamp(cuts[k].at_mm, 0.0, end);
      if (to - from > kShort_mm && test(element, from, to)) return true;
      from = std::max(from, to);
      if (last) break;
    }
  }
  return false;
}

// Whether a run of untouched segments (its first one's middle) lies in the other boundary.
bool any_run_inside(const Boundary& of, const std::vector<Cut>& sorted_cuts, const Boundary& other) {
  for (std::size_t k = 0; k < of.runs.size(); ++k) {
    const int first = of.runs[k];
    const int end = k + 1 < of.runs.size() ? of.runs[k + 1] : static_cast<int>(of.segments.size());
    const BoundarySegment& segment = of.segments[first];
    const Point middle = (segment.from + segment.to) / 2;
    if (!holds(other.box, middle)) continue;
    const auto touched = std::lower_bound(sorted_cuts.begin(), sorted_cuts.end(), Cut{first, -1e300});
    if (touched != sorted_cuts.end() && touched->element < end) continue;
    if (is_inside(other, middle, kTouching_mm)) return true;
  }
  return false;
}

// A segment of the boundary lies on this place with its material on the same side.
bool coincides(const Boundary& boundary, const Point& p, const Point& along) {
  return std::any_of(boundary.segments.begin(), boundary.segments.end(), [&](const BoundarySegment& segment) {
    if (segment.along.dot(along) < 0.9 || std::abs(segment.normal.dot(p - segment.from)) > kTouching_mm) return false;
    const double at = segment.along.dot(p - segment.from);
    return at >= 0 && at <= segment.length_mm;
  });
}

}  // namespace

double box_distance(const Box& a, const Box& b) {
  return (a.min - b.max).cwiseMax(b.min - a.max).cwiseMax(Point::Zero()).norm();
}

Boundary fixed_boundary(const Obstacles& obstacles) {
  Boundary boundary;
  boundary.segments.reserve(obstacles.edges.size());
  for (const FixedEdge& edge : obstacles.edges) {
    const double length = (edge.to - edge.from).norm();
    if (!(length > 0)) continue;
    // An edge that growing has turned round keeps its ends: the loop stays closed.
    const double sense = edge.along.dot(edge.to - edge.from) < 0 ? -1 : 1;
    add_segment(boundary, edge.from, edge.to, sense * edge.along, length);
  }
  for (const FixedCorner& corner : obstacles.corners) {
    if (!(corner.radius_mm > 0)) continue;
    BoundaryArc arc{corner.centre, corner.radius_mm, corner.normals, {}, {}, {}};
    arc.from = corner.centre + corner.radius_mm * direction(corner.normals.from_rad);
    arc.to =
        corner.normals.width_rad >= 2 * kPi
            ? arc.from
            : Point(corner.centre + corner.radius_mm * direction(corner.normals.from_rad + corner.normals.width_rad));
    if (corner.edge_before) arc.from = obstacles.edges[*corner.edge_before].to;
    if (corner.edge_after) arc.to = obstacles.edges[*corner.edge_after].from;
    arc.box.include(corner.centre - Point::Constant(corner.radius_mm));
    arc.box.include(corner.centre + Point::Constant(corner.radius_mm));
    boundary.box.include(arc.box.min);
    boundary.box.include(arc.box.max);
    boundary.arcs.push_back(arc);
  }
  return boundary;
}

Boundary placed_boundary(const MovingShape& part, const Point& position, double c, double s) {
  Boundary boundary;
  boundary.segments.reserve(part.edges.size());
  for (const MovingEdge& edge : part.edges) {
    add_segment(boundary, position + rotated(edge.from, c, s), position + rotated(edge.to, c, s),
                rotated(edge.along, c, s), edge.length_mm);
  }
  return boundary;
}

void move_to(const Boundary& from, const Point& offset, Boundary& moved) {
  moved = from;
  for (BoundarySegment& segment : moved.segments) {
    segment.from += offset;
    segment.to += offset;
    segment.box.min += offset;
    segment.box.max += offset;
  }
  moved.box.min += offset;
  moved.box.max += offset;
}

int winding(const Boundary& boundary, const Point& p) {
  int count = 0;
  for (const BoundarySegment& segment : boundary.segments) {
    if ((segment.from.y() > p.y()) == (segment.to.y() > p.y())) continue;  // half-open, so an end counts once
    const bool rising = segment.to.y() > segment.from.y();
    const double side = cross(segment.to - segment.from, p - segment.from);
    if (rising ? side > 0 : side < 0) count += rising ? 1 : -1;
  }
  for (const BoundaryArc& arc : boundary.arcs) {
    if (p.y() >= arc.box.min.y() - kNear_mm && p.y() <= arc.box.max.y() + kNear_mm) count += arc_winding(arc, p);
  }
  return count;
}

bool is_inside(const Boundary& boundary, const Point& p, double tolerance_mm) {
  if (!holds(boundary.box, p) || winding(boundary, p) <= 0) return false;
  for (const BoundarySegment& segment : boundary.segments) {
    if (std::abs(segment.normal.dot(p - segment.from)) > tolerance_mm) continue;
    if (distance_to_segment(p, segment.from, segment.to) <= tolerance_mm) return false;
  }
  return std::none_of(boundary.arcs.begin(), boundary.arcs.end(), [&](const BoundaryArc& arc) {
    const Point from_centre = p - arc.centre;
    return std::abs(from_centre.norm() - arc.radius_mm) <= tolerance_mm && place_on(arc, from_centre, 0);
  });
}

bool interiors_overlap(const Boundary& part, const Boundary& obstacles) {
  if (apart(part.box, obstacles.box)) return false;
  Cuts cuts;
  // The fixed elements in reach, so that a long track costs one look each.
  std::vector<int> near;
  near.reserve(obstacles.segments.size());
  for (int j = 0; j < static_cast<int>(obstacles.segments.size()); ++j) {
    if (!apart(part.box, obstacles.segments[j].box)) near.push_back(j);
  }
  for (int i = 0; i < static_cast<int>(part.segments.size()); ++i) {
    const BoundarySegment& a = part.segments[i];
    for (const int j : near) {
      const BoundarySegment& b = obstacles.segments[j];
      if (!apart(a.box, b.box) && cross_or_touch(a, i, b, j, cuts)) return true;
    }
    for (int j = 0; j < static_cast<int>(obstacles.arcs.size()); ++j) {
      const BoundaryArc& arc = obstacles.arcs[j];
      if (!apart(a.box, arc.box) && cross_or_touch(a, i, arc, j, cuts)) return true;
    }
  }
  const bool on_part = any_piece(
      cuts.part, [&](int i) { return part.segments[i].length_mm; },
      [&](int i, double from, double to) {
        const BoundarySegment& a = part.segments[i];
        const Point middle = a.from + 0.5 * (from + to) * a.along;
        return is_inside(obstacles, middle, kTouching_mm) || coincides(obstacles, middle, a.along);
      });
  if (on_part || any_run_inside(part, cuts.part, obstacles)) return true;
  const bool on_segments = any_piece(
      cuts.segments, [&](int j) { return obstacles.segments[j].length_mm; },
      [&](int j, double from, double to) {
        const BoundarySegment& b = obstacles.segments[j];
        return is_inside(part, b.from + 0.5 * (from + to) * b.along, kTouching_mm);
      });
  if (on_segments || any_run_inside(obstacles, cuts.segments, part)) return true;
  for (int j = 0; j < static_cast<int>(obstacles.arcs.size()); ++j) cuts.arcs.push_back({j, 0});
  return any_piece(
      cuts.arcs, [&](int j) { return obstacles.arcs[j].directions.width_rad * obstacles.arcs[j].radius_mm; },
      [&](int j, double from, double to) {
        const BoundaryArc& arc = obstacles.arcs[j];
        const double angle = arc.directions.from_rad + 0.5 * (from + to) / arc.radius_mm;
        return is_inside(part, arc.centre + arc.radius_mm * direction(angle), kTouching_mm);
      });
}

}  // namespace formotion
