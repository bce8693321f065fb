#include "analysis/constraints/support_generators.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace formotion {
namespace {

using Edge = EdgeSet::Edge;

constexpr double kShortestLife_mm = 1e-12;  // lives shorter than this are rounding

// Corners at which the area to the left turns by this sense: +1 convex, -1 reflex.
std::vector<Point> corners_turning(const std::vector<Loop>& loops, double sense) {
  std::vector<Point> corners;
  for (const Loop& loop : loops) {
    const std::size_t n = loop.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Point& p = loop[(i + 1) % n];
      if (sense * cross(p - loop[i], loop[(i + 2) % n] - p) > 0) corners.push_back(p);
    }
  }
  return corners;
}

// Ascending x at which a horizontal line crosses the edges; pairs enclose the area.
void line_crossings(const EdgeSet& set, double y, std::vector<double>& xs) {
  xs.clear();
  for (const Edge& edge : set.edges) {
    if ((edge.a.y() > y) != (edge.b.y() > y)) xs.push_back(edge.x_at(y));
  }
  std::sort(xs.begin(), xs.end());
}

bool has_end_near(const EdgeSet& set, double y) {
  return std::any_of(set.edges.begin(), set.edges.end(),
                     [&](const Edge& e) { return std::abs(e.a.y() - y) <= kHeightTolerance_mm; });
}

struct Slice {
  std::vector<double> xs;  // pairs
  std::vector<double> below, above;
};

// The open area's slice at height y: inside just below and just above.
void open_slice(const EdgeSet& set, double y, Slice& slice) {
  slice.xs.clear();
  if (y <= set.box.min.y() || y >= set.box.max.y()) return;
  if (!has_end_near(set, y)) return line_crossings(set, y, slice.xs);
  line_crossings(set, y - kHeightTolerance_mm, slice.below);
  line_crossings(set, y + kHeightTolerance_mm, slice.above);
  for (std::size_t i = 0; i + 1 < slice.below.size(); i += 2) {
    for (std::size_t j = 0; j + 1 < slice.above.size(); j += 2) {
      const double from = std::max(slice.below[i], slice.above[j]),
                   to = std::min(slice.below[i + 1], slice.above[j + 1]);
      if (from < to) slice.xs.insert(slice.xs.end(), {from, to});
    }
  }
}

// The closed area's slice at height y: inside just below or just above (pairs may overlap).
void closed_slice(const EdgeSet& set, double y, Slice& slice) {
  slice.xs.clear();
  if (y < set.box.min.y() - kHeightTolerance_mm || y > set.box.max.y() + kHeightTolerance_mm) return;
  if (!has_end_near(set, y)) return line_crossings(set, y, slice.xs);
  line_crossings(set, y - kHeightTolerance_mm, slice.below);
  line_crossings(set, y + kHeightTolerance_mm, slice.above);
  slice.xs = slice.below;
  slice.xs.insert(slice.xs.end(), slice.above.begin(), slice.above.end());
}

class Collector {
 public:
  Collector(const Travel& travel, GeneratorSet& set)
      : travel_(travel),
        part_(travel.part),
        voids_(travel.voids),
        set_(set),
        start_(voids_.edges.box.min.x() - part_.edges.box.max.x() - 1),
        stop_(voids_.edges.box.max.x() - part_.edges.box.min.x() + 1) {}

  void run() {
    for (const Point& corner : part_.corners) part_corner(corner);
    for (const Point& corner : voids_.metal_corners) metal_corner(corner);
    for (const Edge& e : voids_.edges.edges) {
      const double y_min = e.y_min - part_.supported_y_mm, y_max = e.y_max - part_.supported_y_mm;
      for (const Edge& p : part_.edges.edges) {
        if (p.y_max < y_min - kHeightTolerance_mm || p.y_min > y_max + kHeightTolerance_mm) continue;
        if (e.horizontal) {
          if (!p.horizontal) on_horizontal_rim(p, e);
        } else if (p.horizontal) {
          on_horizontal_part_edge(p, e);
        } else {
          on_slanted_edges(p, e, std::max(p.y_min, y_min), std::min(p.y_max, y_max));
        }
      }
    }
    order();
  }

 private:
  void rest(double x_in, double x_out, const Point& p) {
    if (x_out >= x_in) set_.generators.push_back({x_in, x_out, p, Point::Zero(), false});
  }
  // Short lives count: without their ends, a chain of short edges would leave a gap in the lives that is long enough to
  // be looked at.
  void move(double x_in, double x_out, const Point& p, const Point& velocity) {
    if (x_out - x_in > kShortestLife_mm) set_.generators.push_back({x_in, x_out, p, velocity, true});
  }

  // At rest; lives while it is not over a void.
  void part_corner(const Point& corner) {
    open_slice(voids_.edges, corner.y() + part_.supported_y_mm, slice_);
    double since = start_;
    for (std::size_t k = 0; k + 1 < slice_.xs.size(); k += 2) {
      rest(since, slice_.xs[k] - corner.x(), corner);
      since = slice_.xs[k + 1] - corner.x();
    }
    rest(since, stop_, corner);
  }

