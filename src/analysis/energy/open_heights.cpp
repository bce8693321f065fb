#include "analysis/energy/open_heights.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace formotion {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLevel = 1e-12;     // normals that rise by less bound no height
constexpr double kTouch_mm = 9e-10;  // less than kTouching_mm

// What one pair closes for certain, so far.
struct Closed {
  double low = -kInfinity, high = kInfinity;
  bool is_empty() const { return !(low < high); }
  // n . q < bound everywhere across.
  void limit(const Point& n, double bound, const RealRange& across) {
    const double least = bound - std::max(n.x() * across.low, n.x() * across.high);
    if (std::abs(n.y()) < kLevel) {
      if (!(least > 0)) high = -kInfinity;
    } else if (n.y() > 0) {
      high = std::min(high, least / n.y());
    } else {
      low = std::max(low, least / n.y());
    }
  }
};

// Directions counter-clockwise from one to another, by less than half a turn.
struct Arc {
  Point from, to;
  bool holds_inside(const Point& d) const { return cross(from, d) > 0 && cross(d, to) > 0; }
};

// The least reach of the piece in any of these directions.
double least_support(const ConvexPiece& piece, const Arc& arc) {
  double least = std::min(piece.support_mm(arc.from), piece.support_mm(arc.to));
  for (std::size_t i = 0; i < piece.normals.size(); ++i) {
    if (arc.holds_inside(piece.normals[i])) least = std::min(least, piece.offsets_mm[i]);
  }
  if (piece.holds_origin) return least;
  for (const Point& p : piece.corners) {  // where a corner looks straight back
    if (arc.holds_inside(-p)) least = std::min(least, piece.support_mm(-p.normalized()));
  }
  return least;
}

// m . q < h_O(m) + d for all m of the arc and all places across. More directions than decide do no harm.
void limit_by_turning_edge(const ConvexPiece& fixed, const Arc& arc, double d, const RealRange& across,
                           Closed& closed) {
  const auto limit = [&](const Point& m) { closed.limit(m, fixed.support_mm(m) + d, across); };
  limit(arc.from);
  if (arc.from == arc.to) return;
  limit(arc.to);
  for (const Point& n : fixed.normals) {
    if (arc.holds_inside(n)) limit(n);
  }
  for (const double x : {-1.0, 1.0}) {
    if (arc.holds_inside({x, 0})) limit({x, 0});
  }
  // How far across the arc's directions point, from and to: most corners' circles are touched elsewhere.
  double least = std::min(arc.from.x(), arc.to.x()), most = std::max(arc.from.x(), arc.to.x());
  if (arc.from.y() * arc.to.y() <= 0) {  // level directions are among them
    if (arc.from.x() + arc.to.x() > 0)
      most = 1;
    else
      least = -1;
  }
  for (const Point& o : fixed.corners) {
    for (const double u : {across.low, across.high}) {
      const double along = (u - o.x()) / d;
      if (!(std::abs(along) < 1) || along < least || along > most) continue;
      const double up = std::sqrt(1 - along * along);
      for (const double y : {up, -up}) {
        if (arc.holds_inside({along, y})) limit({along, y});
      }
    }
  }
}

struct Turn {
  double c, s;
  explicit Turn(double angle) : c(std::cos(angle)), s(std::sin(angle)) {}
};

// How far a piece reaches back and on across, at least, whatever its turn.
struct Spread {
  double back, on;
  Spread(const ConvexPiece& part, const Turn& from, const Turn& to)
      : back(least_support(part, {{-to.c, to.s}, {-from.c, from.s}})),
        on(least_support(part, {{to.c, -to.s}, {from.c, -from.s}})) {}
};

std::optional<RealRange> closed_by(const ConvexPiece& part, const Spread& spread, const ConvexPiece& fixed,
                                   const RealRange& across, const Turn& from, const Turn& to, double slack_mm) {
  // Beside it somewhere in the cell: most pairs end here.
  if (across.high >= fixed.box.max.x() + spread.back - slack_mm) return std::nullopt;
  if (across.low <= fixed.box.min.x() - spread.on + slack_mm) return std::nullopt;
  Closed closed;
  for (std::size_t j = 0; j < fixed.normals.size(); ++j) {
    const Point n = fixed.normals[j];
    const Arc seen{rotated(-n, to.c, -to.s), rotated(-n, from.c, -from.s)};  // by the part: it turns the other way
    closed.limit(n, fixed.offsets_mm[j] + least_support(part, seen) - slack_mm, across);
    if (closed.is_empty()) return std::nullopt;
  }
  for (std::size_t e = 0; e < part.normals.size(); ++e) {
    const Point m = -part.normals[e];
    const Arc arc{rotated(m, from.c, from.s), rotated(m, to.c, to.s)};
    limit_by_turning_edge(fixed, arc, part.offsets_mm[e] - slack_mm, across, closed);
    if (closed.is_empty()) return std::nullopt;
  }
  return RealRange{closed.low, closed.high};
}

std::vector<RealRange> heights_left(const std::vector<ConvexPiece>& part, const std::vector<ConvexPiece>& fixed,
                                    const RealRange& across, const RealRange& turn, double slack_mm) {
  const Turn from(turn.low), to(turn.high);
  std::vector<RealRange> closed;
  for (const ConvexPiece& p : part) {
    const Spread spread(p, from, to);
    for (const ConvexPiece& o : fixed) {
      if (const auto range = closed_by(p, spread, o, across, from, to, slack_mm)) closed.push_back(*range);
    }
  }
  std::sort(closed.begin(), closed.end(), [](const RealRange& a, const RealRange& b) { return a.low < b.low; });
  std::vector<RealRange> left;
  double at = -kInfinity;
  for (const RealRange& range : closed) {
    if (range.low >= at) left.push_back({at, range.low});  // of no length, too: a slot without clearance
    at = std::max(at, range.high);
  }
  left.push_back({at, kInfinity});
  return left;
}

}  // namespace

OpenHeights::OpenHeights(const ContactSpace& space, const Gravity& gravity, double sagitta_mm)
    : space_(&space), gravity_(gravity) {
  const Point across = turned_left(gravity.down);
  turned_rad_ = std::atan2(across.y(), across.x());
  for (const Polygon& body : space.part.bodies) {
    for (const ConvexPiece& piece : convex_cover(body)) part_.push_back(piece);
  }
  within_ = convex_cover(space.obstacles, turned_rad_, RoundCorners::Inscribed, sagitta_mm);
  around_ = convex_cover(space.obstacles, turned_rad_, RoundCorners::Circumscribed, sagitta_mm);
  is_round_ = std::any_of(space.obstacles.corners.begin(), space.obstacles.corners.end(),
                          [](const FixedCorner& corner) { return corner.radius_mm > 0; });
}

Place OpenHeights::place_of(const Configuration& q) const {
  return {gravity_.across_mm(q.position()), gravity_.height_mm(q), q.theta_rad - turned_rad_};
}

Configuration OpenHeights::configuration_of(const Place& place) const {
  const Point p = place.across_mm * turned_left(gravity_.down) - place.height_mm * gravity_.down;
  return {p.x(), p.y(), place.turn_rad + turned_rad_};
}

std::vector<RealRange> OpenHeights::open(const RealRange& across_mm, const RealRange& turn_rad) const {
  return heights_left(part_, within_, across_mm, turn_rad, kClosed_mm);
}

std::vector<RealRange> OpenHeights::free(double across_mm, double turn_rad) const {
  return heights_left(part_, around_, {across_mm, across_mm}, {turn_rad, turn_rad}, kTouch_mm);
}

}  // namespace formotion
