#include "analysis/geometry/boolean.hpp"

#include <cmath>
#include <polyclipping/clipper.hpp>

namespace formotion {
namespace {

constexpr double kUnitsPerMm = 1073741824.0;  // 2^30: scaling is exact

ClipperLib::Paths to_grid(const std::vector<Loop>& loops) {
  ClipperLib::Paths paths;
  paths.reserve(loops.size());
  for (const Loop& loop : loops) {
    ClipperLib::Path path;
    path.reserve(loop.size());
    for (const Point& p : loop) {
      path.emplace_back(std::llround(p.x() * kUnitsPerMm), std::llround(p.y() * kUnitsPerMm));
    }
    paths.push_back(std::move(path));
  }
  return paths;
}

Loop from_grid(const ClipperLib::Path& path) {
  Loop loop;
  loop.reserve(path.size());
  for (const auto& p : path) {
    loop.emplace_back(static_cast<double>(p.X) / kUnitsPerMm, static_cast<double>(p.Y) / kUnitsPerMm);
  }
  return loop;
}

void collect(const ClipperLib::PolyNode& node, std::vector<Polygon>& polygons) {
  for (const ClipperLib::PolyNode* outer : node.Childs) {
    Polygon polygon{from_grid(outer->Contour), {}};
    for (const ClipperLib::PolyNode* hole : outer->Childs) {
      polygon.holes.push_back(from_grid(hole->Contour));
      collect(*hole, polygons);  // islands
    }
    polygons.push_back(std::move(polygon));
  }
}

std::vector<Polygon> clip(ClipperLib::ClipType type, const std::vector<Loop>& a, const std::vector<Loop>& b) {
  ClipperLib::Clipper clipper;
  clipper.AddPaths(to_grid(a), ClipperLib::ptSubject, true);
  clipper.AddPaths(to_grid(b), ClipperLib::ptClip, true);
  ClipperLib::PolyTree tree;
  clipper.Execute(type, tree, ClipperLib::pftPositive, ClipperLib::pftPositive);
  std::vector<Polygon> polygons;
  collect(tree, polygons);
  return polygons;
}

}  // namespace

std::vector<Polygon> united(const std::vector<Loop>& loops) { return clip(ClipperLib::ctUnion, loops, {}); }
std::vector<Polygon> intersection(const std::vector<Loop>& a, const std::vector<Loop>& b) {
  return clip(ClipperLib::ctIntersection, a, b);
}
std::vector<Polygon> difference(const std::vector<Loop>& a, const std::vector<Loop>& b) {
  return clip(ClipperLib::ctDifference, a, b);
}

std::vector<Loop> loops_of(const Polygon& polygon) {
  std::vector<Loop> loops{polygon.outer};
  loops.insert(loops.end(), polygon.holes.begin(), polygon.holes.end());
  return loops;
}

std::vector<Loop> loops_of(const std::vector<Polygon>& polygons) {
  std::vector<Loop> loops;
  for (const Polygon& polygon : polygons) {
    loops.push_back(polygon.outer);
    loops.insert(loops.end(), polygon.holes.begin(), polygon.holes.end());
  }
  return loops;
}

Loop rectangle(double x_min, double y_min, double x_max, double y_max) {
  return {{x_min, y_min}, {x_max, y_min}, {x_max, y_max}, {x_min, y_max}};
}

}  // namespace formotion
