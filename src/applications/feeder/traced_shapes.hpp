// Part, voids and obstacles of a design as functions of the variables: every corner as it is written, over a scalar
// that may carry derivatives. What the exact analysis finds active is looked up here by its place.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "applications/feeder/spec.hpp"

namespace formotion::feeder {

template <class T>
using PointOf = Eigen::Matrix<T, 2, 1>;
template <class T>
using LoopOf = std::vector<PointOf<T>>;

template <class T>
struct TracedLoop {
  LoopOf<T> points;  // in the order as written; one point: a pin's centre
  double sense = 1;  // 1: what it bounds lies to the left of its edges, -1: to the right
  T radius_mm{0.0};  // of a pin
};

template <class T>
struct TracedShapes {
  std::vector<TracedLoop<T>> part;       // of one aspect, from the centre of mass: outline, holes; by layers
  std::vector<TracedLoop<T>> voids;      // in the world
  std::vector<TracedLoop<T>> obstacles;  // place k is component k + 1: component 0, the wall, does not move
};

template <class T>
T traced(const Affine& expression, std::span<const T> values) {
  T value(expression.constant);
  for (const auto& [index, coefficient] : expression.terms)
    value += coefficient * values[static_cast<std::size_t>(index)];
  return value;
}

template <class T>
LoopOf<T> traced(const AffineLoop& loop, std::span<const T> values) {
  LoopOf<T> points;
  for (const AffinePoint& p : loop) points.emplace_back(traced(p[0], values), traced(p[1], values));
  return points;
}

template <class T>
T cross_of(const PointOf<T>& a, const PointOf<T>& b) {
  return a.x() * b.y() - a.y() * b.x();
}

template <class T>
T signed_area_of(const LoopOf<T>& loop) {
  T twice(0.0);
  for (std::size_t i = 0; i < loop.size(); ++i) twice += cross_of<T>(loop[i], loop[(i + 1) % loop.size()]);
  return 0.5 * twice;
}

// Signed area times centroid.
template <class T>
PointOf<T> area_moment_of(const LoopOf<T>& loop) {
  PointOf<T> moment(T(0.0), T(0.0));
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const PointOf<T>&a = loop[i], &b = loop[(i + 1) % loop.size()];
    moment += cross_of<T>(a, b) / 6.0 * (a + b);
  }
  return moment;
}

template <class T>
class ShapeTracer {
 public:
  ShapeTracer(const FeederSpec& spec, const DesignSpec& design, int aspect, double part_diameter_mm,
              std::span<const T> values)
      : spec_(spec), values_(values) {
    trace_part(spec.part.aspects[static_cast<std::size_t>(aspect)]);
    beyond_ = spec.environment.track_width_mm + 10 * part_diameter_mm + 100;
    const T spacing = spec.environment.spacing_mm ? T(*spec.environment.spacing_mm) : T(part_diameter_mm);
    T next(0.0);
    bool any_free = false;
    for (const FeatureSpec& feature : design) {
      const std::size_t voids = shapes_.voids.size(), obstacles = shapes_.obstacles.size();
      const T length = std::visit(*this, feature.shape);
      const T start = feature.at_mm ? traced(*feature.at_mm, values) : any_free ? next : T(0.0);
      any_free = any_free || !feature.at_mm;
      for (std::size_t k = voids; k < shapes_.voids.size(); ++k) move(shapes_.voids[k], start);
      for (std::size_t k = obstacles; k < shapes_.obstacles.size(); ++k) move(shapes_.obstacles[k], start);
      next = start + length + spacing;
    }
  }

  TracedShapes<T> take() { return std::move(shapes_); }

