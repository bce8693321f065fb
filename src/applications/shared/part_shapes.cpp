#include "applications/shared/part_shapes.hpp"

#include <algorithm>
#include <numeric>

namespace formotion {
namespace {

constexpr double kSymmetry_mm = 1e-5;  // vertices that meet within this are the same

bool is_literal(const AffineLoop& loop) {
  return std::all_of(loop.begin(), loop.end(),
                     [](const AffinePoint& p) { return p[0].is_literal() && p[1].is_literal(); });
}

AspectShape aspect_shape(const AspectSpec& spec, std::span<const double> values) {
  AspectShape shape;
  shape.name = spec.name;
  shape.height_mm = spec.height_mm;
  shape.probability = spec.probability;
  Point first = Point::Zero();
  double volume = 0, moment_z = 0;
  if (spec.layers.empty()) {
    shape.bodies.push_back(evaluated(spec.outline_mm, spec.holes_mm, values));
    first = area_moments(shape.bodies.front()).centroid;
    moment_z = 0.5 * spec.height_mm;
  } else {
    for (const LayerSpec& layer : spec.layers) {
      shape.bodies.push_back(evaluated(layer.outline_mm, layer.holes_mm, values));
      const AreaMoments moments = area_moments(shape.bodies.back());
      const double piece = moments.area_mm2 * (layer.to_mm - layer.from_mm);
      volume += piece;
      first += piece * moments.centroid;
      moment_z += piece * 0.5 * (layer.from_mm + layer.to_mm);
    }
    first /= volume;
    moment_z /= volume;
  }
  const Point com = spec.com_mm.value_or(first);
  shape.com_height_mm = spec.com_height_mm.value_or(spec.layers.empty() ? 0.5 * spec.height_mm : moment_z);
  for (Polygon& body : shape.bodies) body = placed(body, 0, -com);
  shape.footprint = shape.bodies.front();
  return shape;
}

}  // namespace

Loop evaluated(const AffineLoop& loop, std::span<const double> values) {
  Loop points;
  points.reserve(loop.size());
  for (const AffinePoint& p : loop) points.emplace_back(p[0](values), p[1](values));
  return points;
}

Polygon evaluated(const AffineLoop& outline, const std::vector<AffineLoop>& holes, std::span<const double> values) {
  Polygon polygon{evaluated(outline, values), {}};
  for (const AffineLoop& hole : holes) polygon.holes.push_back(evaluated(hole, values));
  return normalised(std::move(polygon));
}

bool is_literal(const PartSpec& part) {
  const auto literal_all = [](const std::vector<AffineLoop>& loops) {
    return std::all_of(loops.begin(), loops.end(), [](const AffineLoop& loop) { return is_literal(loop); });
  };
  return std::all_of(part.aspects.begin(), part.aspects.end(), [&](const AspectSpec& aspect) {
    return is_literal(aspect.outline_mm) && literal_all(aspect.holes_mm) &&
           std::all_of(aspect.layers.begin(), aspect.layers.end(), [&](const LayerSpec& layer) {
             return is_literal(layer.outline_mm) && literal_all(layer.holes_mm);
           });
  });
}

std::vector<AspectShape> aspect_shapes(const PartSpec& part, std::span<const double> values) {
  std::vector<AspectShape> shapes;
  for (const AspectSpec& aspect : part.aspects) shapes.push_back(aspect_shape(aspect, values));
  return shapes;
}

std::vector<Loop> written_loops(const AspectSpec& spec, const AspectShape& shape, std::span<const double> values) {
  std::vector<Loop> loops;
  const auto add = [&](const AffineLoop& outline, const std::vector<AffineLoop>& holes) {
    loops.push_back(evaluated(outline, values));
    for (const AffineLoop& hole : holes) loops.push_back(evaluated(hole, values));
  };
  if (spec.layers.empty()) add(spec.outline_mm, spec.holes_mm);
  for (const LayerSpec& layer : spec.layers) add(layer.outline_mm, layer.holes_mm);
  const Point com = bounding_box(loops.front()).min - bounding_box(shape.bodies.front().outer).min;
  for (Loop& loop : loops) {
    for (Point& p : loop) p -= com;
  }
  return loops;
}

Loop all_corners(const AspectShape& shape) {
  Loop corners;
  for (const Polygon& body : shape.bodies) corners.insert(corners.end(), body.outer.begin(), body.outer.end());
  return corners;
}

int rotational_order(const AspectShape& shape) {
  int order = 0;
  for (const Polygon& body : shape.bodies) order = std::gcd(order, rotational_order(body, Point::Zero(), kSymmetry_mm));
  return std::max(order, 1);
}

}  // namespace formotion
