#include "analysis/geometry/polygon.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

namespace formotion {
namespace {

std::string text(const Point& p) {
  std::ostringstream out;
  out << "(" << p.x() << ", " << p.y() << ")";
  return out.str();
}

double loop_size(const Loop& loop) {
  double size = 0;
  for (const Point& p : loop) size = std::max(size, p.cwiseAbs().maxCoeff());
  return size;
}

// Drops vertices that repeat or lie within tolerance of their neighbours' line, until none is left.
Loop simplified(Loop loop, double tolerance_mm) {
  for (std::size_t i = 0; loop.size() > 2 && i < loop.size();) {
    const Point& before = loop[(i + loop.size() - 1) % loop.size()];
    const Point& after = loop[(i + 1) % loop.size()];
    if (distance_to_segment(loop[i], before, after) <= tolerance_mm) {
      loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(i));
      i = i < 2 ? 0 : i - 2;  // the neighbours may have become superfluous
    } else {
      ++i;
    }
  }
  return loop;
}

// Whether segments a-b and c-d share a point.
bool segments_meet(const Point& a, const Point& b, const Point& c, const Point& d) {
  const auto orientation = [](const Point& p, const Point& q, const Point& r) {
    const double value = cross(q - p, r - p);
    return value > 0 ? 1 : value < 0 ? -1 : 0;
  };
  const auto within = [](const Point& p, const Point& q, const Point& r) {
    return (r.array() >= p.cwiseMin(q).array()).all() && (r.array() <= p.cwiseMax(q).array()).all();
  };
  const int abc = orientation(a, b, c), abd = orientation(a, b, d);
  const int cda = orientation(c, d, a), cdb = orientation(c, d, b);
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return (abc == 0 && within(a, b, c)) || (abd == 0 && within(a, b, d)) || (cda == 0 && within(c, d, a)) ||
         (cdb == 0 && within(c, d, b));
}

std::optional<std::string> loop_defect(const Loop& loop, const std::string& what) {
  const std::size_t n = loop.size();
  if (n < 3) return what + " has " + std::to_string(n) + " different corners";
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;
      if (segments_meet(loop[i], loop[i + 1], loop[j], loop[(j + 1) % n])) {
        return what + " meets itself: the edge from " + text(loop[i]) + " and the edge from " + text(loop[j]);
      }
    }
  }
  for (std::size_t i = 0; i < n; ++i) {  // an edge that folds back onto the one before
    const Point in = loop[(i + 1) % n] - loop[i], out = loop[(i + 2) % n] - loop[(i + 1) % n];
    if (cross(in, out) == 0 && in.dot(out) < 0) return what + " folds back at " + text(loop[(i + 1) % n]);
  }
  if (std::abs(signed_area(loop)) <= 1e-9 * std::max(1.0, loop_size(loop))) return what + " has no area";
  return std::nullopt;
}

bool loops_meet(const Loop& a, const Loop& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      if (segments_meet(a[i], a[(i + 1) % a.size()], b[j], b[(j + 1) % b.size()])) return true;
    }
  }
  return false;
}

bool maps_onto(const Loop& from, const Loop& to, const Eigen::Matrix2d& map, const Point& centre, double tolerance_mm) {
  // Vertex i of the image must meet vertex i + shift (or, for reflections, shift - i) of the loop.
  const auto n = static_cast<std::ptrdiff_t>(from.size());
  if (from.size() != to.size()) return false;
  const std::ptrdiff_t step = map.determinant() > 0 ? 1 : -1;
  const auto image = [&](std::ptrdiff_t i) -> Point {
    return centre + map * (from[static_cast<std::size_t>(i)] - centre);
  };
  for (std::ptrdiff_t shift = 0; shift < n; ++shift) {
    bool all = true;
    for (std::ptrdiff_t i = 0; i < n && all; ++i) {
      const auto j = static_cast<std::size_t>(((shift + step * i) % n + n) % n);
      all = (image(i) - to[j]).norm() <= tolerance_mm;
    }
    if (all) return true;
  }
  return false;
}

