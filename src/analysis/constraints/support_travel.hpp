// Planar support of a part that travels along a track without turning: exact events instead of samples.
//
// The part moves along +x past fixed voids. In the part's frame, with the supported point as origin, every corner of
// the support hull is a generator: a corner of the part (at rest), a corner of the metal (moving with -x), or a
// crossing of a part's edge with a void's edge (moving along the part's edge). A generator lives on closed intervals of
// the travel and moves linearly there, so between the ends of lives the margin is a minimum of quadratic /
// sqrt(quadratic) over hull edges, and its least value stands at an end, at a stationary point (cubic), or where three
// generators become collinear (quadratic). Source: derived; the criterion as in planar_support.hpp.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "analysis/geometry/polygon.hpp"

namespace formotion {

// Lives that differ by less than this are taken as one event: travel shorter than it decides nothing.
inline constexpr double kEventTolerance_mm = 1e-7;
// Heights that differ by less than this are equal: the metal is closed, an edge on its rim is supported.
inline constexpr double kHeightTolerance_mm = 1e-9;
// Edges that rise by less than this are horizontal.
inline constexpr double kHorizontal_mm = kHeightTolerance_mm;

// Edges with their extents, and the corners that can carry the hull.
struct EdgeSet {
  struct Edge {
    Point a, b;
    double y_min, y_max;
    double dx_dy;  // 0 for horizontal edges
    bool horizontal;
    double x_at(double y) const;  // of a non-horizontal edge, clamped to its ends
  };
  std::vector<Edge> edges;
  Box box;
  static EdgeSet of(const std::vector<Loop>& loops);
};

// A part in a pose, relative to its supported point, clipped to the strip.
struct TravellingPart {
  EdgeSet edges;
  std::vector<Point> corners;  // convex ones
  double supported_y_mm = 0;   // height of the supported point above the wall
  double plain_margin_mm = 0;  // on a track without voids
  // placed: rotated, centre of mass at x = 0 and at its height over the wall, y = 0 being the wall.
  // wall_shift_mm: how far the supported point lies nearer to the wall than the centre of mass.
  static TravellingPart of(const Polygon& placed, double com_wall_mm, double wall_shift_mm, double track_width_mm);
};

// Voids that act together, as disjoint loops with the void on the left.
struct VoidOutline {
  EdgeSet edges;
  std::vector<Point> metal_corners;  // where the metal is convex
  static VoidOutline of(const std::vector<Loop>& loops);
};

struct Interval {
  double from = 0, to = 0;
};

// A travel: a part past voids. While the centre of mass is in an interval of held, something else keeps the part up.
struct Travel {
  const TravellingPart& part;
  const VoidOutline& voids;
  std::vector<Interval> held = {};
};

struct LeastMargin {
  double margin_mm = std::numeric_limits<double>::infinity();
  double x_mm = 0;                                 // the centre of mass's position
  bool unsupported = false;                        // somewhere before the search ended nothing of the part was on metal
  Point from = Point::Zero(), to = Point::Zero();  // ends of the deciding hull edge, relative to the supported point
};

// The least margin over the whole travel, where part and metal have points in common. Stops early as soon as a margin
// below stop_below is found, and looks only for margins below ignore_above: if there is none, the answer's
// margin is ignore_above.
LeastMargin least_margin(const Travel& travel, double stop_below = -std::numeric_limits<double>::infinity(),
                         double ignore_above = std::numeric_limits<double>::infinity());

// How support is lost.
struct SupportLoss {
  bool lost = false;
  double x_mm = 0;                    // the first position at which the margin falls below zero
  std::vector<Interval> lost_mm;      // all of the travel with negative margin or without any support, ascending
  bool unsupported_entirely = false;  // at x_mm nothing of the part is on metal
  // Tipping edges at x_mm, relative to the supported point, counter-clockwise around the hull (the part tips to the
  // right of from -> to); two where a corner is nearest and both of its edges are equally far.
  struct Edge {
    Point from, to;
  };
  std::vector<Edge> tipping;
};

// first_only: stops at the end of the first stretch without support.
SupportLoss support_loss(const Travel& travel, bool first_only = false);

// The margin at one position of the travel; none where nothing supports the part.
std::optional<double> margin_at(const Travel& travel, double x_mm);

// Open intervals of x in which the point at height y is over a void, ascending (closed metal).
std::vector<Interval> void_slice(const VoidOutline& voids, double y);

// Events of a travel and how many generators live between them: the cost of a sweep, for benchmarks.
struct TravelCount {
  int generators = 0, events = 0, hull_updates = 0, pairs = 0;
};
TravelCount count_travel(const Travel& travel);

}  // namespace formotion
