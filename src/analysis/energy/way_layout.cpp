#include "analysis/energy/way_layout.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace formotion {
namespace {

constexpr double kQuarter = std::numbers::pi / 2;
constexpr double kSameTurn_rad = 1e-7;
constexpr double kUpright = 1e-9, kTight_mm = 1e-7;
constexpr std::size_t kMostTight = 24;  // places without clearance that cells keep to
constexpr std::size_t kMostFlat = 24;   // orientations of flat contact that cells keep to
constexpr double kSagittaOfGap = 0.02, kLeastSagitta_mm = 1e-3;

double reach_of(const ContactSpace& space) { return std::max(space.part.reach_mm, 1e-3); }

double wrapped(double turn, double from) {
  const double full = 2 * std::numbers::pi;
  const double off = turn - from - full * std::floor((turn - from) / full);
  return from + (off < full - kSameTurn_rad ? off : 0);
}

void add_apart(std::vector<double>& lines, double line, double apart) {
  if (std::none_of(lines.begin(), lines.end(), [&](double other) { return std::abs(other - line) < apart; })) {
    lines.push_back(line);
  }
}

std::vector<double> turn_lines(const ContactSpace& space, const OpenHeights& heights,
                               const std::vector<Place>& places) {
  const double first = places.front().turn_rad;
  std::vector<double> lines;
  for (const Place& place : places) {
    for (int k = 0; k < 4; ++k) add_apart(lines, wrapped(place.turn_rad + k * kQuarter, first), kSameTurn_rad);
  }
  std::vector<double> flat;
  const double turned = heights.place_of({}).turn_rad;
  for (const MovingEdge& moving : space.part.edges) {
    for (const FixedEdge& fixed : space.obstacles.edges) {
      const double theta =
          std::atan2(-fixed.normal.y(), -fixed.normal.x()) - std::atan2(moving.normal.y(), moving.normal.x());
      add_apart(flat, wrapped(theta + turned, first), kSameTurn_rad);
    }
    if (flat.size() > kMostFlat) break;
  }
  if (flat.size() <= kMostFlat) {
    for (const double turn : flat) add_apart(lines, turn, kSameTurn_rad);
  }
  std::sort(lines.begin(), lines.end());
  return lines;
}

// Places across at which an upright edge of the part lies on an upright edge of the obstacles on either side: a part
// that fits between them without clearance.
std::vector<double> tight_lines(const ContactSpace& space, const OpenHeights& heights,
                                const std::vector<double>& turns) {
  const double turned = heights.place_of({}).turn_rad;
  std::vector<double> lines;
  for (const double turn : turns) {
    std::vector<double> to_left, to_right;  // where it touches what is to its left, to its right
    for (const MovingEdge& moving : space.part.edges) {
      const Point normal = rotated(moving.normal, turn);
      if (std::abs(normal.y()) > kUpright) continue;
      for (const FixedEdge& fixed : space.obstacles.edges) {
        const Point facing = rotated(fixed.normal, turned);
        if (std::abs(facing.y()) > kUpright || facing.x() * normal.x() > 0) continue;
        const double at = rotated(fixed.from, turned).x() - rotated(moving.from, turn).x();
        (normal.x() < 0 ? to_left : to_right).push_back(at);
      }
    }
    for (const double a : to_left) {
      for (const double b : to_right) {
        if (std::abs(a - b) < kTight_mm) add_apart(lines, a, kTight_mm);
      }
    }
  }
  return lines;
}

struct Extent {
  RealRange across{1e300, -1e300};
  double lowest = 1e300;
};

Extent extent_of(const Obstacles& obstacles, const Gravity& gravity) {
  Extent extent;
  const auto include = [&](const Point& p, double radius) {
    extent.across.low = std::min(extent.across.low, gravity.across_mm(p) - radius);
    extent.across.high = std::max(extent.across.high, gravity.across_mm(p) + radius);
    extent.lowest = std::min(extent.lowest, gravity.height_mm(p) - radius);
  };
  for (const FixedEdge& edge : obstacles.edges) {
    include(edge.from, 0);
    include(edge.to, 0);
  }
  for (const FixedCorner& corner : obstacles.corners) include(corner.centre, corner.radius_mm);
  return extent;
}

CellLayout laid_out(const ContactSpace& space, const OpenHeights& heights, const Gravity& gravity,
                    const std::vector<Configuration>& configurations, const std::optional<EscapeGoal>& goal,
                    const EscapeOptions& options) {
  std::vector<Place> places;
  for (const Configuration& q : configurations) places.push_back(heights.place_of(q));
  CellLayout layout;
  layout.reach_mm = reach_of(space);
  layout.least_mm = std::max(options.least_cell_mm, 1e-6);
  layout.widest_mm = std::max(2 * layout.reach_mm, layout.least_mm);
  RealRange ends = goal ? RealRange{goal->from_mm, goal->to_mm} : extent_of(space.obstacles, gravity).across;
  if (!goal) {
    for (const Place& place : places) {
      ends.low = std::min(ends.low, place.across_mm);
      ends.high = std::max(ends.high, place.across_mm);
    }
    ends.low -= 2 * layout.reach_mm;  // beside everything
    ends.high += 2 * layout.reach_mm;
  }
  layout.turn_rad = turn_lines(space, heights, places);
  std::vector<double> lines;
  for (const Place& place : places) lines.push_back(place.across_mm);
  const std::vector<double> tight = tight_lines(space, heights, layout.turn_rad);
  if (tight.size() <= kMostTight) lines.insert(lines.end(), tight.begin(), tight.end());
  layout.across_mm = {ends.low, ends.high};
  for (const double line : lines) {
    if (line > ends.low && line < ends.high) add_apart(layout.across_mm, line, layout.least_mm / 2);
  }
  std::sort(layout.across_mm.begin(), layout.across_mm.end());
  return layout;
}

double under_all(const ContactSpace& space, const Gravity& gravity, const std::vector<Configuration>& places) {
  double lowest = extent_of(space.obstacles, gravity).lowest;
  for (const Configuration& q : places) lowest = std::min(lowest, gravity.height_mm(q));
  return lowest - 2 * reach_of(space);
}

}  // namespace

