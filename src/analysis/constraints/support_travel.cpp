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
  std::vector<int> ids;   // of the generators, in the travel's set
  std::vector<int> by_x;  // places: those at rest by ascending x, then those that move
  Point at(std::size_t i, double t) const { return (1 - t) * begin[i] + t * end[i]; }
  double x(double t) const { return from + t * (to - from); }
};

// The travel's generators; valid until the next call on this thread.
const GeneratorSet& generators_of(const Travel& travel) {
  thread_local GeneratorSet set;
  collect_generators(travel, set);
  return set;
}

// Calls visit(segment) for every stretch of the travel between events, in order, until it returns false. Stretches for
// which skip(from, to) says true are passed over without being looked at.
template <class Skip, class Visit>
void for_segments(const Travel& travel, const GeneratorSet& set, const Skip& skip, const Visit& visit) {
  thread_local Segment segment;
  thread_local std::vector<int> alive, place;  // place[g] of generator g in alive
  alive.clear();
  place.resize(set.generators.size());
  std::size_t born = 0, died = 0;
  for (std::size_t e = 0; e + 1 < set.events.size(); ++e) {
    segment.from = set.events[e];
    segment.to = set.events[e + 1];
    if (segment.to - segment.from <= kEventTolerance_mm) continue;
    const double middle = 0.5 * (segment.from + segment.to);
    for (; born < set.by_start.size() && set.generators[set.by_start[born]].x_in < middle; ++born) {
      place[set.by_start[born]] = static_cast<int>(alive.size());
      alive.push_back(set.by_start[born]);
    }
    for (; died < set.by_end.size() && set.generators[set.by_end[died]].x_out < middle; ++died) {
      const int at = place[set.by_end[died]];
      alive[at] = alive.back();
      place[alive[at]] = at;
      alive.pop_back();
    }
    const bool held = std::any_of(travel.held.begin(), travel.held.end(),
                                  [&](const Interval& h) { return h.from < middle && middle < h.to; });
    if (held || skip(segment.from, segment.to)) continue;
    segment.ids = alive;
    segment.begin.clear();
    segment.end.clear();
    segment.moving.clear();
    segment.by_x.clear();
    for (const int g : set.resting_by_x) {
      if (set.generators[g].x_in < middle && set.generators[g].x_out >= middle) segment.by_x.push_back(place[g]);
    }
    for (const int g : alive) {
      const Generator& generator = set.generators[g];
      if (generator.moving) segment.by_x.push_back(static_cast<int>(segment.begin.size()));
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

// The hull of the generators at rest alone: it holds during the whole segment, and others only widen it.
struct RestingHull {
  std::vector<int> corners;  // places in the segment, counter-clockwise
  double margin_mm = 0;
  std::vector<int> ids;    // of all those at rest, by ascending x: while they stay, so does the hull
  std::vector<int> ranks;  // of the corners among them
  void forget() { ids.assign(1, -1); }
};

// Scratch memory of a search, kept between segments.
struct Scratch {
  std::vector<Point> points;
  std::vector<int> order, hull;
  Life life;
  RestingHull resting;
};

void offer_points(const std::vector<Point>& points, std::vector<int>& order, double x, LeastMargin& best) {
  const HullMargin margin = hull_margin(points, order);
  if (margin.margin_mm >= best.margin_mm) return;
  best.margin_mm = margin.margin_mm;
  best.x_mm = x;
  best.from = points[margin.from];
  best.to = points[margin.to];
}

// Whether the line i -> j may have both neighbours of a corner of the resting hull to its left, or on it, at some time.
bool may_bound(const Segment& s, std::size_t i, std::size_t j, std::size_t before, std::size_t after) {
  const Point d0 = s.begin[j] - s.begin[i], d1 = s.end[j] - s.end[i];
  const auto may_be_left = [&](std::size_t k) {
    return cross_of(d0, d1, s.begin[k] - s.begin[i], s.end[k] - s.end[i]).greatest_coefficient() >= -kRoom_mm2;
  };
  return may_be_left(before) && may_be_left(after);
}

// Looks for margins below the best one inside of a segment whose ends are known: every pair of generators that can be
// a hull edge at some time, and every generator that can be the hull's nearest corner.
class InteriorSearch {
 public:
  InteriorSearch(const Segment& segment, LeastMargin& best, Scratch& scratch)
      : s_(segment), best_(best), scratch_(scratch) {}

  // What lies inside of the hull of those at rest is no corner of any hull; of its corners only those can be joined to
  // a generator whose neighbours both lie to the left of the join at some time.
  int run() {
    int pairs = 0;
    const std::vector<int>& resting = scratch_.resting.corners;
    candidates_ = resting;
    const std::size_t h = resting.size();
    add_movers();
    for (std::size_t m = h; m < candidates_.size(); ++m) {
      const std::size_t i = candidates_[m];
      for (std::size_t k = 0; k < h; ++k) {
        const std::size_t j = resting[k], before = resting[(k + h - 1) % h], after = resting[(k + 1) % h];
        ++pairs;
        const Quadratic numerator = cross_of(s_.begin[i], s_.end[i], s_.begin[j], s_.end[j]);
        if (may_improve(numerator, i, j) && may_bound(s_, i, j, before, after)) edge(numerator, i, j);
        const Quadratic backwards{-numerator.b0, -numerator.b1, -numerator.b2};
        if (may_improve(backwards, i, j) && may_bound(s_, j, i, before, after)) edge(backwards, j, i);
      }
      for (std::size_t k = h; k < candidates_.size(); ++k) {
        const std::size_t j = candidates_[k];
        if (j == i) continue;
        ++pairs;
        const Quadratic numerator = cross_of(s_.begin[i], s_.end[i], s_.begin[j], s_.end[j]);
        if (may_improve(numerator, i, j)) edge(numerator, i, j);
      }
      if (best_.margin_mm < 0 && -std::max(s_.begin[i].norm(), s_.end[i].norm()) < best_.margin_mm) corner(i);
    }
    return pairs;
  }

 private:
  // Adds the moving generators that can be corners of the hull: not those inside of the hull of those at rest all the
  // time, nor those inside of the hull of others with the same motion, the metal's corners.
  void add_movers() {
    rigid_.clear();
    for (std::size_t i = 0; i < s_.begin.size(); ++i) {
      if (!s_.moving[i] || stays_inside(i)) continue;
      const bool with_metal = s_.end[i].y() == s_.begin[i].y();  // the metal's corners move along -x, all alike
      (with_metal ? rigid_ : candidates_).push_back(static_cast<int>(i));
    }
    if (rigid_.size() < kFewMovers) {
      candidates_.insert(candidates_.end(), rigid_.begin(), rigid_.end());
      return;
    }
    std::sort(rigid_.begin(), rigid_.end(), [&](int a, int b) {
      const Point &p = s_.begin[a], &q = s_.begin[b];
      return p.x() < q.x() || (p.x() == q.x() && p.y() < q.y());
    });
    // Others may move along -x too, crossings on the part's horizontal edges; they keep out of the metal's hull.
    const double metal_moves = s_.from - s_.to;
    for (const int i : rigid_) {
      if (std::abs(s_.end[i].x() - s_.begin[i].x() - metal_moves) > kSameMotion_mm) candidates_.push_back(i);
    }
    std::erase_if(rigid_,
                  [&](int i) { return std::abs(s_.end[i].x() - s_.begin[i].x() - metal_moves) > kSameMotion_mm; });
    hull_of_sorted(s_.begin, rigid_, scratch_.hull);
    candidates_.insert(candidates_.end(), scratch_.hull.begin(), scratch_.hull.end());
  }

  // A generator moves straight, so the ends of the segment tell.
  bool stays_inside(std::size_t i) const {
    const std::vector<int>& hull = scratch_.resting.corners;
    if (hull.size() < 3) return false;
    for (std::size_t k = 0; k < hull.size(); ++k) {
      const Point& a = s_.begin[hull[k]];
      const Point along = s_.begin[hull[k + 1 == hull.size() ? 0 : k + 1]] - a;
      if (cross(along, s_.begin[i] - a) < kRoom_mm2 || cross(along, s_.end[i] - a) < kRoom_mm2) return false;
    }
    return true;
  }

  // Whether the line i -> j may come nearer than the best margin: its distance is at least the numerator's least
  // coefficient over its length, whose greatest value bounds positive distances, its least one negative ones.
  bool may_improve(const Quadratic& numerator, std::size_t i, std::size_t j) const {
    const double least = numerator.least_coefficient();
    const Point d0 = s_.begin[j] - s_.begin[i], d1 = s_.end[j] - s_.end[i];
    if (best_.margin_mm < 0) return least < 0 && least < best_.margin_mm * distance_to_segment(Point::Zero(), d0, d1);
    const double longest = std::max(d0.squaredNorm(), d1.squaredNorm());
    return least < 0 || least * least < best_.margin_mm * best_.margin_mm * longest;
  }

  // The line i -> j as a hull edge, numerator the cross product of its ends.
  void edge(const Quadratic& numerator, std::size_t i, std::size_t j) {
    const Point &i0 = s_.begin[i], &i1 = s_.end[i];
    const Point d0 = s_.begin[j] - i0, d1 = s_.end[j] - i1;
    // Dead if some generator is to its right all the time.
    bool always_alive = true;
    for (const std::size_t k : candidates_) {
      const Quadratic left = cross_of(d0, d1, s_.begin[k] - i0, s_.end[k] - i1);
      if (left.greatest_coefficient() < -kRoom_mm2 && k != i && k != j) return;
      always_alive = always_alive && left.least_coefficient() >= -kRoom_mm2;
    }
    Life& life = scratch_.life;
    life.restart();
    for (const std::size_t k : candidates_) {
      if (always_alive || life.pieces.empty()) break;
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
    for (const std::size_t k : candidates_) {
      if (life.pieces.empty()) break;
      if (k != i) life.restrict_to(dot_of(s_.begin[k] - s_.begin[i], s_.end[k] - s_.end[i], s_.begin[i], s_.end[i]));
    }
    for (const Interval& piece :
         life.pieces) {  // the distance of a point on a line is convex: its maximum is at an end
      if (piece.from > 0) offer(piece.from);
      if (piece.to < 1) offer(piece.to);
    }
  }

  void offer(double t) {
    scratch_.points.resize(s_.begin.size());
    for (std::size_t k = 0; k < scratch_.points.size(); ++k) scratch_.points[k] = s_.at(k, t);
    offer_points(scratch_.points, scratch_.order, s_.x(t), best_);
  }

  const Segment& s_;
  LeastMargin& best_;
  Scratch& scratch_;
  static constexpr std::size_t kFewMovers = 6;
  static constexpr double kSameMotion_mm = 1e-12;
  std::vector<int> rigid_;
  std::vector<int> candidates_;  // what can be a corner of the hull: those at rest, then those that move
};

void find_resting_hull(const Segment& segment, Scratch& scratch) {
  scratch.order = segment.by_x;
  RestingHull& hull = scratch.resting;
  std::size_t at_rest = 0;
  bool same = true;
  for (; at_rest < segment.by_x.size() && !segment.moving[segment.by_x[at_rest]]; ++at_rest) {
    same = same && at_rest < hull.ids.size() && hull.ids[at_rest] == segment.ids[segment.by_x[at_rest]];
  }
  if (!same || hull.ids.size() != at_rest) {
    hull_of_sorted(segment.begin, std::span(segment.by_x).first(at_rest), hull.corners);
    hull.margin_mm =
        at_rest == 0 ? -std::numeric_limits<double>::infinity() : margin_of_hull(segment.begin, hull.corners).margin_mm;
    hull.ids.clear();
    for (std::size_t k = 0; k < at_rest; ++k) hull.ids.push_back(segment.ids[segment.by_x[k]]);
    hull.ranks.clear();
    for (const int corner : hull.corners) {
      const auto at = std::find(segment.by_x.begin(), segment.by_x.end(), corner);
      hull.ranks.push_back(static_cast<int>(at - segment.by_x.begin()));
    }
    return;
  }
  hull.corners.clear();
  for (const int rank : hull.ranks) hull.corners.push_back(segment.by_x[rank]);
}

// A few generators at rest that vouch for a margin as long as all of them live: most stretches of a travel need no
// other look, which is what keeps the cost of a many-cornered part near-linear in its events.
class Voucher {
 public:
  bool vouches(double to, double margin_mm) const { return to <= until_ && margin_mm_ >= margin_mm; }

  void choose(const Segment& segment, const GeneratorSet& set, double wanted_mm, Scratch& scratch) {
    const std::vector<int>& corners = scratch.resting.corners;
    if (corners.size() < kLeastCorners) return;
    // The longer they live the better: those that outlive half of the corners, if they are enough, else more.
    const auto end_of = [&](int corner) { return set.generators[segment.ids[corner]].x_out; };
    ends_.clear();
    for (const int corner : corners) ends_.push_back(end_of(corner));
    std::sort(ends_.begin(), ends_.end());
    for (const std::size_t given_up : {corners.size() / 2, corners.size() / 4, corners.size() / 8}) {
      until_ = ends_[given_up];
      scratch.hull.clear();
      for (const int corner : corners) {
        if (end_of(corner) >= until_) scratch.hull.push_back(corner);
      }
      margin_mm_ = margin_of_hull(segment.begin, scratch.hull).margin_mm;
      if (margin_mm_ >= wanted_mm) return;
    }
  }

 private:
  static constexpr std::size_t kLeastCorners = 8;  // with fewer a look costs no more than a voucher
  std::vector<double> ends_;
  double until_ = -std::numeric_limits<double>::infinity(), margin_mm_ = 0;
};

// The least margin of a few places of a long travel: the search for the least of all then passes over more.
double glanced_margin(const Travel& travel, const GeneratorSet& set, Scratch& scratch) {
  constexpr std::size_t kGlances = 24;
  double least = std::numeric_limits<double>::infinity();
  const std::size_t step = set.events.size() / kGlances;
  if (step < 4) return least;
  std::size_t seen = 0;
  const auto skip = [&](double, double) { return ++seen % step != 0; };
  for_segments(travel, set, skip, [&](const Segment& segment) {
    scratch.order = segment.by_x;
    if (!segment.begin.empty()) least = std::min(least, hull_margin(segment.begin, scratch.order).margin_mm);
    return true;
  });
  return least;
}

LeastMargin search(const Travel& travel, double stop_below, double ignore_above, TravelCount* count) {
  LeastMargin best;
  best.margin_mm = ignore_above;
  best.margin_mm = std::min(best.margin_mm, travel.part.plain_margin_mm);
  if (travel.voids.edges.edges.empty()) return best;
  best.x_mm = travel.voids.edges.box.min.x() - travel.part.edges.box.max.x();
  thread_local Scratch scratch;
  scratch.resting.forget();
  const GeneratorSet& set = generators_of(travel);
  best.margin_mm = std::min(best.margin_mm, glanced_margin(travel, set, scratch) + kEventTolerance_mm);
  Voucher voucher;
  const auto skip = [&](double, double to) { return !count && voucher.vouches(to, best.margin_mm); };
  for_segments(travel, set, skip, [&](const Segment& segment) {
    if (segment.begin.empty()) {
      best.unsupported = true;
      return true;
    }
    int pairs = 0, updates = 1;
    find_resting_hull(segment, scratch);
    const double at_rest = scratch.resting.margin_mm;
    if (at_rest >= best.margin_mm) {
      voucher.choose(segment, set, best.margin_mm, scratch);
    } else {
      offer_points(segment.begin, scratch.order, segment.from, best);
      offer_points(segment.end, scratch.order, segment.to, best);
      updates = 3;
      if (best.margin_mm >= stop_below && at_rest < best.margin_mm)
        pairs = InteriorSearch(segment, best, scratch).run();
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
// generators that can be a hull edge passes through the origin.
std::vector<double> possible_sign_changes(const Segment& segment, const RestingHull& hull) {
  std::vector<double> places{0, 1};
  const auto look_at = [&](std::size_t i, std::size_t j) {
    std::array<double, 2> roots;
    const int count =
        roots_in_unit(cross_of(segment.begin[i], segment.end[i], segment.begin[j], segment.end[j]), roots);
    places.insert(places.end(), roots.begin(), roots.begin() + count);
  };
  const std::size_t h = hull.corners.size();
  for (std::size_t i = 0; i < segment.begin.size(); ++i) {
    if (!segment.moving[i]) continue;
    for (std::size_t j = 0; j < i; ++j) {
      if (segment.moving[j]) look_at(i, j);
    }
    for (std::size_t k = 0; k < h; ++k) {
      const std::size_t j = hull.corners[k], before = hull.corners[(k + h - 1) % h], after = hull.corners[(k + 1) % h];
      if (may_bound(segment, i, j, before, after) || may_bound(segment, j, i, before, after)) look_at(i, j);
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

TravellingPart TravellingPart::of(const Polygon& placed, double com_wall_mm, double wall_shift_mm,
                                  double track_width_mm) {
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
  part.plain_margin_mm =
      part.corners.empty() ? -std::numeric_limits<double>::infinity() : hull_margin(part.corners).margin_mm;
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
    lose(voids.edges.box.min.x() - part.edges.box.max.x(), voids.edges.box.max.x() - part.edges.box.min.x(),
         part.corners);
    return loss;
  }
  Scratch scratch;
  scratch.resting.forget();
  Voucher voucher;
  const auto skip = [&](double, double to) { return voucher.vouches(to, 0); };
  const GeneratorSet& set = generators_of(travel);
  for_segments(travel, set, skip, [&](const Segment& segment) {
    if (segment.begin.empty()) {
      lose(segment.from, segment.to, {});
      return !first_only;
    }
    find_resting_hull(segment, scratch);
    if (scratch.resting.margin_mm >= 0) {
      voucher.choose(segment, set, 0, scratch);
      return true;
    }
    const std::vector<double> places = possible_sign_changes(segment, scratch.resting);
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
