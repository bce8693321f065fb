#include "applications/feeder/edge_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace formotion::feeder {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kPrecision_mm = 1e-8;
constexpr double kJustBeyond_mm = 0.9 * kPrecision_mm;
constexpr int kMostRefinements = 24;
constexpr double kFineArc_rad = 0.05;

// The travel past voids that are off by e to the adverse side.
LeastMargin least_at(const GroupTravel& travel, bool kept, double e, const OffsetOptions& options,
                     std::int64_t& sweeps) {
  const std::vector<Loop> loops = offset(travel.loops, kept ? e : -e, options);
  if (loops.empty()) return {};
  ++sweeps;
  const VoidOutline outline = VoidOutline::of(loops);
  return least_margin({travel.pose.travelling, outline, travel.held});
}

// How much better than demanded the pose does at e: negative if it fails. least: where its margin is least.
double slack(const GroupTravel& travel, bool kept, double e, const std::vector<ArcTangent>& tangents,
             LeastMargin& least, std::int64_t& sweeps) {
  OffsetOptions options;
  options.tangents = tangents;
  least = least_at(travel, kept, e, options, sweeps);
  least.margin_mm = std::min(least.margin_mm, travel.pose.travelling.plain_margin_mm);
  if (kept && least.unsupported) return -e - kPrecision_mm;
  return (kept ? least.margin_mm : -least.margin_mm) - e;
}

// Whether a lost pose that seems to be kept at e is lost with finer arcs; least becomes the place where it is.
bool lost_with_finer_arcs(const GroupTravel& travel, double e, const std::vector<ArcTangent>& tangents,
                          LeastMargin& least, std::int64_t& sweeps) {
  OffsetOptions options;
  options.arc_step_rad = kFineArc_rad;
  options.tangents = tangents;
  const LeastMargin found = least_at(travel, false, e, options, sweeps);
  if (found.margin_mm >= -e) return false;
  least = found;
  return true;
}

double distance_to_loops(const Point& p, const std::vector<Loop>& loops) {
  double nearest = kInfinity;
  for (const Loop& loop : loops) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      nearest = std::min(nearest, distance_to_segment(p, loop[k], loop[(k + 1) % loop.size()]));
    }
  }
  return nearest;
}

// Makes arcs exact wherever the part's edges and corners meet them in the configuration of the least margin, and where
// arcs meet other boundaries under it. False if they were exact already: then a failure is one of the true shape.
bool make_arcs_exact(const GroupTravel& travel, bool kept, double e, const LeastMargin& least,
                     std::vector<ArcTangent>& tangents) {
  if (e <= 0) return false;
  const TravellingPart& part = travel.pose.travelling;
  const Point at(least.x_mm, part.supported_y_mm);
  const Point room = Point::Constant(0.1 * e);
  const Point lo = part.edges.box.min + at - room, hi = part.edges.box.max + at + room;
  OffsetOptions options;
  options.tangents = tangents;
  const std::vector<Loop> moved = offset(travel.loops, kept ? e : -e, options);
  std::vector<Point> corners;
  for (const Loop& loop : travel.loops) {
    for (const Point& p : loop) {
      if ((p.array() > lo.array() - e).all() && (p.array() < hi.array() + e).all()) corners.push_back(p);
    }
  }
  std::vector<ArcTangent> found;
  const auto make_exact = [&](const Point& corner, const Point& p) {
    const double angle = std::atan2(p.y() - corner.y(), p.x() - corner.x());
    const auto knows = [&](const ArcTangent& known) {
      const double apart = std::remainder(known.angle_rad - angle, 2 * std::numbers::pi);
      return known.corner == corner && e * apart * apart < kPrecision_mm;
    };
    if (std::any_of(tangents.begin(), tangents.end(), knows) || std::any_of(found.begin(), found.end(), knows)) return;
    found.push_back({corner, angle});
  };
  // A place of the exact boundary, on the arc about corner, that the polygon misses.
  const auto on_arc = [&](const Point& corner, const Point& p) {
    if ((p.array() < lo.array()).any() || (p.array() > hi.array()).any()) return;
    if (distance_to_loops(p, moved) > kPrecision_mm && distance_to_loops(p, travel.loops) > e - 1e-9)
      make_exact(corner, p);
  };
  for (const Point& corner : corners) {
    // The deciding hull edge lies on the corner between two tangents.
    for (const Point& end : {Point(least.from + at), Point(least.to + at)}) {
      const double excess = (end - corner).norm() - e;
      if (excess > kPrecision_mm && excess < 0.05 * e && distance_to_loops(end, travel.loops) > e + kPrecision_mm)
        make_exact(corner, end);
    }
    for (const EdgeSet::Edge& edge : part.edges.edges) {
      const Point a = edge.a + at, along = edge.b - edge.a, from = a - corner;
      // A corner of the part between the arc and its tangents.
      const double out = from.norm() - e;
      if (out > 0 && out < 0.05 * e && distance_to_loops(a, travel.loops) > e) make_exact(corner, a);
      // The edge about to touch the arc.
      const Point normal = Point(along.y(), -along.x()).normalized();
      for (const double side : {-e, e}) {
        const Point touching = corner + side * normal;
        if (distance_to_segment(touching, a, a + along) < 0.05 * e) on_arc(corner, touching);
      }
      const double aa = along.squaredNorm(), half_b = from.dot(along), c = from.squaredNorm() - e * e;
      const double discriminant = half_b * half_b - aa * c;
      if (discriminant < 0) continue;
      for (const double sign : {-1.0, 1.0}) {
        const double t = (-half_b + sign * std::sqrt(discriminant)) / aa;
        if (t >= 0 && t <= 1) on_arc(corner, a + t * along);
      }
    }
    for (const Point& other : corners) {  // two arcs
      const Point between = other - corner;
      const double d = between.norm();
      if (d <= 1e-9 || d >= 2 * e) continue;
      const Point across(-between.y() / d, between.x() / d);
      for (const double side : {-1.0, 1.0}) {
        on_arc(corner, corner + 0.5 * between + side * std::sqrt(e * e - 0.25 * d * d) * across);
      }
    }
    for (const Loop& loop : travel.loops) {  // an arc and a straight edge, moved
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const Point t = (loop[(k + 1) % loop.size()] - loop[k]).normalized();
        const Point normal = (kept ? e : -e) * Point(t.y(), -t.x());
        const Point from = loop[k] + normal - corner;
        const double off = cross(t, from);
        if (std::abs(off) >= e) continue;
        const Point foot = corner + off * Point(-t.y(), t.x());
        for (const double side : {-1.0, 1.0}) on_arc(corner, foot + side * std::sqrt(e * e - off * off) * t);
      }
    }
  }
  tangents.insert(tangents.end(), found.begin(), found.end());
  return !found.empty();
}

