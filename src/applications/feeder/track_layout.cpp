#include "applications/feeder/track_layout.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/geometry/boolean.hpp"
#include "analysis/geometry/offset.hpp"
#include "applications/feeder/part_model.hpp"

namespace formotion::feeder {
namespace {

constexpr double kChord_mm = 0.002;  // arcs leave their chords by at most this

double step_for_chord(double radius) {
  return 2 * std::acos(std::max(0.0, 1 - kChord_mm / std::max(radius, kChord_mm)));
}

struct Raw {
  std::vector<Loop> voids;
  double length = 0;
  std::vector<Loop> obstacles = {};
};

// Builds a feature's voids from its own start; reports impossible values as violations.
class Builder {
 public:
  Builder(double track_width, double beyond, std::span<const double> values, std::vector<Violation>& invalid,
          std::string where)
      : width_(track_width), beyond_(beyond), values_(values), invalid_(invalid), where_(std::move(where)) {}

  Raw operator()(const Balcony& f) {
    const double length = at_least_zero("length_mm", f.length_mm), y = f.width_mm(values_);
    return box(y, width_ + beyond_, length);
  }
  Raw operator()(const Gap& f) { return box(-beyond_, width_ + beyond_, at_least_zero("length_mm", f.length_mm)); }
  Raw operator()(const Canyon& f) { return band(f); }
  Raw operator()(const Slot& f) { return band(f); }

  Raw operator()(const Cutout& f) {
    Polygon polygon = normalised({evaluated(f.polygon_mm, values_), {}});
    const double end = bounding_box(evaluated(f.polygon_mm, values_)).max.x();
    if (const auto found = defect(polygon)) {
      invalid_.push_back({*found, where_, 1});
      return {{}, end};
    }
    return {{polygon.outer}, end};
  }

  Raw operator()(const DishOut& f) {
    const double depth = at_least_zero("depth_mm", f.depth_mm), length = at_least_zero("length_mm", f.length_mm);
    if (depth > length / 2) return invalid("depth_mm greater than half of length_mm", depth - length / 2, length);
    if (depth <= 0 || length <= 0) return {{}, length};
    // The arc through the chord's ends on the free edge, depth deep; beyond the edge the circle goes on.
    const double radius = (length * length / 4 + depth * depth) / (2 * depth);
    const Point centre(length / 2, width_ - depth + radius);
    const double half = std::asin(std::min(1.0, length / 2 / radius));
    const int steps = std::max(2, static_cast<int>(std::ceil(2 * half / step_for_chord(radius))));
    Loop loop;
    for (int i = 0; i <= steps; ++i) {
      const double angle = half * (2.0 * i / steps - 1);  // from straight down
      loop.emplace_back(centre.x() + radius * std::sin(angle), centre.y() - radius * std::cos(angle));
    }
    loop.front() = {0, width_};
    loop.back() = {length, width_};
    // Far circles are cut off; what lies there is air in any case.
    const double out = std::min(beyond_, radius);
    const double wider =
        std::sqrt(std::max(0.0, radius * radius - std::pow(std::max(0.0, radius - depth - out), 2))) - length / 2;
    loop.emplace_back(length + wider, width_ + out);
    loop.emplace_back(-wider, width_ + out);
    return {{loop}, length};
  }

  Raw operator()(const Scallop& f) {
    const double depth = at_least_zero("depth_mm", f.depth_mm), half = f.half_angle_rad(values_);
    if (!(half > 0 && half < 1.5707)) return invalid("half_angle_deg outside of 0 to 90", std::abs(half - 0.7854), 0);
    const double wide = depth * std::tan(half), wider = (depth + beyond_) * std::tan(half);
    if (depth <= 0) return {{}, 0};
    return {{{{wide, width_ - depth}, {wide + wider, width_ + beyond_}, {wide - wider, width_ + beyond_}}}, 2 * wide};
  }

  Raw operator()(const Drawing& f) {
    Raw raw;
    for (const Loop& loop : f.voids_mm) {
      raw.voids.push_back(normalised({loop, {}}).outer);
      raw.length = std::max(raw.length, bounding_box(loop).max.x());
    }
    for (const Loop& loop : f.walls_mm) {
      raw.obstacles.push_back(loop);
      raw.length = std::max(raw.length, bounding_box(loop).max.x());
    }
    return raw;
  }

  Raw operator()(const Wiper&) { return {}; }
  Raw operator()(const HoldDown& f) { return {{}, at_least_zero("length_mm", f.length_mm)}; }

 private:
  Raw invalid(const std::string& what, double by, double length) {
    invalid_.push_back({what, where_, by});
    return {{}, length};
  }
  double at_least_zero(const char* key, const Affine& expression) {
    const double value = expression(values_);
    if (value < 0) invalid_.push_back({std::string(key) + " below 0", where_, -value});
    return std::max(value, 0.0);
  }
  Raw box(double y_min, double y_max, double length) const {
    if (length <= 0 || y_max <= y_min) return {{}, length};
    return {{rectangle(0, y_min, length, y_max)}, length};
  }
  template <class Band>
  Raw band(const Band& f) {
    const double from = f.from_mm(values_), to = f.to_mm(values_), length = at_least_zero("length_mm", f.length_mm);
    if (from >= to) return invalid("from_mm not below to_mm", from - to + 1e-3, length);
    return box(from, to, length);
  }

