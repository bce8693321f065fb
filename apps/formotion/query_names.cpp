#include "query_names.hpp"

#include <algorithm>
#include <cmath>

#include "applications/feeder/part_model.hpp"

namespace formotion {
namespace {

constexpr double kSamePlace_mm = 1e-5;  // the union's grid and the cleaning of outlines move points by far less
constexpr double kParallel = 1e-6;      // sine

struct Found {
  int index = -1;
  double away_mm = kSamePlace_mm;
};

Found nearest_corner(const std::vector<Loop>& loops, const Point& p) {
  Found found;
  int index = 0;
  for (const Loop& loop : loops) {
    for (const Point& corner : loop) {
      if (const double away = (p - corner).norm(); away < found.away_mm) found = {index, away};
      ++index;
    }
  }
  return found;
}

Found nearest_edge(const std::vector<Loop>& loops, const Point& p, const Point& along) {
  Found found;
  int index = 0;
  for (const Loop& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i, ++index) {
      const Point &from = loop[i], &to = loop[(i + 1) % loop.size()];
      const double length = (to - from).norm();
      if (length <= 0 || std::abs(cross(along, to - from)) > kParallel * length) continue;
      const double away = distance_to_segment(p, from, to);
      if (away + 1e-9 < found.away_mm) found = {index, away};  // ties: the first
    }
  }
  return found;
}

std::optional<int> index_of(const Found& found) {
  return found.index >= 0 ? std::optional<int>(found.index) : std::nullopt;
}

std::vector<Loop> part_loops(const feeder::AspectSpec& spec, const feeder::AspectShape& shape,
                             std::span<const double> values) {
  std::vector<Loop> loops;
  const auto add = [&](const AffineLoop& outline, const std::vector<AffineLoop>& holes) {
    loops.push_back(feeder::evaluated(outline, values));
    for (const AffineLoop& hole : holes) loops.push_back(feeder::evaluated(hole, values));
  };
  if (spec.layers.empty()) add(spec.outline_mm, spec.holes_mm);
  for (const feeder::LayerSpec& layer : spec.layers) add(layer.outline_mm, layer.holes_mm);
  const Point com = bounding_box(loops.front()).min - bounding_box(shape.bodies.front().outer).min;
  for (Loop& loop : loops) {
    for (Point& p : loop) p -= com;
  }
  return loops;
}

// A feature's obstacles as they are written.
struct Written {
  std::span<const double> values;
  const std::vector<ObstacleShape>& made;

  std::vector<Loop> operator()(const feeder::Fence& f) const { return {feeder::evaluated(f.polygon_mm, values)}; }
  std::vector<Loop> operator()(const feeder::Drawing& f) const { return f.walls_mm; }
  std::vector<Loop> operator()(const feeder::Pin& f) const { return {{{f.x_mm(values), f.y_mm(values)}}}; }
  // Behind the last corner come those of the body below.
  std::vector<Loop> operator()(const feeder::WallProfile& f) const {
    Loop loop = feeder::evaluated(f.profile_mm, values);
    const double below = bounding_box(made.front().area.outer).min.y();
    loop.emplace_back(loop.back().x(), below);
    loop.emplace_back(loop.front().x(), below);
    return {loop};
  }
  template <class Other>
  std::vector<Loop> operator()(const Other&) const {
    return {};
  }
};

}  // namespace

WrittenNames::WrittenNames(const feeder::FeederProblem& problem, int topology, std::span<const double> values,
                           const std::string& aspect, const feeder::World& world) {
  const feeder::FeederSpec& spec = problem.spec();
  const std::vector<feeder::AspectShape> shapes = problem.shapes(values);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (shapes[i].name == aspect) part_ = part_loops(spec.part.aspects[i], shapes[i], values);
  }
  // The wall's face and the cuts in it, from left to right.
  const Loop& wall = world.shapes.front().area.outer;
  fixed_.push_back({{wall.rbegin(), wall.rend()}});
  const feeder::DesignSpec& design = spec.designs[static_cast<std::size_t>(topology)];
  const std::vector<feeder::PlacedFeature> placed = problem.place(topology, values);
  for (std::size_t i = 0; i < design.size(); ++i) {
    if (placed[i].obstacles.empty()) continue;  // none, or impossible values
    for (Loop& loop : std::visit(Written{values, placed[i].obstacles}, design[i].shape)) {
      for (Point& p : loop) p.x() += placed[i].start_mm;
      fixed_.push_back({std::move(loop)});
    }
  }
}

std::optional<int> WrittenNames::moving_corner(const Point& p) const { return index_of(nearest_corner(part_, p)); }

std::optional<int> WrittenNames::moving_edge(const Point& p, const Point& along) const {
  return index_of(nearest_edge(part_, p, along));
}

namespace {

// The likely component's, else the first one that has such a place.
template <class Search>
std::pair<int, int> name_in(const std::vector<std::vector<Loop>>& fixed, int likely, const Search& search) {
  if (likely >= 0 && likely < static_cast<int>(fixed.size())) {
    if (const Found found = search(fixed[static_cast<std::size_t>(likely)]); found.index >= 0)
      return {likely, found.index};
  }
  for (std::size_t k = 0; k < fixed.size(); ++k) {
    if (const Found found = search(fixed[k]); found.index >= 0) return {static_cast<int>(k), found.index};
  }
  return {likely, -1};
}

}  // namespace

std::pair<int, int> WrittenNames::fixed_corner(const Point& p, int likely) const {
  return name_in(fixed_, likely, [&](const std::vector<Loop>& loops) { return nearest_corner(loops, p); });
}

std::pair<int, int> WrittenNames::fixed_edge(const Point& p, const Point& along, int likely) const {
  return name_in(fixed_, likely, [&](const std::vector<Loop>& loops) { return nearest_edge(loops, p, along); });
}

}  // namespace formotion
