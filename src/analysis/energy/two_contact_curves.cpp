#include "analysis/energy/two_contact_curves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "analysis/contact/contact_curves.hpp"
#include "analysis/contact/interiors.hpp"

namespace formotion {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kNoWidth = 1e-12;   // rad, mm: of stretches
constexpr double kParallel = 1e-12;  // sine
constexpr double kSameLine_mm = 1e-9;
constexpr double kSlack_mm = 1e-9;   // a corner that stays in an inner corner is at the end of both edges
constexpr double kAngle_rad = 1e-9;  // orientations a rounding beyond their range

bool is_round(const ContactPair& pair) { return pair.kind == ContactKind::CornerOnCorner; }
double angle(const Point& direction) { return std::atan2(direction.y(), direction.x()); }

struct Interval {
  double from = 0, to = 0;
};

std::vector<Interval> common(const DirectionRange& a, const DirectionRange& b) {
  std::vector<Interval> found;
  const double off = 2 * kPi * std::round((a.from_rad - b.from_rad) / (2 * kPi));
  for (const double turn : {off - 2 * kPi, off, off + 2 * kPi}) {
    const Interval both{std::max(a.from_rad, b.from_rad + turn),
                        std::min(a.from_rad + a.width_rad, b.from_rad + b.width_rad + turn)};
    if (both.to - both.from > kNoWidth) found.push_back(both);
  }
  return found;
}

// Zeros of constant + c cos t + s sin t from `from` to `to`.
void add_zeros(double constant, double c, double s, const Interval& in, std::vector<double>& zeros) {
  const double size = std::hypot(c, s);
  if (size == 0 || std::abs(constant) > size * (1 + 1e-12)) return;
  const double middle = std::atan2(s, c), half = std::acos(std::clamp(-constant / size, -1.0, 1.0));
  for (const double root : {middle - half, middle + half}) {
    double t = root + 2 * kPi * std::ceil((in.from - root) / (2 * kPi));
    for (; t < in.to; t += 2 * kPi) zeros.push_back(t);
  }
}

// Where an edge contact is at the end of its edge, the other one's gap vanishes: place of the part's point `a` on the
// fixed point `b`.
void add_ends(const ContactSpace& space, const ContactPair& ending, const ContactPair& other, const Interval& in,
              std::vector<double>& ends) {
  const MovingShape& part = space.part;
  const Obstacles& obstacles = space.obstacles;
  for (const bool at_end : {false, true}) {
    Point a, b;
    if (ending.kind == ContactKind::CornerOnEdge) {
      const FixedEdge& edge = obstacles.edges[ending.fixed];
      a = part.corners[ending.moving].at;
      b = at_end ? edge.to : edge.from;
    } else {
      const MovingEdge& edge = part.edges[ending.moving];
      const FixedCorner& corner = obstacles.corners[ending.fixed];
      a = (at_end ? edge.to : edge.from) + corner.radius_mm * edge.normal;
      b = corner.centre;
    }
    if (other.kind == ContactKind::CornerOnEdge) {
      const FixedEdge& edge = obstacles.edges[other.fixed];
      const Point lever = part.corners[other.moving].at - a;
      add_zeros(edge.normal.dot(b - edge.from), edge.normal.dot(lever), edge.normal.dot(turned_left(lever)), in, ends);
    } else {
      const MovingEdge& edge = part.edges[other.moving];
      const FixedCorner& corner = obstacles.corners[other.fixed];
      const Point between = corner.centre - b;
      add_zeros(edge.normal.dot(a - edge.from) - corner.radius_mm, edge.normal.dot(between),
                turned_left(edge.normal).dot(between), in, ends);
    }
  }
}

bool is_within(const ContactSpace& space, std::size_t index, const Configuration& q) {
  const double c = std::cos(q.theta_rad), s = std::sin(q.theta_rad);
  const ContactPair& pair = space.pairs[index];
  const ContactState state = contact_state(space.part, space.obstacles, pair, q.position(), c, s);
  if (!(state.along_mm >= -kSlack_mm && state.along_mm <= state.extent_mm + kSlack_mm)) return false;
  if (!is_round(pair)) return true;
  return space.part.corners[pair.moving].normals.contains(
      std::atan2(-state.normal.y(), -state.normal.x()) - q.theta_rad, kNoWidth);
}

class Finder {
 public:
  Finder(const ContactSpace& space, double grid_rad) : space_(space), grid_rad_(grid_rad) {}

  void look_at(std::size_t first, std::size_t second) {
    curve_ = {};
    curve_.first = first;
    curve_.second = second;
    const ContactPair &a = space_.pairs[first], &b = space_.pairs[second];
    if (!is_round(a) && !is_round(b)) straight(a, b);
    for (const Interval& in : common(space_.orientations[first], space_.orientations[second])) {
      const bool round = is_round(a) || is_round(b);
      for (curve_.branch = 0; curve_.branch < (round ? 2 : 1); ++curve_.branch) {
        if (round) {
          sampled(in);
        } else {
          closed_form(a, b, in);
        }
      }
    }
  }
  std::vector<TwoContactCurve> found;

 private:
  bool exists(double theta) const {
    const Configuration q = curve_.at(space_, theta);
    return std::isfinite(q.x_mm) && is_within(space_, curve_.first, q) && is_within(space_, curve_.second, q);
  }

  void add(double from, double to) {
    if (to - from <= kNoWidth) return;
    found.push_back(curve_);
    found.back().from = from;
    found.back().to = to;
  }

