#include "analysis/energy/convex_cover.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/geometry/boolean.hpp"

namespace formotion {
namespace {

constexpr double kReflex_mm = 5e-9;  // corners that are in by less are on the line: grid of boolean.hpp
constexpr double kSame_mm = 3e-9;
constexpr int kMostCorners = 720;     // of a full round one
constexpr double kAskew[]{1.0, 2.2};  // rad: lines that no edge lies on cut holes open

// A cut from corner `from` along a ray to the boundary: at the corner `to`, or in the edge that begins there.
struct Cut {
  std::size_t from = 0, to = 0;
  std::optional<Point> in_edge;
};

std::optional<Cut> cut_along(const Loop& loop, std::size_t from, const Point& ray) {
  const std::size_t n = loop.size();
  std::optional<Cut> cut;
  double nearest = 1e300;
  for (std::size_t k = 0; k < n; ++k) {  // the first corner on the ray
    const Point off = loop[k] - loop[from];
    const double at = ray.dot(off);
    if (k == from || at <= kSame_mm || at >= nearest || std::abs(cross(ray, off)) > kSame_mm) continue;
    nearest = at;
    cut = Cut{from, k, {}};
  }
  for (std::size_t k = 0; k < n; ++k) {  // an edge that is met from its material's side
    const Point &a = loop[k], &b = loop[(k + 1) % n];
    if (k == from || (k + 1) % n == from) continue;
    const double side_a = cross(ray, a - loop[from]), side_b = cross(ray, b - loop[from]);
    if (!(side_a < -kSame_mm && side_b > kSame_mm)) continue;
    const Point hit = a + side_a / (side_a - side_b) * (b - a);
    const double at = ray.dot(hit - loop[from]);
    if (at <= kSame_mm || at >= nearest - kSame_mm) continue;
    nearest = at;
    cut = Cut{from, k, hit};
  }
  return cut;
}

std::optional<Cut> first_cut(const Loop& loop, bool along_first) {
  const std::size_t n = loop.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point before = loop[i] - loop[(i + n - 1) % n], after = loop[(i + 1) % n] - loop[i];
    const double across = (before + after).norm();
    if (across == 0 || cross(before, after) / across > -kReflex_mm) continue;
    if (const auto cut = cut_along(loop, i, (along_first ? before : Point(-after)).normalized())) return cut;
  }
  return std::nullopt;
}

void cut_up(const Loop& loop, bool along_first, std::vector<Loop>& pieces) {
  const std::optional<Cut> cut = loop.size() > 3 ? first_cut(loop, along_first) : std::nullopt;
  if (!cut) {
    pieces.push_back(loop);
    return;
  }
  const std::size_t n = loop.size();
  Loop first, second;
  for (std::size_t k = cut->from; k != cut->to; k = (k + 1) % n) first.push_back(loop[k]);
  first.push_back(loop[cut->to]);
  if (cut->in_edge) {
    first.push_back(*cut->in_edge);
    second.push_back(*cut->in_edge);
  }
  for (std::size_t k = cut->in_edge ? (cut->to + 1) % n : cut->to; k != cut->from; k = (k + 1) % n) {
    second.push_back(loop[k]);
  }
  second.push_back(loop[cut->from]);
  cut_up(first, along_first, pieces);
  cut_up(second, along_first, pieces);
}

// Without holes: cut along lines through them.
void cut_open(const Polygon& polygon, double askew_rad, std::vector<Loop>& simple) {
  if (polygon.holes.empty()) {
    simple.push_back(polygon.outer);
    return;
  }
  const Box hole = bounding_box(polygon.holes.front());
  const Point at = (hole.min + hole.max) / 2;
  for (const double side : {1.0, -1.0}) {
    const Point along = side * (4 * diameter(polygon.outer) + 1) * Point(std::cos(askew_rad), std::sin(askew_rad));
    const Point left = turned_left(along);
    const Loop half{at - along, at + along, at + along + left, at - along + left};
    for (const Polygon& part : intersection(loops_of(polygon), {half})) cut_open(part, askew_rad, simple);
  }
}

bool is_within(const ConvexPiece& inner, const ConvexPiece& outer) {
  return std::all_of(inner.corners.begin(), inner.corners.end(), [&](const Point& p) {
    for (std::size_t i = 0; i < outer.normals.size(); ++i) {
      if (outer.normals[i].dot(p) > outer.offsets_mm[i] + kSame_mm) return false;
    }
    return true;
  });
}

void keep_greatest(std::vector<ConvexPiece>& pieces) {
  std::vector<ConvexPiece> kept;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    bool needed = true;
    for (std::size_t k = 0; k < pieces.size() && needed; ++k) {
      if (k != i && is_within(pieces[i], pieces[k])) needed = i < k && is_within(pieces[k], pieces[i]);
    }
    if (needed) kept.push_back(pieces[i]);
  }
  pieces = std::move(kept);
}