  // One feature, from its own start; returns its length. Lengths below 0 and the like never come here: such designs
  // have no residuals.
  T operator()(const Balcony& f) {
    return box(at(f.width_mm), T(spec_.environment.track_width_mm + beyond_), at(f.length_mm));
  }
  T operator()(const Gap& f) {
    return box(T(-beyond_), T(spec_.environment.track_width_mm + beyond_), at(f.length_mm));
  }
  T operator()(const Canyon& f) { return box(at(f.from_mm), at(f.to_mm), at(f.length_mm)); }
  T operator()(const Slot& f) { return box(at(f.from_mm), at(f.to_mm), at(f.length_mm)); }
  T operator()(const Cutout& f) { return add(shapes_.voids, traced(f.polygon_mm, values_)); }
  T operator()(const Scallop& f) {
    const double width = spec_.environment.track_width_mm;
    using std::tan;
    const T depth = at(f.depth_mm), slope = tan(at(f.half_angle_rad));
    const T wide = depth * slope, wider = (depth + beyond_) * slope;
    add(shapes_.voids, {{wide, width - depth}, {wide + wider, T(width + beyond_)}, {wide - wider, T(width + beyond_)}});
    return 2.0 * wide;
  }
  T operator()(const Drawing& f) {
    T length(0.0);
    for (const Loop& loop : f.voids_mm) length = greater(length, add(shapes_.voids, constant(loop)));
    for (const Loop& loop : f.walls_mm) length = greater(length, add(shapes_.obstacles, constant(loop)));
    return length;
  }
  T operator()(const Fence& f) { return add(shapes_.obstacles, traced(f.polygon_mm, values_)); }
  T operator()(const Pin& f) {
    TracedLoop<T> pin;
    pin.points = {{at(f.x_mm), at(f.y_mm)}};
    pin.radius_mm = at(f.diameter_mm) / 2.0;
    const T end = pin.points.front().x() + pin.radius_mm;
    shapes_.obstacles.push_back(std::move(pin));
    return end;
  }
  T operator()(const WallProfile& f) {
    LoopOf<T> loop = traced(f.profile_mm, values_);
    const T end = loop.back().x();
    loop.emplace_back(loop.back().x(), T(-kDeep_mm));
    loop.emplace_back(loop.front().x(), T(-kDeep_mm));
    add(shapes_.obstacles, std::move(loop));
    return end;
  }
  // The arc's corners depend on the depth in steps: it is left without derivatives.
  T operator()(const DishOut& f) { return at(f.length_mm); }
  T operator()(const Wiper&) { return T(0.0); }
  T operator()(const HoldDown& f) { return at(f.length_mm); }

 private:
  static constexpr double kDeep_mm = 1e4;  // below whatever a profile dips to

  static T greater(const T& a, const T& b) { return a < b ? b : a; }
  T at(const Affine& expression) const { return traced(expression, values_); }
  static LoopOf<T> constant(const Loop& loop) {
    LoopOf<T> points;
    for (const Point& p : loop) points.emplace_back(T(p.x()), T(p.y()));
    return points;
  }
  static void move(TracedLoop<T>& loop, const T& by) {
    for (PointOf<T>& p : loop.points) p.x() += by;
  }
  // Returns the loop's greatest x.
  static T add(std::vector<TracedLoop<T>>& to, LoopOf<T> points) {
    T end = points.front().x();
    for (const PointOf<T>& p : points) end = greater(end, p.x());
    const double sense = signed_area_of<T>(points) < T(0.0) ? -1 : 1;
    to.push_back({std::move(points), sense, T(0.0)});
    return end;
  }
  T box(const T& y_min, const T& y_max, const T& length) {
    const T zero(0.0);
    if (zero < length && y_min < y_max)
      add(shapes_.voids, {{zero, y_min}, {length, y_min}, {length, y_max}, {zero, y_max}});
    return length;
  }

  void trace_part(const AspectSpec& aspect) {
    PointOf<T> moment(T(0.0), T(0.0));
    T mass(0.0);
    const auto body = [&](const AffineLoop& outline, const std::vector<AffineLoop>& holes, double height_mm) {
      const auto outline_or_hole = [&](const AffineLoop& written, double sign) {
        LoopOf<T> loop = traced(written, values_);
        const T area = signed_area_of<T>(loop);
        const double turned = area < T(0.0) ? -1 : 1;
        mass += sign * turned * height_mm * area;
        moment += sign * turned * height_mm * area_moment_of<T>(loop);
        shapes_.part.push_back({std::move(loop), sign * turned, T(0.0)});
      };
      outline_or_hole(outline, 1);
      for (const AffineLoop& hole : holes) outline_or_hole(hole, -1);
    };
    if (aspect.layers.empty()) body(aspect.outline_mm, aspect.holes_mm, 1);
    for (const LayerSpec& layer : aspect.layers) body(layer.outline_mm, layer.holes_mm, layer.to_mm - layer.from_mm);
    PointOf<T> com = moment / mass;
    if (aspect.com_mm) com = PointOf<T>(T(aspect.com_mm->x()), T(aspect.com_mm->y()));
    for (TracedLoop<T>& loop : shapes_.part) {
      for (PointOf<T>& p : loop.points) p -= com;
    }
  }

  const FeederSpec& spec_;
  std::span<const T> values_;
  double beyond_ = 0;
  TracedShapes<T> shapes_;
};

// The part's diameter where it sets the features' spacing counts as a constant: it is the same for small changes of
// anything but the part.
template <class T>
TracedShapes<T> traced_shapes(const FeederSpec& spec, const DesignSpec& design, int aspect, double part_diameter_mm,
                              std::span<const T> values) {
  return ShapeTracer<T>(spec, design, aspect, part_diameter_mm, values).take();
}

}  // namespace formotion::feeder
