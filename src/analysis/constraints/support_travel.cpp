#include "analysis/constraints/support_travel.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/constraints/hull_margin.hpp"
#include "analysis/constraints/support_generators.hpp"
#include "analysis/geometry/boolean.hpp"
#include "analysis/geometry/roots.hpp"

namespace formotion {
namespace {

// The generators that live between two neighbouring events, at both ends.
struct Segment {
  double from = 0, to = 0;
  std::vector<Point> begin, end;  // positions at from and to
  std::vector<char> moving;
  Point at(std::size_t i, double t) const { return (1 - t) * begin[i] + t * end[i]; }
  double x(double t) const { return from + t * (to - from); }
};

// Calls visit(segment) for every stretch of the travel between events, in order, until it returns false.
template <class Visit>
void for_segments(const Travel& travel, const Visit& visit) {
  thread_local GeneratorSet set;
  thread_local Segment segment;
  thread_local std::vector<int> alive;
  collect_generators(travel, set);
  alive.clear();
  std::size_t next = 0;
  for (std::size_t e = 0; e + 1 < set.events.size(); ++e) {
    segment.from = set.events[e];
    segment.to = set.events[e + 1];
    if (segment.to - segment.from <= kEventTolerance_mm) continue;
    const double middle = 0.5 * (segment.from + segment.to);
    for (; next < set.by_start.size() && set.generators[set.by_start[next]].x_in < middle; ++next) alive.push_back(set.by_start[next]);
    std::erase_if(alive, [&](int g) { return set.generators[g].x_out < middle; });
    const bool held = std::any_of(travel.held.begin(), travel.held.end(),
                                  [&](const Interval& h) { return h.from < middle && middle < h.to; });
    if (held) continue;
    segment.begin.clear();
    segment.end.clear();
    segment.moving.clear();
    for (const int g : alive) {
      const Generator& generator = set.generators[g];
      segment.begin.push_back(generator.at(segment.from));
      segment.end.push_back(generator.at(segment.to));
      segment.moving.push_back(generator.moving);
    }
    if (!visit(static_cast<const Segment&>(segment))) return;
  }
}

Quadratic cross_of(const Point& a0, const Point& a1, const Point& b0, const Point& b1) {
  return {cross(a0, b0), 0.5 * (cross(a0, b1) + cross(a1, b0)), cross(a1, b1)};
}
Quadratic dot_of(const Point& a0, const Point& a1, const Point& b0, const Point& b1) {
  return {a0.dot(b0), 0.5 * (a0.dot(b1) + a1.dot(b0)), a1.dot(b1)};
}

// Where on [0, 1] all of a family of quadratics (mm^2) are not negative, with room for rounding: places that are
// examined for nothing cost time, never correctness.
constexpr double kRoom_mm2 = 1e-9;

struct Life {
  std::vector<Interval> pieces, next;

  void restart() { pieces.assign(1, {0, 1}); }
  void restrict_to(const Quadratic& exact) {
    const Quadratic q{exact.b0 + kRoom_mm2, exact.b1 + kRoom_mm2, exact.b2 + kRoom_mm2};
    if (q.least_coefficient() >= 0) return;
    std::array<double, 2> roots;
    const int count = roots_in_unit(q, roots);
    next.clear();
    for (const Interval& piece : pieces) {
      double from = piece.from;
      for (int k = 0; k <= count; ++k) {
        const double to = k < count ? std::clamp(roots[k], piece.from, piece.to) : piece.to;
        if (to > from && q(0.5 * (from + to)) >= 0) next.push_back({from, to});
        from = std::max(from, to);
      }
    }
    pieces.swap(next);
  }
};

// Scratch memory of a search, kept between segments.
struct Scratch {
  std::vector<Point> points;
  std::vector<int> order;
  Life life;
};

// Looks for margins below the best one inside of a segment whose ends are known: every pair of generators that can be
// a hull edge at some time, and every generator that can be the hull's nearest corner.
class InteriorSearch {
 public:
  InteriorSearch(const Segment& segment, LeastMargin& best, Scratch& scratch) : s_(segment), best_(best), scratch_(scratch) {}

  int run() {
    int pairs = 0;
    const std::size_t n = s_.begin.size();
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        if (i == j || !(s_.moving[i] || s_.moving[j])) continue;
        ++pairs;
        edge(i, j);
      }
      if (s_.moving[i] && best_.margin_mm < 0 && -std::max(s_.begin[i].norm(), s_.end[i].norm()) < best_.margin_mm) corner(i);
    }
    return pairs;
  }