Loop round_corner(const FixedCorner& corner, RoundCorners rounding, double sagitta_mm) {
  const double r = corner.radius_mm, width = std::min(corner.normals.width_rad, 2 * std::numbers::pi);
  const bool full = width >= 2 * std::numbers::pi;
  const double most = 2 * std::acos(std::max(0.5, r / (r + sagitta_mm)));
  const int steps = std::clamp(static_cast<int>(std::ceil(width / most)), full ? 8 : 1, kMostCorners);
  const double step = width / steps;
  const auto at = [&](double angle, double radius) {
    return Point(corner.centre + radius * Point(std::cos(angle), std::sin(angle)));
  };
  const double from = corner.normals.from_rad;
  Loop loop;
  if (!full) loop.push_back(corner.centre);
  if (rounding == RoundCorners::Inscribed) {
    for (int i = 0; i < steps + (full ? 0 : 1); ++i) loop.push_back(at(from + i * step, r));
  } else {
    if (!full) loop.push_back(at(from, r));
    for (int i = 0; i < steps; ++i) loop.push_back(at(from + (i + 0.5) * step, r / std::cos(step / 2)));
    if (!full) loop.push_back(at(from + width, r));
  }
  return loop;
}

}  // namespace

ConvexPiece ConvexPiece::of(const Loop& points) {
  ConvexPiece piece;
  for (const Point& p : convex_hull(points)) {  // corners that are one give edges of no direction
    const auto is_same = [&p](const Point& q) { return (p - q).cwiseAbs().maxCoeff() < kSame_mm; };
    if (std::none_of(piece.corners.begin(), piece.corners.end(), is_same)) piece.corners.push_back(p);
  }
  const std::size_t n = piece.corners.size();
  piece.holds_origin = n > 2;
  for (std::size_t i = 0; i < n; ++i) {
    const Point &p = piece.corners[i], along = (piece.corners[(i + 1) % n] - p).normalized();
    piece.normals.emplace_back(along.y(), -along.x());
    piece.offsets_mm.push_back(piece.support_mm(piece.normals.back()));
    piece.holds_origin = piece.holds_origin && piece.offsets_mm.back() > 0;
    piece.reach_mm = std::max(piece.reach_mm, p.norm());
    piece.box.include(p);
  }
  return piece;
}

double ConvexPiece::support_mm(const Point& direction) const {
  double most = -1e300;
  for (const Point& p : corners) most = std::max(most, direction.dot(p));
  return most;
}

std::vector<ConvexPiece> convex_cover(const Polygon& area) {
  const Polygon clean = normalised(area, kSame_mm);
  Loop given;
  for (const Loop& loop : loops_of(clean)) given.insert(given.end(), loop.begin(), loop.end());
  std::vector<ConvexPiece> pieces;
  for (const bool along_first : {true, false}) {
    std::vector<Loop> simple, loops;
    cut_open(clean, kAskew[along_first ? 0 : 1], simple);
    for (Loop& loop : simple) {
      for (Point& p : loop) {  // back from the grid
        for (const Point& corner : given) {
          if ((p - corner).cwiseAbs().maxCoeff() < kSame_mm) p = corner;
        }
      }
      cut_up(loop, along_first, loops);
    }
    for (const Loop& loop : loops) {
      ConvexPiece piece = ConvexPiece::of(loop);
      if (piece.corners.size() > 2) pieces.push_back(std::move(piece));
    }
  }
  keep_greatest(pieces);
  return pieces;
}

std::vector<ConvexPiece> convex_cover(const Obstacles& obstacles, double turned_rad, RoundCorners rounding,
                                      double sagitta_mm) {
  const double c = std::cos(turned_rad), s = std::sin(turned_rad);
  std::vector<ConvexPiece> pieces;
  const auto add = [&](Loop loop) {
    for (Point& p : loop) p = rotated(p, c, -s);
    pieces.push_back(ConvexPiece::of(loop));
  };
  for (const Polygon& area : obstacles.areas) {
    for (const ConvexPiece& piece : convex_cover(area)) add(piece.corners);
  }
  for (const FixedCorner& corner : obstacles.corners) {
    if (corner.radius_mm > 0) add(round_corner(corner, rounding, sagitta_mm));
  }
  keep_greatest(pieces);
  return pieces;
}

}  // namespace formotion