// Arcs are made exact where they may be to blame for a failure; false if they are not. A kept pose that fails at one
// place of the true shape fails. A lost one is kept at every place: elsewhere arcs may be to blame.
bool blame_arcs(const GroupTravel& travel, bool kept, double e, LeastMargin& least, std::vector<ArcTangent>& tangents,
                std::int64_t& sweeps) {
  if (make_arcs_exact(travel, kept, e, least, tangents)) return true;
  return !kept && lost_with_finer_arcs(travel, e, tangents, least, sweeps) &&
         make_arcs_exact(travel, kept, e, least, tangents);
}

}  // namespace

EdgeError::EdgeError(const GroupTravel& travel, bool kept, double most_mm)
    : travel_(travel),
      kept_(kept),
      most_(most_mm),
      high_(most_mm),
      at_low_(most_mm),
      ended_(most_mm <= 0),
      last_width_(kInfinity) {}

bool EdgeError::bears(double e_mm, std::int64_t& sweeps) {
  if (e_mm > most_) return false;
  while (low_ < e_mm && !ended_) step(sweeps);
  return low_ >= e_mm;
}

double EdgeError::largest(std::int64_t& sweeps) {
  while (!ended_) step(sweeps);
  return low_;
}

// Half of what there is without errors first: where one edge decides, the margin falls as fast as the demand rises.
// Then regula falsi with bisection where it does not halve the bracket: slack falls with e, but may jump.
void EdgeError::step(std::int64_t& sweeps) {
  const double width = high_ - low_;
  if (width <= kPrecision_mm) return refine_or_end(sweeps);
  if (beyond_) {
    const double e = *beyond_;
    beyond_.reset();
    return probe(e, sweeps);
  }
  double e = high_;
  if (!tried_half_) {
    tried_half_ = true;
    e = 0.5 * most_;
  } else if (tried_high_) {
    const bool bisect = width > 0.5 * last_width_;
    last_width_ = bisect ? kInfinity : width;
    e = bisect ? 0.5 * (low_ + high_) : low_ + width * at_low_ / (at_low_ - at_high_);
    e = std::clamp(e, low_ + 0.5 * kPrecision_mm, high_ - 0.5 * kPrecision_mm);
  }
  probe(e, sweeps);
  if (e == low_ && e < most_) beyond_ = std::min(e + kJustBeyond_mm, high_);
  if (e == high_ && e > low_ && e < most_) beyond_ = std::max(e - kJustBeyond_mm, 0.5 * (low_ + high_));
}

void EdgeError::probe(double e, std::int64_t& sweeps) {
  LeastMargin least;
  const double value = slack(travel_, kept_, e, tangents_, least, sweeps);
  if (value >= 0) {
    low_ = e;
    at_low_ = value;
    return;
  }
  high_ = e;
  at_high_ = value;
  tried_high_ = true;
  failed_e_ = e;
  failed_ = least;
}

// The bracket is as narrow as asked for. If arcs are to blame for its upper end, that is tried once more with better
// ones, and what lies above it is open again.
void EdgeError::refine_or_end(std::int64_t& sweeps) {
  beyond_.reset();
  ended_ = low_ == most_ || !tried_high_ || ++refinements_ > kMostRefinements ||
           !blame_arcs(travel_, kept_, failed_e_, failed_, tangents_, sweeps);
  if (ended_) return;
  beyond_ = high_;
  high_ = most_;
  tried_high_ = false;
  last_width_ = kInfinity;
}

bool bears_error(const GroupTravel& travel, bool kept, double e_mm, std::int64_t& sweeps) {
  std::vector<ArcTangent> tangents;
  LeastMargin least;
  for (int refinement = 0; refinement <= kMostRefinements; ++refinement) {
    if (slack(travel, kept, e_mm, tangents, least, sweeps) >= 0) return true;
    if (!blame_arcs(travel, kept, e_mm, least, tangents, sweeps)) return false;
  }
  return false;
}

}  // namespace formotion::feeder
