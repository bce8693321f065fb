#include "applications/feeder/void_rule.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/geometry/boolean.hpp"

namespace formotion::feeder {
namespace {

constexpr double kSlack_mm = 1e-6;
constexpr double kNoArea_mm2 = 1e-9;

bool is_convex(const Loop& loop) {
  for (std::size_t i = 0, n = loop.size(); i < n; ++i) {
    if (cross(loop[(i + 1) % n] - loop[i], loop[(i + 2) % n] - loop[(i + 1) % n]) < -1e-12) return false;
  }
  return true;
}

// The part of a loop in the half-plane normal . p <= limit (Sutherland and Hodgman 1974); exact for convex loops.
Loop clipped(const Loop& loop, const Point& normal, double limit) {
  Loop kept;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Point& p = loop[k];
    const Point& q = loop[(k + 1) % loop.size()];
    const double dp = normal.dot(p) - limit, dq = normal.dot(q) - limit;
    if (dp <= 0) kept.push_back(p);
    if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0)) kept.push_back(p + dp / (dp - dq) * (q - p));
  }
  return kept;
}

double longest_opening(const Polygon& piece, double track_width_mm) {
  double longest = 0;
  for (std::size_t i = 0; i < piece.outer.size(); ++i) {
    const Point& a = piece.outer[i];
    const Point& b = piece.outer[(i + 1) % piece.outer.size()];
    if (std::min(a.y(), b.y()) >= track_width_mm - kSlack_mm) longest = std::max(longest, std::abs(b.x() - a.x()));
  }
  return longest;
}

std::vector<Loop> beyond_line(const Polygon& body, const Point& on_line, const Point& normal) {
  const double reach = 4 * diameter(body.outer) + 1;
  const Point along(-normal.y(), normal.x());
  // Counter-clockwise: along is normal turned by +90 degrees.
  const Loop half_plane{on_line - reach * along, on_line - reach * along + reach * normal,
                        on_line + reach * along + reach * normal, on_line + reach * along};
  return loops_of(intersection(loops_of(body), {half_plane}));
}

double area_of(const std::vector<Polygon>& polygons) {
  double area = 0;
  for (const Polygon& polygon : polygons) area += area_moments(polygon).area_mm2;
  return area;
}

constexpr double kLeastShortfall_mm = 1e-3;

// How far a piece is from letting a pose of this height and length through, by the shorter of its two ways.
double shortfall_of(const VoidPieces::Piece& piece, const Point& direction, double length_mm, double height_mm,
                    double track_width_mm) {
  if (piece.opening_mm >= height_mm - kSlack_mm) return 0;
  if (holds_rectangle(piece.polygon, direction, length_mm, height_mm)) return 0;
  const Point across(-direction.y(), direction.x());
  double top = -1e300, from = 1e300, to = -1e300, near = 1e300, far = -1e300;
  for (const Point& p : piece.polygon.outer) {
    top = std::max(top, p.y());
    from = std::min(from, direction.dot(p));
    to = std::max(to, direction.dot(p));
    near = std::min(near, across.dot(p));
    far = std::max(far, across.dot(p));
  }
  const double to_edge = std::max(0.0, track_width_mm - top) + height_mm - piece.opening_mm;
  const double to_rectangle = std::max(0.0, length_mm - (to - from)) + std::max(0.0, height_mm - (far - near));
  return std::max(kLeastShortfall_mm, std::min(to_edge, to_rectangle));
}