 private:
  void edge(std::size_t i, std::size_t j) {
    const Point &i0 = s_.begin[i], &i1 = s_.end[i], &j0 = s_.begin[j], &j1 = s_.end[j];
    const Quadratic numerator = cross_of(i0, i1, j0, j1);
    const Point d0 = j0 - i0, d1 = j1 - i1;
    const double least = numerator.least_coefficient();
    // The edge's distance is at least `least` over its length: its greatest length bounds positive distances, its
    // least length negative ones.
    if (best_.margin_mm >= 0) {
      if (least >= 0 && least * least >= best_.margin_mm * best_.margin_mm * std::max(d0.squaredNorm(), d1.squaredNorm())) return;
    } else if (least >= 0 || least >= best_.margin_mm * distance_to_segment(Point::Zero(), d0, d1)) {
      return;
    }
    // Dead if some generator is to its right all the time.
    const std::size_t n = s_.begin.size();
    bool always_alive = true;
    for (std::size_t k = 0; k < n; ++k) {
      const Quadratic left = cross_of(d0, d1, s_.begin[k] - i0, s_.end[k] - i1);
      if (left.greatest_coefficient() < -kRoom_mm2 && k != i && k != j) return;
      always_alive = always_alive && left.least_coefficient() >= -kRoom_mm2;
    }
    Life& life = scratch_.life;
    life.restart();
    for (std::size_t k = 0; !always_alive && k < n && !life.pieces.empty(); ++k) {
      if (k != i && k != j) life.restrict_to(cross_of(d0, d1, s_.begin[k] - i0, s_.end[k] - i1));
    }
    if (life.pieces.empty()) return;
    std::array<double, 3> places;
    const int count = stationary_in_unit(numerator, dot_of(d0, d1, d0, d1), places);
    for (const Interval& piece : life.pieces) {
      if (piece.from > 0) offer(piece.from);
      if (piece.to < 1) offer(piece.to);
      for (int p = 0; p < count; ++p) {
        if (places[p] > piece.from && places[p] < piece.to) offer(places[p]);
      }
    }
  }

  // The generator as the hull's nearest corner to an origin outside: the whole hull lies beyond it.
  void corner(std::size_t i) {
    Life& life = scratch_.life;
    life.restart();
    for (std::size_t k = 0; k < s_.begin.size() && !life.pieces.empty(); ++k) {
      if (k != i) life.restrict_to(dot_of(s_.begin[k] - s_.begin[i], s_.end[k] - s_.end[i], s_.begin[i], s_.end[i]));
    }
    for (const Interval& piece : life.pieces) {  // the distance of a point on a line is convex: its maximum is at an end
      if (piece.from > 0) offer(piece.from);
      if (piece.to < 1) offer(piece.to);
    }
  }

  void offer(double t) {
    scratch_.points.resize(s_.begin.size());
    for (std::size_t k = 0; k < scratch_.points.size(); ++k) scratch_.points[k] = s_.at(k, t);
    const HullMargin margin = hull_margin(scratch_.points, scratch_.order);
    if (margin.margin_mm < best_.margin_mm) best_ = {margin.margin_mm, s_.x(t), scratch_.points[margin.from], scratch_.points[margin.to]};
  }

  const Segment& s_;
  LeastMargin& best_;
  Scratch& scratch_;
};

void offer(const std::vector<Point>& points, std::vector<int>& order, double x, LeastMargin& best) {
  const HullMargin margin = hull_margin(points, order);
  if (margin.margin_mm < best.margin_mm) best = {margin.margin_mm, x, points[margin.from], points[margin.to]};
}

// The margin that the generators at rest alone give during the whole segment.
double resting_margin(const Segment& segment, Scratch& scratch) {
  scratch.points.clear();
  for (std::size_t k = 0; k < segment.begin.size(); ++k) {
    if (!segment.moving[k]) scratch.points.push_back(segment.begin[k]);
  }
  if (scratch.points.empty()) return -std::numeric_limits<double>::infinity();
  return hull_margin(scratch.points, scratch.order).margin_mm;
}

LeastMargin search(const Travel& travel, double stop_below, double ignore_above, TravelCount* count) {
  LeastMargin best;
  best.margin_mm = ignore_above;
  best.margin_mm = std::min(best.margin_mm, travel.part.plain_margin_mm);
  if (travel.voids.edges.edges.empty()) return best;
  best.x_mm = travel.voids.edges.box.min.x() - travel.part.edges.box.max.x();
  thread_local Scratch scratch;
  for_segments(travel, [&](const Segment& segment) {
    if (segment.begin.empty()) return true;
    int pairs = 0, updates = 1;
    const double at_rest = resting_margin(segment, scratch);  // more generators only widen the hull
    if (at_rest < best.margin_mm) {
      offer(segment.begin, scratch.order, segment.from, best);
      offer(segment.end, scratch.order, segment.to, best);
      updates = 3;
      if (best.margin_mm >= stop_below && at_rest < best.margin_mm) pairs = InteriorSearch(segment, best, scratch).run();
    }
    if (count) {
      ++count->events;
      count->generators = std::max(count->generators, static_cast<int>(segment.begin.size()));
      count->hull_updates += updates;
      count->pairs += pairs;
    }
    return best.margin_mm >= stop_below;
  });
  return best;
}

