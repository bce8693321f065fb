#include "applications/feeder/carved.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/geometry/boolean.hpp"

namespace formotion::feeder {
namespace {

constexpr double kSame_mm = 1e-3;
constexpr double kShifts[] = {0, 0.25, -0.25, 0.5, -0.5};  // of a part beside another, in its lengths
constexpr double kDegree = std::numbers::pi / 180;

// An expression and what it shall be worth.
struct Wish {
  const Affine* expression;
  double value;
};

// Values that fulfil the wishes one after the other, as far as the bounds let them: of what an expression leaves open,
// the last variable gives way.
std::vector<double> values_for(const std::vector<Wish>& wishes, const std::vector<Variable>& variables) {
  std::vector<double> values;
  for (const Variable& variable : variables) values.push_back(variable.start());
  std::vector<bool> settled(variables.size(), false);
  for (const Wish& wish : wishes) {
    const std::pair<int, double>* open = nullptr;
    for (const auto& term : wish.expression->terms) {
      if (!settled[term.first]) open = &term;
    }
    if (!open) continue;
    const auto& [index, coefficient] = *open;
    const double wanted = values[index] + (wish.value - (*wish.expression)(values)) / coefficient;
    values[index] = std::clamp(wanted, variables[index].min, variables[index].max);
    for (const auto& term : wish.expression->terms) settled[term.first] = true;
  }
  return values;
}

std::vector<double> middles(std::vector<double> places) {
  std::sort(places.begin(), places.end());
  std::vector<double> between;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    if (places[i + 1] - places[i] > kSame_mm) between.push_back(0.5 * (places[i] + places[i + 1]));
  }
  return between;
}

// The convex hull with k corners: those of least area go, then the longest edges are halved.
Loop hull_of_corners(const Loop& points, std::size_t k) {
  Loop hull = convex_hull(points);
  const auto at = [&](std::size_t i) -> const Point& { return hull[i % hull.size()]; };
  while (hull.size() > k) {
    std::size_t least = 0;
    double area = 1e300;
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const double found = cross(at(i + 1) - at(i), at(i + 2) - at(i));
      if (found >= area) continue;
      area = found;
      least = (i + 1) % hull.size();
    }
    hull.erase(hull.begin() + static_cast<std::ptrdiff_t>(least));
  }
  while (!hull.empty() && hull.size() < k) {
    std::size_t longest = 0;
    for (std::size_t i = 1; i < hull.size(); ++i) {
      if ((at(i + 1) - at(i)).norm() > (at(longest + 1) - at(longest)).norm()) longest = i;
    }
    hull.insert(hull.begin() + static_cast<std::ptrdiff_t>(longest) + 1, 0.5 * (at(longest) + at(longest + 1)));
  }
  return hull;
}

class Carver {
 public:
  Carver(const std::vector<Variable>& variables, const PartModel& part, const Environment& environment,
         const std::vector<int>& wanted)
      : variables_(variables), part_(part), environment_(environment), wanted_(wanted) {}

  std::vector<std::vector<double>> take() { return std::move(found_); }

  void operator()(const Balcony& f) {
    for (const double width : middles(heights())) {
      for (const double longer : {1.1, 1.5}) add({{&f.width_mm, width}, {&f.length_mm, longer * part_.longest_mm}});
    }
  }

  void operator()(const Gap& f) {
    std::vector<double> lengths{0, 1.1 * part_.longest_mm};
    for (const PoseModel& pose : part_.poses) lengths.push_back(shortest_gap(pose));
    for (const double length : middles(lengths)) add({{&f.length_mm, length}});
  }
  void operator()(const Canyon& f) { band(f); }
  void operator()(const Slot& f) { band(f); }

  void operator()(const DishOut& f) {
    for (const double height : middles(heights())) {
      for (const double longer : {1.1, 2.0}) {
        add({{&f.length_mm, longer * part_.longest_mm}, {&f.depth_mm, environment_.track_width_mm - height}});
      }
    }
  }
  void operator()(const Scallop& f) {
    for (const double height : middles(heights())) {
      for (const double half : {20.0, 45.0, 65.0})
        add({{&f.half_angle_rad, half * kDegree}, {&f.depth_mm, environment_.track_width_mm - height}});
    }
  }
  void operator()(const Wiper& f) {
    std::vector<double> tall;
    for (const PoseModel& pose : part_.poses) tall.push_back(pose.height_mm);
    for (const double height : middles(tall)) add({{&f.height_mm, height}});
  }

