#include "analysis/motion/first_touch.hpp"

#include <algorithm>
#include <limits>

namespace formotion {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kOverlap_mm = 1e-8;     // gaps below minus this are contacts that have been missed
constexpr double kChordError_mm = 1e-5;  // of a cubic that stands for a gap that begins flat
constexpr double kFlat_mm = 1e-9;

double gap_at(const ContactSpace& space, std::size_t index, const Configuration& q, ContactState& state) {
  state = contact_state(space.part, space.obstacles, space.pairs[index], q.position(), std::cos(q.theta_rad),
                        std::sin(q.theta_rad));
  return state.gap_mm;
}

// The root of a falling function whose slope is known: Newton's method inside a bracket that halves where it fails.
template <class F>
double steep_root(const F& f, double low, double high, double f_low, double f_high) {
  double x = low + (high - low) * f_low / (f_low - f_high);
  for (int i = 0; i < 80; ++i) {
    const auto [value, slope] = f(x);
    (value >= 0 ? low : high) = x;
    double next = x - value / slope;
    if (!(next > low && next < high)) next = low + (high - low) / 2;
    if (std::abs(next - x) <= 1e-15 + 4e-16 * std::abs(x) || !(next > low && next < high)) break;
    x = next;
  }
  return x;
}

struct Piece {
  double from, to, gap, rate, gap_end, rate_end;
  double chord_mm;  // bound of the gap's distance from its cubic in the middle
  Configuration start, end;
};
constexpr double kPathOverChord = 1.5;  // paths that bend one way, by less than a right angle: below sqrt 2
constexpr double kSharpTurn = 0.2;      // rad: the direction from a pin's centre to a corner, on one piece

// Whether the contact would lie beyond the same end of its edge all the while: it moves along it by no more than its
// point moves.
bool out_of_reach(const ContactSpace& space, std::size_t index, const Piece& p) {
  const ContactPair& pair = space.pairs[index];
  if (pair.kind == ContactKind::CornerOnCorner) return false;
  ContactState a, b;
  gap_at(space, index, p.start, a);
  gap_at(space, index, p.end, b);
  const double arm = std::max(a.lever.norm(), b.lever.norm());
  const double moves = kPathOverChord * chord(p.start, p.end, arm) + p.chord_mm;
  const double sum = a.along_mm + b.along_mm;
  return (sum + moves) / 2 < -kContact_mm || (sum - moves) / 2 > a.extent_mm + kContact_mm;
}

// Where the gap falls through the floor on this piece of the path, with the features in reach of each other.
double crossing(const ContactSpace& space, const GuidedPath& path, std::size_t index, const Piece& p, double floor,
                int depth) {
  // The distance to a round corner's centre is no cubic unless the corner turns little about it; but it changes by no
  // more than the corner moves.
  bool divide = false;
  if (const ContactPair& pair = space.pairs[index]; pair.kind == ContactKind::CornerOnCorner) {
    const double moves = kPathOverChord * chord(p.start, p.end, space.part.corners[pair.moving].at.norm());
    if ((p.gap + p.gap_end - moves) / 2 - p.chord_mm >= floor) return kInfinity;
    const double radius = space.obstacles.corners[pair.fixed].radius_mm;
    divide = moves > kSharpTurn * (radius + std::min(p.gap, p.gap_end)) && depth <= 40;
  }
  // The cubic's Bernstein coefficients of degree 4 bound it; what it misses the path by, with its rate, is nothing at
  // the ends, so about a multiple of t^2 (1 - t)^2: the middle coefficient alone feels it, by 16 / 6.
  const double third = (p.to - p.from) / 3;
  const double b1 = p.gap + third * p.rate, b2 = p.gap_end - third * p.rate_end;
  const double c1 = (p.gap + 3 * b1) / 4, c2 = (b1 + b2) / 2, c3 = (3 * b2 + p.gap_end) / 4;
  const double off = 16.0 / 6 * p.chord_mm;
  if (!divide && std::min({p.gap, c1, c2 - off, c3, p.gap_end}) >= floor) return kInfinity;
  if (!divide && std::max({p.gap, c1, c2 + off, c3, p.gap_end}) < floor) return kInfinity;
  if (out_of_reach(space, index, p)) return kInfinity;
  // The cubic's slope is bounded by its coefficients' differences; what it misses has slopes of about 3 chords at
  // most.
  const double rises = std::max({b1 - p.gap, b2 - b1, p.gap_end - b2});
  const bool falls = !divide && (rises <= -1.1 * p.chord_mm || (rises <= kFlat_mm && p.chord_mm <= kChordError_mm));
  if (falls && p.gap < floor) return kInfinity;  // below already, and out of reach
  if (falls) {
    const double target = p.gap > kContact_mm ? 0 : floor;
    if (p.gap_end >= target) return closes(space, path, index, path.at(p.to)) ? p.to : kInfinity;
    const auto gap_and_rate = [&](double h) {
      const Configuration q = path.at(h);
      ContactState state;
      const double gap = gap_at(space, index, q, state);
      return std::pair{gap - target, separation_speed(point_of(state), path.rate(h, q))};
    };
    const double at = steep_root(gap_and_rate, p.from, p.to, p.gap - target, p.gap_end - target);
    return closes(space, path, index, path.at(at)) ? at : kInfinity;
  }
  if (depth > 40) return p.gap_end < floor && closes(space, path, index, path.at(p.to)) ? p.to : kInfinity;
  const double middle = (p.from + p.to) / 2;
  const Configuration q = path.at(middle);
  ContactState state;
  gap_at(space, index, q, state);
  const double rate = separation_speed(point_of(state), path.rate(middle, q));
  const double found =
      crossing(space, path, index, {p.from, middle, p.gap, p.rate, state.gap_mm, rate, p.chord_mm / 16, p.start, q},
               floor, depth + 1);
  if (found < kInfinity) return found;
  return crossing(space, path, index,
                  {middle, p.to, state.gap_mm, rate, p.gap_end, p.rate_end, p.chord_mm / 16, q, p.end}, floor,
                  depth + 1);
}

}  // namespace