bool maps_onto_itself(const Polygon& polygon, const Eigen::Matrix2d& map, const Point& centre, double tolerance_mm) {
  if (!maps_onto(polygon.outer, polygon.outer, map, centre, tolerance_mm)) return false;
  return std::all_of(polygon.holes.begin(), polygon.holes.end(), [&](const Loop& hole) {
    return std::any_of(polygon.holes.begin(), polygon.holes.end(),
                       [&](const Loop& other) { return maps_onto(hole, other, map, centre, tolerance_mm); });
  });
}

Eigen::Matrix2d rotation(double theta) {
  Eigen::Matrix2d r;
  r << std::cos(theta), -std::sin(theta), std::sin(theta), std::cos(theta);
  return r;
}

}  // namespace

double signed_area(const Loop& loop) {
  if (loop.empty()) return 0;
  double twice = 0;
  const Point& origin = loop.front();  // relative, so that far-away loops lose no digits
  for (std::size_t i = 0; i < loop.size(); ++i) twice += cross(loop[i] - origin, loop[(i + 1) % loop.size()] - origin);
  return 0.5 * twice;
}

Polygon normalised(Polygon polygon, double tolerance_mm) {
  polygon.outer = simplified(std::move(polygon.outer), tolerance_mm);
  if (signed_area(polygon.outer) < 0) std::reverse(polygon.outer.begin(), polygon.outer.end());
  for (Loop& hole : polygon.holes) {
    hole = simplified(std::move(hole), tolerance_mm);
    if (signed_area(hole) > 0) std::reverse(hole.begin(), hole.end());
  }
  return polygon;
}

std::optional<std::string> defect(const Polygon& polygon) {
  if (auto found = loop_defect(polygon.outer, "the outline")) return found;
  for (std::size_t i = 0; i < polygon.holes.size(); ++i) {
    const Loop& hole = polygon.holes[i];
    const std::string what = "hole " + std::to_string(i);
    if (auto found = loop_defect(hole, what)) return found;
    if (loops_meet(hole, polygon.outer)) return what + " meets the outline";
    if (locate(polygon.outer, hole.front(), 0) != Side::Inside) return what + " lies outside of the outline";
    for (std::size_t j = 0; j < i; ++j) {
      const Loop& other = polygon.holes[j];
      if (loops_meet(hole, other) || locate(other, hole.front(), 0) == Side::Inside ||
          locate(hole, other.front(), 0) == Side::Inside) {
        return what + " meets hole " + std::to_string(j);
      }
    }
  }
  return std::nullopt;
}

AreaMoments area_moments(const Polygon& polygon) {
  if (polygon.outer.empty()) return {};
  const Point origin = polygon.outer.front();
  double area = 0;
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
  Point first = Point::Zero();
  const auto add = [&](const Loop& loop, double sense) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Point a = loop[i] - origin, b = loop[(i + 1) % loop.size()] - origin;
      const double c = sense * cross(a, b);
      area += c / 2;
      first += c / 6 * (a + b);
      second += c / 12 * (a * a.transpose() + b * b.transpose() + 0.5 * (a * b.transpose() + b * a.transpose()));
    }
  };
  add(polygon.outer, signed_area(polygon.outer) < 0 ? -1 : 1);
  for (const Loop& hole : polygon.holes) add(hole, signed_area(hole) > 0 ? -1 : 1);
  if (!(area > 0)) return {0, origin, Eigen::Matrix2d::Zero()};
  const Point centroid = first / area;
  return {area, origin + centroid, second - area * centroid * centroid.transpose()};
}

Box bounding_box(const Loop& loop) {
  Box box;
  for (const Point& p : loop) box.include(p);
  return box;
}

double diameter(const Loop& loop) {
  const Loop hull = convex_hull(loop);
  double squared = 0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) squared = std::max(squared, (hull[i] - hull[j]).squaredNorm());
  }
  return std::sqrt(squared);
}

