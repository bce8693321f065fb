#include "solid/solid.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "analysis/geometry/boolean.hpp"
#include "solid/grid_segments.hpp"

// Its predicates are exact only with -frounding-math, which g++ tells of.
#if defined(__GNUC__) && !defined(__clang__) && !defined(__ROUNDING_MATH__)
#error "CGAL needs -frounding-math: link CGAL::CGAL"
#endif

namespace formotion {
namespace {

constexpr double kFinestGrid_mm = 0x1p-14;
constexpr double kJoint_mm = 0x1p-7;  // material that joins what touches goes so far
constexpr int kMostRepairs = 8;       // each with twice the reach

struct FaceInfo {
  RegionBits regions = 0;  // that the face lies in
  bool seen = false;
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertices = CGAL::Triangulation_vertex_base_with_info_2<GridPoint, Kernel>;
using Faces =
    CGAL::Triangulation_face_base_with_info_2<FaceInfo, Kernel, CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Plan = CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertices, Faces>>;

// A layer by its loops, all around material or holes in it; heights as floats.
struct Floor {
  std::vector<Loop> loops;
  float bottom = 0, top = 0;
};

bool is_in(RegionBits regions, std::size_t k) { return (regions >> k & 1U) != 0; }

GridPoint on_grid(const Point& p, double grid_mm) {
  return {static_cast<std::int32_t>(std::lround(p.x() / grid_mm)),
          static_cast<std::int32_t>(std::lround(p.y() / grid_mm))};
}

GridSegments boundaries(const std::vector<Floor>& floors, double grid_mm) {
  GridSegments segments;
  for (std::size_t k = 0; k < floors.size(); ++k) {
    for (const Loop& loop : floors[k].loops) {
      for (std::size_t i = 0; i < loop.size(); ++i)
        toggle(segments, on_grid(loop[i], grid_mm), on_grid(loop[(i + 1) % loop.size()], grid_mm), 1U << k);
    }
  }
  if (!split_where_they_meet(segments)) throw std::logic_error("the corners of a solid do not settle on their grid");
  return segments;
}

// The plane cut up by all boundaries, each face with the layers that cover it. No constraints cross, so nothing is
// constructed and all coordinates stay those of the grid.
Plan plan_of(const GridSegments& segments) {
  std::map<GridPoint, Plan::Vertex_handle> at;
  for (const auto& [ends, regions] : segments) {
    at.try_emplace(ends.first);
    at.try_emplace(ends.second);
  }
  Plan plan;
  Plan::Face_handle near;
  for (auto& [point, vertex] : at) {
    vertex = plan.insert(Plan::Point(point.x, point.y), near);
    vertex->info() = point;
    near = vertex->face();
  }
  for (const auto& [ends, regions] : segments) plan.insert_constraint(at[ends.first], at[ends.second]);
  if (plan.dimension() < 2) return plan;
  std::vector<Plan::Face_handle> open{plan.infinite_face()};
  open.front()->info() = {0, true};
  while (!open.empty()) {
    const Plan::Face_handle face = open.back();
    open.pop_back();
    for (int i = 0; i < 3; ++i) {
      const Plan::Face_handle next = face->neighbor(i);
      if (next->info().seen) continue;
      RegionBits regions = face->info().regions;
      if (face->is_constrained(i))
        regions ^= segments.at(std::minmax(face->vertex(Plan::cw(i))->info(), face->vertex(Plan::ccw(i))->info()));
      next->info() = {regions, true};
      open.push_back(next);
    }
  }
  return plan;
}

// Where layers meet themselves in a point, or the one above another in a line: what joins them, for each layer.
std::vector<std::vector<Loop>> joints(const Plan& plan, std::size_t layers, double grid_mm, double reach_mm) {
  std::vector<std::vector<Loop>> added(layers);
  const auto place = [grid_mm](const Plan::Vertex_handle v) {
    return Point(v->info().x * grid_mm, v->info().y * grid_mm);
  };
  for (const Plan::Vertex_handle v : plan.finite_vertex_handles()) {
    std::vector<int> changes(layers, 0);
    Plan::Face_circulator face = plan.incident_faces(v);
    const Plan::Face_circulator first = face;
    do {
      const RegionBits before = face->info().regions;
      const RegionBits changed = before ^ (++face)->info().regions;
      for (std::size_t k = 0; k < layers; ++k) changes[k] += is_in(changed, k) ? 1 : 0;
    } while (face != first);
    const Point p = place(v);
    for (std::size_t k = 0; k < layers; ++k) {
      if (changes[k] > 2)
        added[k].push_back(rectangle(p.x() - reach_mm, p.y() - reach_mm, p.x() + reach_mm, p.y() + reach_mm));
    }
  }
  for (const Plan::Edge& edge : plan.finite_edges()) {
    const RegionBits left = edge.first->info().regions;
    const RegionBits right = edge.first->neighbor(edge.second)->info().regions;
    const RegionBits only_left = left & ~right, only_right = right & ~left;
    for (std::size_t k = 1; k < layers; ++k) {
      const bool diagonal =
          (is_in(only_left, k) && is_in(only_right, k - 1)) || (is_in(only_right, k) && is_in(only_left, k - 1));
      if (!diagonal) continue;
      const Point a = place(edge.first->vertex(Plan::cw(edge.second)));
      const Point b = place(edge.first->vertex(Plan::ccw(edge.second)));
      const Point along = (b - a).normalized() * reach_mm, across(-along.y(), along.x());
      added[k].push_back({a - along - across, b + along - across, b + along + across, a - along + across});
    }
  }
  return added;
}

class Builder {
 public:
  Builder(const std::vector<Floor>& floors, double grid_mm) : floors_(floors), grid_mm_(grid_mm) {}

