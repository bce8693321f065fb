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

// How far profiles, and cuts of the wall for them, go on below the lowest point of a face: nothing reaches down there.
constexpr double kBelow_mm = 100;

struct Raw {
  std::vector<Loop> voids;
  double length = 0;
  std::vector<ObstacleShape> obstacles = {};
  std::vector<Interval> wall_cuts = {};
  Loop wall_face = {};
};

// The stretches, overlapping ones joined, ascending.
std::vector<Interval> joined(std::vector<Interval> stretches) {
  std::sort(stretches.begin(), stretches.end(), [](const Interval& a, const Interval& b) { return a.from < b.from; });
  std::vector<Interval> result;
  for (const Interval& stretch : stretches) {
    if (!result.empty() && stretch.from <= result.back().to) {
      result.back().to = std::max(result.back().to, stretch.to);
    } else {
      result.push_back(stretch);
    }
  }
  return result;
}

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
      raw.obstacles.push_back({normalised({loop, {}})});
      raw.length = std::max(raw.length, bounding_box(loop).max.x());
    }
    return raw;
  }

  Raw operator()(const Fence& f) {
    const Loop drawn = evaluated(f.polygon_mm, values_);
    Polygon polygon = normalised({drawn, {}});
    const double end = bounding_box(drawn).max.x();
    if (const auto found = defect(polygon)) return invalid(*found, 1, end);
    return {{}, end, {{std::move(polygon)}}};
  }

  Raw operator()(const Pin& f) {
    const double radius = at_least_zero("diameter_mm", f.diameter_mm) / 2;
    const Point centre(f.x_mm(values_), f.y_mm(values_));
    const double end = centre.x() + radius;
    if (radius <= 0) return invalid("diameter_mm not above 0", 1e-3, end);
    return {{}, end, {{{{centre}, {}}, radius}}};
  }

  Raw operator()(const WallProfile& f) {
    Raw raw;
    raw.wall_face = evaluated(f.profile_mm, values_);
    const double from = raw.wall_face.front().x(), to = raw.wall_face.back().x();
    raw.length = to;
    if (const auto found = profile_defect(raw.wall_face)) {
      invalid_.push_back({*found, where_, std::max(1e-3, from - to)});
      raw.wall_face.clear();
      return raw;
    }
    // The body goes deeper than the wall's cut, so that no hollow is between them when it is made smaller.
    const Box box = bounding_box(raw.wall_face);
    const double below = std::min(0.0, box.min.y()) - kBelow_mm;
    Loop body = raw.wall_face;
    body.emplace_back(to, below - kBelow_mm);
    body.emplace_back(from, below - kBelow_mm);
    raw.obstacles.push_back({normalised({body, {}})});
    // The wall stays under what stands on it: a body that is made smaller leaves no slit there.
    for (const Polygon& hollow : difference({rectangle(from, below, to, 0)}, {raw.obstacles[0].area.outer})) {
      const Box of_hollow = bounding_box(hollow.outer);
      raw.wall_cuts.push_back({of_hollow.min.x(), of_hollow.max.x()});
    }
    raw.wall_cuts = joined(std::move(raw.wall_cuts));
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

void place_obstacles(Raw& raw, LaidFeature& feature) {
  feature.obstacles = std::move(raw.obstacles);
  for (ObstacleShape& obstacle : feature.obstacles) {
    for (Point& p : obstacle.area.outer) p.x() += feature.start_mm;
  }
  for (const Interval& cut : raw.wall_cuts) {
    feature.wall_cuts.push_back({cut.from + feature.start_mm, cut.to + feature.start_mm});
  }
  feature.wall_face_mm = std::move(raw.wall_face);
  for (Point& p : feature.wall_face_mm) p.x() += feature.start_mm;
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

std::vector<VoidGroup> grouped(const Layout& layout, double reach_mm, bool in_own_frames) {
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
    end = std::max(end, feature.x_max);
  }
  for (VoidGroup& group : groups) {
    const bool own = in_own_frames && group.features.size() == 1;
    if (own) group.origin_mm = layout.features[group.features.front()].start_mm;
    for (const int i : group.features) {
      const std::vector<Loop>& voids = own ? layout.features[i].own_voids : layout.features[i].voids;
      group.loops.insert(group.loops.end(), voids.begin(), voids.end());
    }
    if (boxes_overlap(group.loops)) group.loops = loops_of(united(group.loops));
  }
  return groups;
}

}  // namespace

