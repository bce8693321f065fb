#include "verify/travel_places.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/geometry/boolean.hpp"

namespace formotion {
namespace {

constexpr double kSame_mm = 1e-6;  // events nearer to each other than this are one
constexpr double kRunUp_mm = 1;

struct Segment {
  Point a, b;
};

struct Outline {
  std::vector<Segment> edges;
  std::vector<Point> corners;  // also where edges pass the strip's rims
};

Outline outline_of(const std::vector<Loop>& loops, double width) {
  Outline outline;
  for (const Loop& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Point &a = loop[i], &b = loop[(i + 1) % loop.size()];
      outline.edges.push_back({a, b});
      outline.corners.push_back(a);
      for (const double y : {0.0, width}) {
        if ((a.y() - y) * (b.y() - y) < 0) outline.corners.push_back(a + (y - a.y()) / (b.y() - a.y()) * (b - a));
      }
    }
  }
  return outline;
}

// Calls visit(x) for every x at which a horizontal line through p meets the edges.
template <class Visit>
void level_with(const Point& p, const std::vector<Segment>& edges, const Visit& visit) {
  for (const Segment& edge : edges) {
    const double low = std::min(edge.a.y(), edge.b.y()), high = std::max(edge.a.y(), edge.b.y());
    if (p.y() < low - kSame_mm || p.y() > high + kSame_mm) continue;
    if (high - low <= kSame_mm) {
      visit(edge.a.x());
      visit(edge.b.x());
    } else {
      const double t = std::clamp((p.y() - edge.a.y()) / (edge.b.y() - edge.a.y()), 0.0, 1.0);
      visit(edge.a.x() + t * (edge.b.x() - edge.a.x()));
    }
  }
}

}  // namespace

Interval travel_range(const Polygon& footprint, const std::vector<Loop>& voids) {
  Box part, cut;
  for (const Point& p : footprint.outer) part.include(p);
  for (const Loop& loop : voids) {
    for (const Point& p : loop) cut.include(p);
  }
  return {cut.min.x() - part.max.x() - kRunUp_mm, cut.max.x() - part.min.x() + kRunUp_mm};
}

std::vector<double> travel_places(const Polygon& footprint, const std::vector<Loop>& voids, double track_width_mm,
                                  const PlaceOptions& options) {
  if (voids.empty()) return {0};
  const Outline part = outline_of(loops_of(footprint), track_width_mm), cut = outline_of(voids, track_width_mm);
  const Interval range = travel_range(footprint, voids);
  std::vector<double> events{range.from, range.to};
  for (const Point& p : part.corners) level_with(p, cut.edges, [&](double x) { events.push_back(x - p.x()); });
  for (const Point& p : cut.corners) level_with(p, part.edges, [&](double x) { events.push_back(p.x() - x); });
  std::sort(events.begin(), events.end());
  events.erase(std::unique(events.begin(), events.end(), [](double a, double b) { return b - a < kSame_mm; }),
               events.end());
  if (static_cast<int>(events.size()) > options.most_events) {
    std::vector<double> fewer;
    for (int k = 0; k < options.most_events; ++k)
      fewer.push_back(
          events[events.size() * static_cast<std::size_t>(k) / static_cast<std::size_t>(options.most_events)]);
    fewer.push_back(events.back());
    events = std::move(fewer);
  }
  std::vector<double> places;
  for (std::size_t i = 0; i + 1 < events.size(); ++i) {
    const double from = events[i], gap = events[i + 1] - from;
    const int pieces = std::max(2, static_cast<int>(std::ceil(gap / options.step_mm)));
    for (int k = 0; k < pieces; ++k) places.push_back(from + gap * k / pieces);
  }
  places.push_back(events.back());
  return places;
}

}  // namespace formotion