  void closed_form(const ContactPair& a, const ContactPair& b, const Interval& in) {
    std::vector<double> ends{in.from, in.to};
    add_ends(space_, a, b, in, ends);
    add_ends(space_, b, a, in, ends);
    std::sort(ends.begin(), ends.end());
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      if (exists(0.5 * (ends[i] + ends[i + 1]))) add(ends[i], ends[i + 1]);
    }
  }

  void sampled(const Interval& in) {
    const int steps = std::max(8, static_cast<int>(std::ceil((in.to - in.from) / grid_rad_)));
    const auto change = [&](double yes, double no) {
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (yes + no);
        (exists(middle) ? yes : no) = middle;
      }
      return yes;
    };
    double last = in.from, from = in.from;
    bool inside = exists(last);
    for (int i = 1; i <= steps; ++i) {
      const double here = in.from + (in.to - in.from) * i / steps;
      const bool now = exists(here);
      if (inside && !now) add(from, change(last, here));
      if (!inside && now) from = change(here, last);
      inside = now;
      last = here;
    }
    if (inside) add(from, in.to);
  }

  void straight(const ContactPair& a, const ContactPair& b) {
    std::vector<double> thetas;
    if (a.kind == b.kind) {
      const bool on_edges = a.kind == ContactKind::CornerOnEdge;
      const Point& one = on_edges ? space_.obstacles.edges[a.fixed].normal : space_.part.edges[a.moving].normal;
      const Point& other = on_edges ? space_.obstacles.edges[b.fixed].normal : space_.part.edges[b.moving].normal;
      if (std::abs(cross(one, other)) > kParallel) return;
      thetas = horizontal_orientations(space_.part, space_.obstacles, a, b);
    } else {
      const bool edge_first = a.kind == ContactKind::CornerOnEdge;
      const double fixed = angle(space_.obstacles.edges[edge_first ? a.fixed : b.fixed].normal);
      const double moving = angle(space_.part.edges[edge_first ? b.moving : a.moving].normal);
      thetas = {fixed - moving, fixed - moving + kPi};
    }
    for (double theta : thetas) {
      theta -= 2 * kPi * std::floor(theta / (2 * kPi));
      if (!space_.orientations[curve_.first].contains(theta, kAngle_rad)) continue;
      if (!space_.orientations[curve_.second].contains(theta, kAngle_rad)) continue;
      straight_at(theta);
    }
  }

  void straight_at(double theta) {
    const double c = std::cos(theta), s = std::sin(theta);
    const ContactPair &a = space_.pairs[curve_.first], &b = space_.pairs[curve_.second];
    const ContactLocus one = contact_locus(space_.part, space_.obstacles, a, c, s);
    const ContactLocus other = contact_locus(space_.part, space_.obstacles, b, c, s);
    const double apart =
        one.normal.dot(other.normal) > 0 ? one.offset_mm - other.offset_mm : one.offset_mm + other.offset_mm;
    const double scale = 1 + space_.part.reach_mm + std::abs(one.offset_mm);
    if (std::abs(apart) > kSameLine_mm * scale) return;
    TwoContactCurve line = curve_;
    line.straight = true;
    line.theta_rad = theta;
    line.direction = turned_left(one.normal);
    line.origin = one.offset_mm * one.normal;
    line.from = -std::numeric_limits<double>::infinity();
    line.to = -line.from;
    for (const ContactPair* pair : {&a, &b}) {
      const ContactState state = contact_state(space_.part, space_.obstacles, *pair, line.origin, c, s);
      const ContactState next = contact_state(space_.part, space_.obstacles, *pair, line.origin + line.direction, c, s);
      const double sign = next.along_mm > state.along_mm ? 1 : -1;
      const double start = -sign * state.along_mm, end = start + sign * state.extent_mm;
      line.from = std::max(line.from, std::min(start, end));
      line.to = std::min(line.to, std::max(start, end));
    }
    if (line.to - line.from > kSameLine_mm) found.push_back(line);
  }

  const ContactSpace& space_;
  double grid_rad_;
  TwoContactCurve curve_;
};

const Box& fixed_box(const ContactSpace& space, const ContactPair& pair) {
  return pair.kind == ContactKind::CornerOnEdge ? space.edge_boxes[pair.fixed] : space.corner_boxes[pair.fixed];
}

}  // namespace

Configuration TwoContactCurve::at(const ContactSpace& space, double place) const {
  if (straight) {
    const Point p = origin + place * direction;
    return {p.x(), p.y(), theta_rad};
  }
  const TwoContactPositions both = two_contact_positions(space.part, space.obstacles, space.pairs[first],
                                                         space.pairs[second], std::cos(place), std::sin(place));
  if (branch >= both.count) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    return {none, none, place};
  }
  return {both.position[branch].x(), both.position[branch].y(), place};
}

bool in_reach(const ContactSpace& space, std::size_t first, std::size_t second) {
  return box_distance(fixed_box(space, space.pairs[first]), fixed_box(space, space.pairs[second])) <=
         2 * space.part.reach_mm + kContact_mm;
}

bool has_orientations(const DirectionRange& range, double from_rad, double to_rad) {
  const double turns = (range.from_rad - from_rad) / (2 * kPi);
  const double off = 2 * kPi * (turns - std::floor(turns));
  return off <= to_rad - from_rad + kAngle_rad || off + range.width_rad >= 2 * kPi - kAngle_rad;
}

std::vector<TwoContactCurve> two_contact_curves(const ContactSpace& space, double grid_rad) {
  Finder finder(space, grid_rad);
  for (std::size_t i = 0; i < space.pairs.size(); ++i) {
    for (std::size_t j = i + 1; j < space.pairs.size(); ++j) {
      if (in_reach(space, i, j)) finder.look_at(i, j);
    }
  }
  return std::move(finder.found);
}

}  // namespace formotion