constexpr double kLost_mm = -1e-9;

// Ends of the stretches of a segment with negative margin: the sign can change only where the line through two
// generators passes through the origin.
std::vector<double> possible_sign_changes(const Segment& segment) {
  std::vector<double> places{0, 1};
  const std::size_t n = segment.begin.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!(segment.moving[i] || segment.moving[j])) continue;
      std::array<double, 2> roots;
      const int count = roots_in_unit(cross_of(segment.begin[i], segment.end[i], segment.begin[j], segment.end[j]), roots);
      places.insert(places.end(), roots.begin(), roots.begin() + count);
    }
  }
  std::sort(places.begin(), places.end());
  return places;
}

std::vector<Point> points_at(const Segment& segment, double t) {
  std::vector<Point> points(segment.begin.size());
  for (std::size_t k = 0; k < points.size(); ++k) points[k] = segment.at(k, t);
  return points;
}

void note_tipping(const std::vector<Point>& points, SupportLoss& loss) {
  if (points.empty()) {
    loss.unsupported_entirely = true;
    return;
  }
  const HullMargin margin = hull_margin(points);
  loss.tipping.push_back({points[margin.from], points[margin.to]});
  if (margin.other_from >= 0) loss.tipping.push_back({points[margin.other_from], points[margin.other_to]});
}

}  // namespace

TravellingPart TravellingPart::of(const Polygon& placed, double com_wall_mm, double wall_shift_mm, double track_width_mm) {
  TravellingPart part;
  part.supported_y_mm = com_wall_mm - wall_shift_mm;
  std::vector<Loop> loops = loops_of(placed);
  const Box box = bounding_box(placed.outer);
  if (box.max.y() > track_width_mm + kHeightTolerance_mm) {
    const Loop strip = rectangle(box.min.x() - 1, box.min.y() - 1, box.max.x() + 1, track_width_mm);
    loops = loops_of(intersection(loops, {strip}));
  }
  for (Loop& loop : loops) {
    for (Point& p : loop) p.y() -= part.supported_y_mm;
  }
  part.edges = EdgeSet::of(loops);
  part.corners = convex_corners(loops);
  part.plain_margin_mm = part.corners.empty() ? -std::numeric_limits<double>::infinity() : hull_margin(part.corners).margin_mm;
  return part;
}

LeastMargin least_margin(const Travel& travel, double stop_below, double ignore_above) {
  return search(travel, stop_below, ignore_above, nullptr);
}

SupportLoss support_loss(const Travel& travel, bool first_only) {
  const TravellingPart& part = travel.part;
  const VoidOutline& voids = travel.voids;
  SupportLoss loss;
  const auto lose = [&](double from, double to, const std::vector<Point>& first) {
    if (!loss.lost) {
      loss.lost = true;
      loss.x_mm = from;
      note_tipping(first, loss);
    }
    if (!loss.lost_mm.empty() && from - loss.lost_mm.back().to <= kEventTolerance_mm) {
      loss.lost_mm.back().to = to;
    } else {
      loss.lost_mm.push_back({from, to});
    }
  };
  if (part.plain_margin_mm < kLost_mm) {  // cannot even stand on the plain track
    lose(voids.edges.box.min.x() - part.edges.box.max.x(), voids.edges.box.max.x() - part.edges.box.min.x(), part.corners);
    return loss;
  }
  Scratch scratch;
  for_segments(travel, [&](const Segment& segment) {
    if (segment.begin.empty()) {
      lose(segment.from, segment.to, {});
      return !first_only;
    }
    if (resting_margin(segment, scratch) >= 0) return true;
    const std::vector<double> places = possible_sign_changes(segment);
    for (std::size_t k = 0; k + 1 < places.size(); ++k) {
      const double from = segment.x(places[k]), to = segment.x(places[k + 1]);
      if (to - from <= kEventTolerance_mm) continue;
      if (hull_margin(points_at(segment, 0.5 * (places[k] + places[k + 1]))).margin_mm < kLost_mm) {
        lose(from, to, points_at(segment, places[k]));
      }
    }
    return !(first_only && loss.lost);
  });
  return loss;
}

std::optional<double> margin_at(const Travel& travel, double x_mm) {
  thread_local GeneratorSet set;
  collect_generators(travel, set);
  std::vector<Point> points;
  for (const Generator& g : set.generators) {
    if (g.x_in <= x_mm + kHeightTolerance_mm && g.x_out >= x_mm - kHeightTolerance_mm) points.push_back(g.at(x_mm));
  }
  if (x_mm < set.events.front() || x_mm > set.events.back()) points = travel.part.corners;
  if (points.empty()) return std::nullopt;
  return hull_margin(points).margin_mm;
}

TravelCount count_travel(const Travel& travel) {
  TravelCount count;
  const double infinity = std::numeric_limits<double>::infinity();
  search(travel, -infinity, infinity, &count);
  return count;
}

}  // namespace formotion
