#include "solid/grid_segments.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace formotion {
namespace {

constexpr int kMostRounds = 100;  // two or three are usual

struct Segment {
  GridPoint a, b;  // a < b
  RegionBits regions = 0;
  std::vector<GridPoint> splits = {};
};

// Twice the area of the triangle: exact, coordinates have 25 bits.
std::int64_t doubled_area(GridPoint a, GridPoint b, GridPoint c) {
  const std::int64_t ux = b.x - a.x, uy = b.y - a.y, vx = c.x - a.x, vy = c.y - a.y;
  return ux * vy - uy * vx;
}

int sign(std::int64_t value) { return (value > 0) - (value < 0); }

void split(Segment& segment, GridPoint at) {
  if (at != segment.a && at != segment.b) segment.splits.push_back(at);
}

// c is on the line through the segment.
void split_if_inside(Segment& segment, GridPoint c) {
  const auto [y_min, y_max] = std::minmax(segment.a.y, segment.b.y);
  if (segment.a.x <= c.x && c.x <= segment.b.x && y_min <= c.y && c.y <= y_max) split(segment, c);
}

void meet(Segment& s, Segment& t) {
  const std::int64_t ta = doubled_area(s.a, s.b, t.a), tb = doubled_area(s.a, s.b, t.b);
  const std::int64_t sa = doubled_area(t.a, t.b, s.a), sb = doubled_area(t.a, t.b, s.b);
  if (ta == 0) split_if_inside(s, t.a);
  if (tb == 0) split_if_inside(s, t.b);
  if (sa == 0) split_if_inside(t, s.a);
  if (sb == 0) split_if_inside(t, s.b);
  if (sign(ta) * sign(tb) >= 0 || sign(sa) * sign(sb) >= 0) return;
  // The areas are doubles without rounding (52 bits), so the point is good to some 1e-8 of the grid.
  const double along = static_cast<double>(sa) / static_cast<double>(sa - sb);
  const auto between = [along](std::int32_t from, std::int32_t to) {
    return static_cast<std::int32_t>(std::lround(from + along * (static_cast<double>(to) - from)));
  };
  const GridPoint at{between(s.a.x, s.b.x), between(s.a.y, s.b.y)};
  split(s, at);
  split(t, at);
}

// Whether any was split.
bool split_once(GridSegments& segments) {
  std::vector<Segment> all;
  all.reserve(segments.size());
  for (const auto& [ends, regions] : segments) all.push_back({ends.first, ends.second, regions});
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto [y_min, y_max] = std::minmax(all[i].a.y, all[i].b.y);
    for (std::size_t k = i + 1; k < all.size() && all[k].a.x <= all[i].b.x; ++k) {
      if (std::max(all[k].a.y, all[k].b.y) < y_min || std::min(all[k].a.y, all[k].b.y) > y_max) continue;
      meet(all[i], all[k]);
    }
  }
  bool any = false;
  segments.clear();
  for (Segment& segment : all) {
    any = any || !segment.splits.empty();
    const auto along = [&](GridPoint p) {
      const std::int64_t dx = segment.b.x - segment.a.x, dy = segment.b.y - segment.a.y;
      return dx * (p.x - segment.a.x) + dy * (p.y - segment.a.y);
    };
    std::sort(segment.splits.begin(), segment.splits.end(), [&](GridPoint p, GridPoint q) {
      return along(p) != along(q) ? along(p) < along(q) : p < q;  // both are rounded: they may be side by side
    });
    GridPoint from = segment.a;
    for (const GridPoint to : segment.splits) {
      toggle(segments, from, to, segment.regions);
      from = to;
    }
    toggle(segments, from, segment.b, segment.regions);
  }
  return any;
}

}  // namespace

void toggle(GridSegments& segments, GridPoint a, GridPoint b, RegionBits regions) {
  if (a == b) return;
  const auto [place, is_new] = segments.try_emplace(std::minmax(a, b), 0);
  place->second ^= regions;
  if (place->second == 0) segments.erase(place);
}

bool split_where_they_meet(GridSegments& segments) {
  for (int round = 0; round < kMostRounds; ++round) {
    if (!split_once(segments)) return true;
  }
  return false;
}

}  // namespace formotion