// 0 if the pose falls over this edge, else how far it is from that.
double shortfall_over(const PoseModel& pose, const SupportLoss::Edge& edge, const SupportLoss& loss,
                      const VoidPieces& pieces, double track_width_mm) {
  // In the world: the pose moved to the position of the loss.
  const Point offset(loss.x_mm, 0);
  const Point on_line = edge.from + offset + Point(0, pose.travelling.supported_y_mm);
  Point direction = edge.to - edge.from;
  // A single supporting point: the part tips about it, away from it.
  if (direction.norm() <= kSlack_mm) direction = Point(edge.from.y(), -edge.from.x());
  if (direction.norm() <= kSlack_mm) direction = Point(1, 0);
  direction.normalize();
  const Point normal(direction.y(), -direction.x());

  const Loop outline = placed(pose.footprint, 0, offset).outer;
  double low = 1e300, high = -1e300;
  bool over_free_edge = false;
  for (const Point& p : outline) {
    low = std::min(low, direction.dot(p));
    high = std::max(high, direction.dot(p));
    over_free_edge = over_free_edge || (p.y() > track_width_mm + kSlack_mm &&
                                        (loss.unsupported_entirely || normal.dot(p - on_line) > kSlack_mm));
  }
  if (over_free_edge) return 0;
  const auto shortfall = [&](const VoidPieces::Piece& piece) {
    return shortfall_of(piece, direction, high - low, pose.height_mm, track_width_mm);
  };
  // A group's only void is what lies under the unsupported side.
  if (pieces.pieces.size() == 1) return shortfall(pieces.pieces.front());
  const Polygon body = placed(pose.footprint, 0, offset);
  const std::vector<Loop> unsupported = loss.unsupported_entirely ? loops_of(body) : beyond_line(body, on_line, normal);
  double least = pose.height_mm;
  for (const VoidPieces::Piece& piece : pieces.pieces) {
    const double found = shortfall(piece);
    if (found >= least || area_of(intersection(unsupported, loops_of(piece.polygon))) <= kNoArea_mm2) continue;
    least = found;
  }
  return least;
}

}  // namespace

VoidPieces void_pieces(const VoidGroup& group, double track_width_mm) {
  VoidPieces result;
  std::vector<Polygon> polygons;
  if (group.loops.size() == 1 && is_convex(group.loops.front())) {
    Loop piece = clipped(clipped(group.loops.front(), {0, 1}, track_width_mm), {0, -1}, 0);
    if (piece.size() >= 3) polygons.push_back({std::move(piece), {}});
  } else {
    double x_min = 1e300, x_max = -1e300;
    for (const Loop& loop : group.loops) {
      const Box box = bounding_box(loop);
      x_min = std::min(x_min, box.min.x());
      x_max = std::max(x_max, box.max.x());
    }
    polygons = intersection(group.loops, {rectangle(x_min - 1, 0, x_max + 1, track_width_mm)});
  }
  for (Polygon& polygon : polygons) {
    const double opening = longest_opening(polygon, track_width_mm);
    result.pieces.push_back({std::move(polygon), opening});
  }
  return result;
}

bool holds_rectangle(const Polygon& polygon, const Point& direction, double length_mm, double width_mm) {
  const Point along = 0.5 * (length_mm - kSlack_mm) * direction;
  const Point across = 0.5 * (width_mm - kSlack_mm) * Point(-direction.y(), direction.x());
  if (polygon.holes.empty() && is_convex(polygon.outer)) {
    // Room for the rectangle's centre: every edge moved inwards by the rectangle's reach towards it.
    Loop room = polygon.outer;
    for (std::size_t i = 0; i < polygon.outer.size() && !room.empty(); ++i) {
      const Point& a = polygon.outer[i];
      const Point t = polygon.outer[(i + 1) % polygon.outer.size()] - a;
      const Point normal = Point(t.y(), -t.x()).normalized();
      if (t.norm() <= 1e-12) continue;
      room = clipped(room, normal, normal.dot(a) - std::abs(normal.dot(along)) - std::abs(normal.dot(across)));
    }
    return !room.empty();
  }
  // In general: the polygon without all places where the rectangle would touch an edge.
  std::vector<Loop> touched;
  for (const Loop& loop : loops_of(polygon)) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      Loop corners;
      for (const Point& end : {loop[i], loop[(i + 1) % loop.size()]}) {
        for (const Point& corner :
             {Point(along + across), Point(along - across), Point(-along + across), Point(-along - across)}) {
          corners.push_back(end + corner);
        }
      }
      touched.push_back(convex_hull(std::move(corners)));
    }
  }
  return area_of(difference(loops_of(polygon), touched)) > 0;
}

double fall_shortfall(const PoseModel& pose, const SupportLoss& loss, const VoidPieces& pieces, double track_width_mm) {
  if (loss.tipping.empty()) return shortfall_over(pose, {Point::Zero(), Point::Zero()}, loss, pieces, track_width_mm);
  double worst = 0;
  for (const SupportLoss::Edge& edge : loss.tipping) {
    worst = std::max(worst, shortfall_over(pose, edge, loss, pieces, track_width_mm));
  }
  return worst;
}

}  // namespace formotion::feeder