  Solid built(const Plan& plan) {
    for (const Plan::Face_handle face : plan.finite_face_handles()) {
      const RegionBits regions = face->info().regions;
      for (std::size_t level = 0; level <= floors_.size(); ++level) {
        const bool above = level < floors_.size() && is_in(regions, level);
        const bool under = level > 0 && is_in(regions, level - 1);
        if (above == under) continue;
        const auto corner = [&](int i) { return Corner{level, face->vertex(i)->info()}; };
        if (under) {
          add(corner(0), corner(1), corner(2));
        } else {
          add(corner(0), corner(2), corner(1));
        }
      }
      for (int i = 0; i < 3; ++i) {
        const RegionBits open = regions & ~face->neighbor(i)->info().regions;  // layers that end at this edge
        const GridPoint a = face->vertex(Plan::ccw(i))->info(), b = face->vertex(Plan::cw(i))->info();
        for (std::size_t k = 0; k < floors_.size(); ++k) {
          if (!is_in(open, k)) continue;
          add({k, a}, {k, b}, {k + 1, b});
          add({k, a}, {k + 1, b}, {k + 1, a});
        }
      }
    }
    return in_order();
  }

 private:
  struct Corner {
    std::size_t level = 0;
    GridPoint at;
    auto operator<=>(const Corner&) const = default;
  };

  void add(const Corner& a, const Corner& b, const Corner& c) {
    const Corner least = std::min({a, b, c});
    triangles_.push_back(least == a ? std::array{a, b, c} : least == b ? std::array{b, c, a} : std::array{c, a, b});
  }

  // By the corners, not as the triangulation happens to keep its faces.
  Solid in_order() {
    std::sort(triangles_.begin(), triangles_.end());
    std::map<Corner, int> numbers;
    for (const auto& triangle : triangles_) {
      for (const Corner& corner : triangle) numbers.try_emplace(corner);
    }
    Solid solid;
    for (auto& [corner, number] : numbers) {
      number = static_cast<int>(solid.points.size());
      solid.points.emplace_back(static_cast<float>(corner.at.x * grid_mm_), static_cast<float>(corner.at.y * grid_mm_),
                                corner.level == 0 ? 0.0F : floors_[corner.level - 1].top);
    }
    for (const auto& [a, b, c] : triangles_) solid.triangles.push_back({numbers[a], numbers[b], numbers[c]});
    return solid;
  }

  const std::vector<Floor>& floors_;
  double grid_mm_;
  std::vector<std::array<Corner, 3>> triangles_;
};

}  // namespace

Solid stacked(const std::vector<Layer>& layers) {
  std::vector<Floor> floors;
  double z = 0, largest = 0;
  for (const Layer& layer : layers) {
    Floor floor{loops_of(united(loops_of(layer.area))), static_cast<float>(z),
                static_cast<float>(z += layer.height_mm)};
    if (!(floor.top > floor.bottom)) continue;
    for (const Loop& loop : floor.loops) {
      for (const Point& p : loop) largest = std::max(largest, p.cwiseAbs().maxCoeff());
    }
    floors.push_back(std::move(floor));
  }
  double grid_mm = kFinestGrid_mm;
  while (largest + 2 > grid_mm * (kLargestCoordinate - 2)) grid_mm *= 2;  // joints may stand out
  double reach_mm = std::max(kJoint_mm, 4 * grid_mm);
  for (int repair = 0; repair < kMostRepairs; ++repair, reach_mm *= 2) {
    const GridSegments segments = boundaries(floors, grid_mm);
    if (segments.empty()) return {};
    const Plan plan = plan_of(segments);
    if (plan.dimension() < 2) return {};
    const std::vector<std::vector<Loop>> added = joints(plan, floors.size(), grid_mm, reach_mm);
    bool is_good = true;
    for (std::size_t k = 0; k < floors.size(); ++k) {
      if (added[k].empty()) continue;
      is_good = false;
      floors[k].loops.insert(floors[k].loops.end(), added[k].begin(), added[k].end());
      floors[k].loops = loops_of(united(floors[k].loops));
    }
    if (is_good) return Builder(floors, grid_mm).built(plan);
  }
  throw std::logic_error("a solid still meets itself in a point or a line");
}

}  // namespace formotion