LaidOutSearch::LaidOutSearch(const ContactSpace& space, const Gravity& gravity,
                             const std::vector<Configuration>& places, const std::optional<EscapeGoal>& goal,
                             const EscapeOptions& options)
    : heights_(space, gravity, std::max(kSagittaOfGap * options.gap_mm, kLeastSagitta_mm)),
      search_(heights_, laid_out(space, heights_, gravity, places, goal, options), under_all(space, gravity, places)) {}

WayDemand demand_of(const EscapeOptions& options) {
  WayDemand demand;
  demand.gap_mm = options.gap_mm;
  demand.most_cells = options.most_cells;
  demand.want_path = options.want_path;
  return demand;
}

std::optional<Configuration> pass_of(const LowestWay& way, const OpenHeights& heights) {
  if (way.path.empty()) return std::nullopt;
  return heights.configuration_of(way.path[way.highest]);
}

EscapeBracket bracket_of(const LowestWay& way, const OpenHeights& heights, const Configuration& start) {
  EscapeBracket bracket;
  const double from = heights.place_of(start).height_mm;
  bracket.lower_mm = std::max(0.0, way.lower_mm - from);
  if (way.upper_mm) bracket.upper_mm = std::max(0.0, *way.upper_mm - from);
  for (const Place& place : way.path) bracket.path.push_back(heights.configuration_of(place));
  if (!bracket.path.empty()) bracket.path.front() = start;
  bracket.pass = pass_of(way, heights);
  bracket.why = way.why;
  return bracket;
}

bool is_beyond(const EscapeGoal& goal, const Place& place) {
  return place.across_mm <= goal.from_mm || place.across_mm >= goal.to_mm;
}

EscapeGoal beyond(const Obstacles& obstacles, const Gravity& gravity) {
  const Extent extent = extent_of(obstacles, gravity);
  if (extent.across.low > extent.across.high) return {};
  return {extent.across.low, extent.across.high};
}

}  // namespace formotion