bool closes(const ContactSpace& space, const GuidedPath& path, std::size_t index, const Configuration& q) {
  Touch touch{space.pairs[index], {}};
  gap_at(space, index, q, touch.state);
  if (!can_touch(space, index, touch.state, q.theta_rad)) return false;
  const CornerMeeting meeting = meeting_of(space, touch);
  if (!meeting.is_one()) return true;
  for (const std::size_t other : space.pairs_of(meeting)) {
    if (other == index) continue;
    touch.pair = space.pairs[other];
    const double gap = gap_at(space, other, q, touch.state);
    if (!can_touch(space, other, touch.state, q.theta_rad) || meeting_of(space, touch) != meeting) continue;
    if (gap > kOverlap_mm || carries(path, touch.pair)) return false;
  }
  return true;
}

bool carries(const GuidedPath& path, const ContactPair& pair) {
  return std::find(path.pairs().begin(), path.pairs().end(), pair) != path.pairs().end();
}

double first_touch(const ContactSpace& space, const GuidedPath& path, const FlowStep& step) {
  std::vector<bool> near_edge(space.edge_boxes.size()), near_corner(space.corner_boxes.size());
  const Configuration &q = step.start, &end = step.end;
  Box swept;
  swept.include(q.position());
  swept.include(end.position());
  const double room = space.part.reach_mm + 0.25 * (end.position() - q.position()).norm() + 1e-3;
  swept.min.array() -= room;
  swept.max.array() += room;
  const auto meets = [&](const Box& box) {
    return box.min.x() <= swept.max.x() && swept.min.x() <= box.max.x() && box.min.y() <= swept.max.y() &&
           swept.min.y() <= box.max.y();
  };
  for (std::size_t i = 0; i < near_edge.size(); ++i) near_edge[i] = meets(space.edge_boxes[i]);
  for (std::size_t i = 0; i < near_corner.size(); ++i) near_corner[i] = meets(space.corner_boxes[i]);
  const double c0 = std::cos(q.theta_rad), s0 = std::sin(q.theta_rad);
  const double c1 = std::cos(end.theta_rad), s1 = std::sin(end.theta_rad);
  double first = kInfinity;
  for (std::size_t i = 0; i < space.pairs.size(); ++i) {
    const ContactPair& pair = space.pairs[i];
    if (!(pair.kind == ContactKind::CornerOnEdge ? near_edge[pair.fixed] : near_corner[pair.fixed])) continue;
    if (carries(path, pair)) continue;
    const ContactState a = contact_state(space.part, space.obstacles, pair, q.position(), c0, s0);
    const ContactState b = contact_state(space.part, space.obstacles, pair, end.position(), c1, s1);
    const Piece piece{0,
                      step.h,
                      a.gap_mm,
                      separation_speed(point_of(a), step.rate),
                      b.gap_mm,
                      separation_speed(point_of(b), step.rate_end),
                      2 * step.chord_mm,
                      q,
                      end};
    const double floor = (std::abs(a.gap_mm) <= kContact_mm ? std::min(0.0, a.gap_mm) : 0) - kOverlap_mm;
    first = std::min(first, crossing(space, path, i, piece, floor, 0));
  }
  return first;
}

}  // namespace formotion