std::optional<std::string> profile_defect(const Loop& face) {
  if (face.size() < 2) return "a profile of fewer than two corners";
  const double from = face.front().x(), to = face.back().x();
  if (from >= to) return "a profile whose first corner is not before its last";
  for (const Point& p : face) {
    if (p.x() < from || p.x() > to) return "a profile that leaves the stretch between its first and its last corner";
  }
  const double below = std::min(0.0, bounding_box(face).min.y()) - 1;
  Loop body = face;
  body.emplace_back(to, below);
  body.emplace_back(from, below);
  if (const auto found = defect(normalised({body, {}}))) return "with the wall below, " + *found;
  return std::nullopt;
}

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
    place_obstacles(raw, feature);
    if (manufacture.cutter_radius_mm && *manufacture.cutter_radius_mm > 0) {
      feature.voids = milled(feature.voids, *manufacture.cutter_radius_mm, where, layout.invalid);
    }
    feature.own_voids = feature.voids;
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

std::vector<Interval> recesses(const Layout& layout) {
  std::vector<Interval> cuts;
  for (const LaidFeature& feature : layout.features)
    cuts.insert(cuts.end(), feature.wall_cuts.begin(), feature.wall_cuts.end());
  return joined(std::move(cuts));
}

std::vector<VoidGroup> grouped(const Layout& layout, double reach_mm) { return grouped(layout, reach_mm, false); }

std::vector<VoidGroup> grouped_in_own_frames(const Layout& layout, double reach_mm) {
  return grouped(layout, reach_mm, true);
}

std::vector<ObstacleShape> obstacle_shapes(const Layout& layout, double far_mm) {
  std::vector<ObstacleShape> shapes(1);
  std::vector<Interval> cuts;
  double lowest = 0;
  for (const LaidFeature& feature : layout.features) {
    cuts.insert(cuts.end(), feature.wall_cuts.begin(), feature.wall_cuts.end());
    for (const Point& p : feature.wall_face_mm) lowest = std::min(lowest, p.y());
    shapes.insert(shapes.end(), feature.obstacles.begin(), feature.obstacles.end());
  }
  cuts = joined(std::move(cuts));
  if (!cuts.empty()) far_mm = std::max({far_mm, 1 - cuts.front().from, cuts.back().to + 1});
  // One piece below all cuts, so that it is one component: its face with the cuts in it, from right to left.
  const double deep = lowest - 3 * kBelow_mm;
  Loop& wall = shapes[0].area.outer;
  wall = {{-far_mm, deep}, {far_mm, deep}, {far_mm, 0}};
  for (auto cut = cuts.rbegin(); cut != cuts.rend(); ++cut) {
    const double bottom = lowest - kBelow_mm;
    wall.insert(wall.end(), {{cut->to, 0}, {cut->to, bottom}, {cut->from, bottom}, {cut->from, 0}});
  }
  wall.emplace_back(-far_mm, 0);
  shapes[0].is_datum = true;
  return shapes;
}

int feature_of(const Layout& layout, int component) {
  int first = 1;
  for (std::size_t i = 0; i < layout.features.size(); ++i) {
    const int count = static_cast<int>(layout.features[i].obstacles.size());
    if (component >= first && component < first + count) return static_cast<int>(i);
    first += count;
  }
  return -1;
}

std::string obstacle_name(const Layout& layout, int component) {
  const int feature = feature_of(layout, component);
  return feature < 0 ? "the wall"
                     : "feature " + std::to_string(feature) + " (" +
                           layout.features[static_cast<std::size_t>(feature)].type + ")";
}

}  // namespace formotion::feeder