  double width_, beyond_;
  std::span<const double> values_;
  std::vector<Violation>& invalid_;
  std::string where_;
};

// What a round cutter can reach of the voids: their opening by a disc.
std::vector<Loop> milled(const std::vector<Loop>& voids, double radius, const std::string& where,
                         std::vector<Violation>& invalid) {
  std::vector<Loop> result;
  OffsetOptions options;
  options.arc_step_rad = step_for_chord(radius);
  for (const Loop& loop : voids) {
    const std::vector<Loop> reached = offset(offset({loop}, -radius, options), radius, options);
    if (reached.empty()) invalid.push_back({"the cutter does not fit into the void", where, 1});
    result.insert(result.end(), reached.begin(), reached.end());
  }
  return result;
}

void set_extent(LaidFeature& feature) {
  Box box;
  for (const Loop& loop : feature.voids) {
    for (const Point& p : loop) box.include(p);
  }
  feature.x_min = box.min.x();
  feature.x_max = box.max.x();
}

bool boxes_overlap(const std::vector<Loop>& loops) {
  std::vector<Box> boxes;
  for (const Loop& loop : loops) {
    const Box box = bounding_box(loop);
    for (const Box& other : boxes) {
      if ((box.min.array() <= other.max.array()).all() && (other.min.array() <= box.max.array()).all()) return true;
    }
    boxes.push_back(box);
  }
  return false;
}

}  // namespace

Layout lay_out(const DesignSpec& design, const Environment& environment, const Manufacture& manufacture,
               double part_diameter_mm, std::span<const double> values) {
  Layout layout;
  const double beyond = environment.track_width_mm + 10 * part_diameter_mm + 100;
  const double spacing = environment.spacing_mm.value_or(part_diameter_mm);
  double next = 0, first = 0, last = 0;
  bool any_free = false;  // a feature without at_mm has been laid: the first of them starts at 0
  for (std::size_t i = 0; i < design.size(); ++i) {
    const FeatureSpec& spec = design[i];
    const std::string where = "feature " + std::to_string(i) + " (" + type_name(spec) + ")";
    Raw raw = std::visit(Builder(environment.track_width_mm, beyond, values, layout.invalid, where), spec.shape);
    LaidFeature feature;
    feature.type = type_name(spec);
    feature.start_mm = spec.at_mm ? (*spec.at_mm)(values) : any_free ? next : 0;
    any_free = any_free || !spec.at_mm;
    feature.end_mm = feature.start_mm + raw.length;
    feature.voids = std::move(raw.voids);
    feature.obstacles = std::move(raw.obstacles);
    for (Loop& loop : feature.obstacles) {
      for (Point& p : loop) p.x() += feature.start_mm;
    }
    if (manufacture.cutter_radius_mm && *manufacture.cutter_radius_mm > 0) {
      feature.voids = milled(feature.voids, *manufacture.cutter_radius_mm, where, layout.invalid);
    }
    for (Loop& loop : feature.voids) {
      for (Point& p : loop) p.x() += feature.start_mm;
    }
    set_extent(feature);
    if (const auto* wiper = std::get_if<Wiper>(&spec.shape)) feature.blade_mm = wiper->height_mm(values);
    if (const auto* rail = std::get_if<HoldDown>(&spec.shape)) {
      feature.blade_mm = rail->height_mm(values);
      feature.holds_down = true;
    }
    first = i == 0 ? feature.start_mm : std::min(first, feature.start_mm);
    last = i == 0 ? feature.end_mm : std::max(last, feature.end_mm);
    next = feature.end_mm + spacing;
    layout.features.push_back(std::move(feature));
  }
  layout.length_mm = last - first;
  return layout;
}

std::vector<VoidGroup> grouped(const Layout& layout, double reach_mm) {
  std::vector<int> order;
  for (int i = 0; i < static_cast<int>(layout.features.size()); ++i) {
    if (!layout.features[i].voids.empty()) order.push_back(i);
  }
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return layout.features[a].x_min < layout.features[b].x_min; });
  std::vector<VoidGroup> groups;
  double end = 0;
  for (const int i : order) {
    const LaidFeature& feature = layout.features[i];
    if (groups.empty() || feature.x_min - end >= reach_mm) {
      groups.emplace_back();
      end = feature.x_max;
    }
    groups.back().features.push_back(i);
    groups.back().loops.insert(groups.back().loops.end(), feature.voids.begin(), feature.voids.end());
    end = std::max(end, feature.x_max);
  }
  for (VoidGroup& group : groups) {
    if (boxes_overlap(group.loops)) group.loops = loops_of(united(group.loops));
  }
  return groups;
}

}  // namespace formotion::feeder