  // Moves backwards; lives while it is under the part.
  void metal_corner(const Point& corner) {
    const double y = corner.y() - part_.supported_y_mm;
    closed_slice(part_.edges, y, slice_);
    for (std::size_t k = 0; k + 1 < slice_.xs.size(); k += 2) {
      move(corner.x() - slice_.xs[k + 1], corner.x() - slice_.xs[k], {slice_.xs[k + 1], y}, {-1, 0});
    }
  }

  // Lives end where those of the neighbouring edges begin, bit for bit: at the ends of the edge, though these may
  // differ a little in height.
  void on_horizontal_rim(const Edge& p, const Edge& rim) {
    const double y = 0.5 * (rim.a.y() + rim.b.y()) - part_.supported_y_mm;
    const double at_a = rim.a.x() - p.x_at(rim.a.y() - part_.supported_y_mm);
    const double at_b = rim.b.x() - p.x_at(rim.b.y() - part_.supported_y_mm);
    rest(std::min(at_a, at_b), std::max(at_a, at_b), {p.x_at(y), y});
  }

  void on_horizontal_part_edge(const Edge& p, const Edge& e) {
    const double at_a = e.x_at(p.a.y() + part_.supported_y_mm) - p.a.x();
    const double at_b = e.x_at(p.b.y() + part_.supported_y_mm) - p.b.x();
    const double life = std::abs(at_b - at_a);
    if (life <= kShortestLife_mm) return;
    at_a < at_b ? move(at_a, at_b, p.a, (p.b - p.a) / life) : move(at_b, at_a, p.b, (p.a - p.b) / life);
  }

  void on_slanted_edges(const Edge& p, const Edge& e, double y_low, double y_high) {
    if (!(y_high > y_low)) return;
    const Point low(p.x_at(y_low), y_low), high(p.x_at(y_high), y_high);
    const double at_low = e.x_at(y_low + part_.supported_y_mm) - low.x();
    const double at_high = e.x_at(y_high + part_.supported_y_mm) - high.x();
    if (std::abs(at_high - at_low) <= kShortestLife_mm) return;  // parallel: they meet at one position only
    const Point velocity = (high - low) / (at_high - at_low);
    at_low < at_high ? move(at_low, at_high, low, velocity) : move(at_high, at_low, high, velocity);
  }

  void order() {
    set_.by_start.resize(set_.generators.size());
    std::iota(set_.by_start.begin(), set_.by_start.end(), 0);
    std::sort(set_.by_start.begin(), set_.by_start.end(),
              [&](int a, int b) { return set_.generators[a].x_in < set_.generators[b].x_in; });
    set_.resting_by_x.clear();
    for (const int g : set_.by_start) {
      if (!set_.generators[g].moving) set_.resting_by_x.push_back(g);
    }
    std::sort(set_.resting_by_x.begin(), set_.resting_by_x.end(), [&](int a, int b) {
      const Point &p = set_.generators[a].position, &q = set_.generators[b].position;
      return p.x() < q.x() || (p.x() == q.x() && p.y() < q.y());
    });
    set_.by_end = set_.by_start;
    std::sort(set_.by_end.begin(), set_.by_end.end(),
              [&](int a, int b) { return set_.generators[a].x_out < set_.generators[b].x_out; });
    set_.events.assign({start_, stop_});
    for (const Generator& g : set_.generators) {
      if (g.x_in > start_) set_.events.push_back(g.x_in);
      if (g.x_out < stop_) set_.events.push_back(g.x_out);
    }
    for (const Interval& held : travel_.held) {
      for (const double x : {held.from, held.to}) {
        if (x > start_ && x < stop_) set_.events.push_back(x);
      }
    }
    std::sort(set_.events.begin(), set_.events.end());
  }

  const Travel& travel_;
  const TravellingPart& part_;
  const VoidOutline& voids_;
  GeneratorSet& set_;
  double start_, stop_;
  Slice slice_;
};

}  // namespace

double EdgeSet::Edge::x_at(double y) const {
  const double x = a.x() + (y - a.y()) * dx_dy;
  return std::clamp(x, std::min(a.x(), b.x()), std::max(a.x(), b.x()));
}

EdgeSet EdgeSet::of(const std::vector<Loop>& loops) {
  EdgeSet set;
  for (const Loop& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Point& a = loop[i];
      const Point& b = loop[(i + 1) % loop.size()];
      const double rise = b.y() - a.y();
      set.edges.push_back({a, b, std::min(a.y(), b.y()), std::max(a.y(), b.y()), rise == 0 ? 0 : (b.x() - a.x()) / rise,
                           std::abs(rise) <= kHorizontal_mm});
      set.box.include(a);
    }
  }
  return set;
}

VoidOutline VoidOutline::of(const std::vector<Loop>& loops) { return {EdgeSet::of(loops), corners_turning(loops, -1)}; }

std::vector<Point> convex_corners(const std::vector<Loop>& loops) { return corners_turning(loops, 1); }

void collect_generators(const Travel& travel, GeneratorSet& set) {
  set.generators.clear();
  Collector(travel, set).run();
}

std::vector<Interval> void_slice(const VoidOutline& voids, double y) {
  Slice slice;
  open_slice(voids.edges, y, slice);
  std::vector<Interval> intervals;
  for (std::size_t k = 0; k + 1 < slice.xs.size(); k += 2) intervals.push_back({slice.xs[k], slice.xs[k + 1]});
  return intervals;
}

}  // namespace formotion