  // What pose j covers and pose g does not, both on the wall, is carved out as far as it makes one hull; alone, and
  // open to the free edge.
  void operator()(const Cutout& f) {
    std::vector<std::pair<int, int>> pairs;
    const int count = static_cast<int>(part_.poses.size());
    for (int g = 0; g < count; ++g) {
      if (!wanted_.empty() && std::find(wanted_.begin(), wanted_.end(), g) == wanted_.end()) continue;
      for (int j = 0; j < count; ++j) {
        if (j != g) pairs.emplace_back(g, j);
      }
    }
    const auto prior = [&](const std::pair<int, int>& pair) {
      return part_.poses[pair.first].stable.prior + part_.poses[pair.second].stable.prior;
    };
    std::stable_sort(pairs.begin(), pairs.end(), [&](const auto& a, const auto& b) { return prior(a) > prior(b); });
    for (const double shift : kShifts) {
      for (const bool open : {true, false}) {
        for (const auto& [g, j] : pairs) carve(f, part_.poses[g], part_.poses[j], shift, open);
      }
    }
  }

  void operator()(const auto&) {}

 private:
  void add(const std::vector<Wish>& wishes) {
    if (found_.size() >= kMostCarved) return;
    std::vector<double> values = values_for(wishes, variables_);
    if (std::find(found_.begin(), found_.end(), values) == found_.end()) found_.push_back(std::move(values));
  }

  // Heights of supported points, from the wall to the free edge: what is cut away down to one of them loses its pose.
  std::vector<double> heights() const {
    std::vector<double> places{0, environment_.track_width_mm};
    for (const PoseModel& pose : part_.poses) places.push_back(pose.travelling.supported_y_mm);
    return places;
  }

  // The shortest gap, about, that loses the pose: longer ones take more away.
  double shortest_gap(const PoseModel& pose) const {
    double low = 0, high = pose.x_max - pose.x_min;
    while (high - low > kSame_mm) {
      const double length = 0.5 * (low + high);
      const VoidOutline gap = VoidOutline::of({rectangle(0, -1, length, environment_.track_width_mm + 1)});
      (least_margin({pose.travelling, gap}, 0).margin_mm < 0 ? high : low) = length;
    }
    return high;
  }

  // A band loses a pose whose supported point lies beyond its lower edge if it reaches to no metal beyond the upper
  // one.
  template <class Band>
  void band(const Band& f) {
    std::vector<double> tops{0, environment_.track_width_mm};
    for (const PoseModel& pose : part_.poses) tops.push_back(bounding_box(pose.footprint.outer).max.y());
    std::vector<double> upper = middles(tops);
    upper.push_back(environment_.track_width_mm + 1);
    for (const double longer : {1.1, 0.6}) {
      for (const double from : middles(heights())) {
        for (const double to : upper) {
          if (to > from) add({{&f.from_mm, from}, {&f.to_mm, to}, {&f.length_mm, longer * part_.longest_mm}});
        }
      }
    }
  }

  void carve(const Cutout& f, const PoseModel& kept, const PoseModel& lost, double shift, bool open) {
    const Polygon beside = placed(lost.footprint, 0, {shift * (lost.x_max - lost.x_min), 0});
    Loop points;
    double most = 0;
    for (const Polygon& piece : difference(loops_of(beside), loops_of(kept.footprint))) {
      const double area = area_moments(piece).area_mm2;
      if (area <= most) continue;
      most = area;
      points = piece.outer;
    }
    if (points.empty()) return;
    if (open) {
      const Box box = bounding_box(points);
      const double beyond = environment_.track_width_mm + 1;
      points.insert(points.end(), {{box.min.x(), beyond}, {box.max.x(), beyond}});
    }
    const Loop corners = hull_of_corners(points, f.polygon_mm.size());
    const double from = bounding_box(corners).min.x();
    std::vector<Wish> wishes;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      wishes.push_back({&f.polygon_mm[i][0], corners[i].x() - from});
      wishes.push_back({&f.polygon_mm[i][1], corners[i].y()});
    }
    add(wishes);
  }

  const std::vector<Variable>& variables_;
  const PartModel& part_;
  const Environment& environment_;
  const std::vector<int>& wanted_;
  std::vector<std::vector<double>> found_;
};

}  // namespace

std::vector<std::vector<double>> carved_values(const FeatureSpec& feature, const std::vector<Variable>& variables,
                                               const PartModel& part, const Environment& environment,
                                               const std::vector<int>& wanted) {
  if (variables.empty()) return {};
  Carver carver(variables, part, environment, wanted);
  std::visit(carver, feature.shape);
  return carver.take();
}

}  // namespace formotion::feeder