Side locate(const Loop& loop, const Point& p, double tolerance_mm) {
  bool inside = false;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Point& a = loop[i];
    const Point& b = loop[(i + 1) % loop.size()];
    if (distance_to_segment(p, a, b) <= tolerance_mm) return Side::Boundary;
    if ((a.y() > p.y()) != (b.y() > p.y())) {  // half-open, so a vertex counts once
      const double side = cross(b - a, p - a);
      if ((b.y() > a.y()) == (side > 0)) inside = !inside;
    }
  }
  return inside ? Side::Inside : Side::Outside;
}

Side locate(const Polygon& polygon, const Point& p, double tolerance_mm) {
  const Side outer = locate(polygon.outer, p, tolerance_mm);
  if (outer != Side::Inside) return outer;
  for (const Loop& hole : polygon.holes) {
    const Side side = locate(hole, p, tolerance_mm);
    if (side == Side::Boundary) return side;
    if (side == Side::Inside) return Side::Outside;
  }
  return Side::Inside;
}

double distance_to_segment(const Point& p, const Point& a, const Point& b) {
  const Point along = b - a;
  const double squared = along.squaredNorm();
  if (squared == 0) return (p - a).norm();
  const double t = std::clamp((p - a).dot(along) / squared, 0.0, 1.0);
  return (p - a - t * along).norm();
}

Polygon placed(const Polygon& polygon, double theta, const Point& offset) {
  const Eigen::Matrix2d r = rotation(theta);
  Polygon moved = polygon;
  for (Point& p : moved.outer) p = r * p + offset;
  for (Loop& hole : moved.holes) {
    for (Point& p : hole) p = r * p + offset;
  }
  return moved;
}

Polygon mirrored_x(const Polygon& polygon) {
  const auto mirror = [](Loop loop) {
    for (Point& p : loop) p.x() = -p.x();
    std::reverse(loop.begin(), loop.end());
    return loop;
  };
  Polygon mirrored{mirror(polygon.outer), {}};
  for (const Loop& hole : polygon.holes) mirrored.holes.push_back(mirror(hole));
  return mirrored;
}

Loop convex_hull(Loop points) {
  std::sort(points.begin(), points.end(),
            [](const Point& a, const Point& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  Loop hull;
  const auto chain = [&hull](auto begin, auto end) {
    const std::size_t base = hull.size();
    for (auto it = begin; it != end; ++it) {
      while (hull.size() >= base + 2 && cross(hull.back() - hull[hull.size() - 2], *it - hull.back()) <= 0)
        hull.pop_back();
      hull.push_back(*it);
    }
    hull.pop_back();  // the other chain begins with it
  };
  chain(points.begin(), points.end());
  chain(points.rbegin(), points.rend());
  return hull;
}

int rotational_order(const Polygon& polygon, const Point& centre, double tolerance_mm) {
  const int n = static_cast<int>(polygon.outer.size());
  for (int k = n; k >= 2; --k) {  // a symmetry permutes the vertices without fixed ones, so k divides n
    if (n % k == 0 && maps_onto_itself(polygon, rotation(2 * std::numbers::pi / k), centre, tolerance_mm)) return k;
  }
  return 1;
}

bool has_mirror_symmetry(const Polygon& polygon, const Point& centre, double tolerance_mm) {
  // The axis passes through the centre and through vertex 0, or halves the angle between vertex 0 and its image.
  const Point first = polygon.outer.front() - centre;
  for (const Point& image : polygon.outer) {
    const Point to = image - centre;
    const double doubled = std::atan2(first.y(), first.x()) + std::atan2(to.y(), to.x());
    Eigen::Matrix2d reflection;
    reflection << std::cos(doubled), std::sin(doubled), std::sin(doubled), -std::cos(doubled);
    if (maps_onto_itself(polygon, reflection, centre, tolerance_mm)) return true;
  }
  return false;
}

}  // namespace formotion
