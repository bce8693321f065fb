#include "shaking/convex_pieces.hpp"

#include <algorithm>
#include <stdexcept>

namespace formotion {
namespace {

bool in_triangle(const Point& p, const Point& a, const Point& b, const Point& c) {
  return cross(b - a, p - a) >= 0 && cross(c - b, p - b) >= 0 && cross(a - c, p - c) >= 0;
}

bool is_convex(const Loop& loop) {
  const std::size_t n = loop.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point in = loop[(i + 1) % n] - loop[i], out = loop[(i + 2) % n] - loop[(i + 1) % n];
    if (cross(in, out) < -1e-9 * in.norm() * out.norm()) return false;
  }
  return true;
}

// The union of two counter-clockwise loops that share an edge; empty if they do not.
Loop joined(const Loop& a, const Loop& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      if (a[i] != b[(j + 1) % b.size()] || a[(i + 1) % a.size()] != b[j]) continue;
      Loop loop;
      for (std::size_t k = 0; k < a.size(); ++k) loop.push_back(a[(i + 1 + k) % a.size()]);
      for (std::size_t k = 2; k < b.size(); ++k) loop.push_back(b[(j + k) % b.size()]);
      return loop;
    }
  }
  return {};
}

// Whether the segment touches an edge of the loop elsewhere than in its own ends.
bool is_blocked(const Point& from, const Point& to, const Loop& loop) {
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Point &a = loop[i], &b = loop[(i + 1) % loop.size()];
    const Point along = to - from, edge = b - a;
    const double side_a = cross(along, a - from), side_b = cross(along, b - from);
    const bool is_own = a == from || a == to || b == from || b == to;
    if (!is_own && (side_a > 0) != (side_b > 0) && (cross(edge, from - a) > 0) != (cross(edge, to - a) > 0))
      return true;
    if (a != from && a != to && side_a == 0 && (a - from).dot(a - to) < 0) return true;
  }
  return false;
}

// Whether the direction leads into the area at corner i of a loop whose area is on its left.
bool leads_inside(const Loop& loop, std::size_t i, const Point& direction) {
  const std::size_t n = loop.size();
  const Point in = loop[i] - loop[(i + n - 1) % n], out = loop[(i + 1) % n] - loop[i];
  const bool left_of_in = cross(in, direction) > 0, left_of_out = cross(out, direction) > 0;
  return cross(in, out) > 0 ? left_of_in && left_of_out : left_of_in || left_of_out;
}

// The loop with the hole cut open to it: there and back over the shortest bridge between corners (Held 2001).
Loop bridged(const Loop& loop, std::size_t hole, const std::vector<Loop>& holes) {
  const Loop& inner = holes[hole];
  double shortest = 1e300;
  std::size_t from = 0, to = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    for (std::size_t j = 0; j < inner.size(); ++j) {
      const double length = (inner[j] - loop[i]).norm();
      if (length >= shortest || !leads_inside(loop, i, inner[j] - loop[i])) continue;
      bool blocked = is_blocked(loop[i], inner[j], loop);
      for (std::size_t k = 0; k < holes.size() && !blocked; ++k) blocked = is_blocked(loop[i], inner[j], holes[k]);
      if (!blocked) shortest = length, from = i, to = j;
    }
  }
  if (shortest == 1e300) return {};
  Loop cut(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(from) + 1);
  for (std::size_t j = 0; j <= inner.size(); ++j) cut.push_back(inner[(to + j) % inner.size()]);
  cut.insert(cut.end(), loop.begin() + static_cast<std::ptrdiff_t>(from), loop.end());
  return cut;
}

Loop without_holes(const Polygon& area) {
  Loop loop = area.outer;
  std::vector<Loop> holes = area.holes;
  while (!holes.empty()) {
    std::size_t next = 0;
    Loop cut;
    for (next = 0; next < holes.size() && cut.empty(); ++next) cut = bridged(loop, next, holes);
    if (cut.empty()) throw std::invalid_argument("no hole can be reached from the outline");
    loop = std::move(cut);
    holes.erase(holes.begin() + static_cast<std::ptrdiff_t>(next) - 1);
  }
  return loop;
}

}  // namespace

std::vector<Loop> convex_pieces(const Polygon& area, int max_corners) {
  std::vector<Loop> pieces;
  Loop rest = without_holes(area);
  while (rest.size() > 3) {
    const std::size_t n = rest.size();
    std::size_t ear = n;
    for (std::size_t i = 0; i < n && ear == n; ++i) {
      const Point &a = rest[(i + n - 1) % n], &b = rest[i], &c = rest[(i + 1) % n];
      if (cross(b - a, c - b) <= 0) continue;
      const bool is_empty = std::none_of(rest.begin(), rest.end(), [&](const Point& p) {
        return p != a && p != b && p != c && in_triangle(p, a, b, c);
      });
      if (is_empty) ear = i;
    }
    if (ear == n) throw std::invalid_argument("not a simple counter-clockwise polygon");
    pieces.push_back({rest[(ear + n - 1) % n], rest[ear], rest[(ear + 1) % n]});
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  pieces.push_back(rest);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (std::size_t j = i + 1; j < pieces.size(); ++j) {
      Loop both = joined(pieces[i], pieces[j]);
      if (both.empty() || both.size() > static_cast<std::size_t>(max_corners) || !is_convex(both)) continue;
      pieces[i] = std::move(both);
      pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(j));
      j = i;
    }
  }
  return pieces;
}

}  // namespace formotion
