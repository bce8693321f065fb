#include "applications/feeder/part_spread.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "analysis/geometry/boolean.hpp"
#include "analysis/geometry/offset.hpp"
#include "analysis/resting/pose_ranges.hpp"

namespace formotion::feeder {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kSharpest = 0.3;  // of 1 + the cosine between edges' normals: corners of 45 degrees

// The interval of a value that may be uncertain, with the nominal value in it.
std::pair<double, double> interval_of(const Uncertainty& uncertainty, const std::string& name, double nominal) {
  const auto found = uncertainty.intervals.find(name);
  if (found == uncertainty.intervals.end()) return {nominal, nominal};
  return {std::min(found->second.first, nominal), std::max(found->second.second, nominal)};
}

// Every edge moved out by its own distance, by its outward normal; corners stay corners.
template <class Distance>
Loop with_edges_moved(const Loop& loop, const Distance& distance) {
  Loop moved;
  const std::size_t n = loop.size();
  const auto normal = [&](std::size_t k) {
    const Point t = (loop[(k + 1) % n] - loop[k % n]).normalized();
    return Point(t.y(), -t.x());
  };
  for (std::size_t k = 0; k < n; ++k) {
    const Point a = normal(k + n - 1), b = normal(k);
    // The point p with a.p = da and b.p = db; where the edges are nearly parallel, on the way between the normals.
    const double da = distance(a), db = distance(b), sine = cross(a, b);
    const Point off = std::abs(sine) > 1e-3
                          ? Point(da * b.y() - db * a.y(), db * a.x() - da * b.x()) / sine
                          : Point(std::max(std::abs(da), std::abs(db)) * (da < 0 ? -1 : 1) * (a + b).normalized());
    moved.push_back(loop[k] + off);
  }
  return moved;
}

template <class Distance>
Polygon with_edges_moved(const Polygon& polygon, const Distance& distance) {
  Polygon moved{with_edges_moved(polygon.outer, distance), {}};
  for (const Loop& hole : polygon.holes) moved.holes.push_back(with_edges_moved(hole, distance));
  return moved;
}

bool has_sharp_corner(const Loop& loop) {
  for (std::size_t k = 0, n = loop.size(); k < n; ++k) {
    const Point in = (loop[k] - loop[(k + n - 1) % n]).normalized(), out = (loop[(k + 1) % n] - loop[k]).normalized();
    if (1 + in.dot(out) < kSharpest) return true;
  }
  return false;
}

// Whether every edge still runs the way it did.
bool edges_remain(const Loop& before, const Loop& after) {
  for (std::size_t k = 0, n = before.size(); k < n; ++k) {
    if ((before[(k + 1) % n] - before[k]).dot(after[(k + 1) % n] - after[k]) <= 0) return false;
  }
  return true;
}

bool is_same_shape(const Polygon& before, const Polygon& after) {
  if (!edges_remain(before.outer, after.outer)) return false;
  for (std::size_t i = 0; i < before.holes.size(); ++i) {
    if (!edges_remain(before.holes[i], after.holes[i])) return false;
  }
  return !defect(after);
}

// Everything that the loops' boundary comes to when they move up and down by this much.
std::vector<Loop> swept(const std::vector<Loop>& loops, double up_mm) {
  std::vector<Loop> quads;
  const Point up(0, up_mm);
  for (const Loop& loop : loops) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      Point a = loop[k], b = loop[(k + 1) % loop.size()];
      if (a.x() > b.x()) std::swap(a, b);
      if (a.x() < b.x()) quads.push_back({a - up, b - up, b + up, a + up});
    }
  }
  return quads;
}

// The material of all (grown: of some) of the members: the outline is off by up to outline_mm, and since the part
// stands on its outline it may stand higher or lower by as much.
// Edges move by the reach of both towards their normals. That errs to the adverse side at corners and keeps their
// number; where edges vanish by it, or corners are sharp, Booleans do it.
std::vector<Loop> material(const Polygon& footprint, double outline_mm, bool grown) {
  const bool sharp = has_sharp_corner(footprint.outer) ||
                     std::any_of(footprint.holes.begin(), footprint.holes.end(), has_sharp_corner);
  if (!sharp) {
    const Polygon all = with_edges_moved(
        footprint, [&](const Point& n) { return (grown ? 1 : -1) * outline_mm * (1 + std::abs(n.y())); });
    if (is_same_shape(footprint, all)) return loops_of(all);
  }
  const std::vector<Loop> moved = offset(loops_of(footprint), grown ? outline_mm : -outline_mm);
  if (moved.empty()) return moved;
  const std::vector<Loop> edges = swept(moved, outline_mm);
  if (!grown) return loops_of(difference(moved, edges));
  std::vector<Loop> all = moved;
  all.insert(all.end(), edges.begin(), edges.end());
  return loops_of(united(all));
}

// The pose with other material and another supported point.
PoseModel with_material(const PoseModel& pose, const std::vector<Loop>& loops, double shift_mm, double track_width_mm) {
  PoseModel result = pose;
  if (loops.empty()) return result;
  const auto area = [](const Loop& a, const Loop& b) { return signed_area(a) < signed_area(b); };
  result.footprint = {*std::max_element(loops.begin(), loops.end(), area), {}};
  // All pieces of it count; the strip is cut out here, since they need not lie in the first one's extent.
  Box box;
  for (const Loop& loop : loops) {
    for (const Point& p : loop) box.include(p);
  }
  const std::vector<Loop> on_strip =
      loops_of(intersection(loops, {rectangle(box.min.x() - 1, box.min.y() - 1, box.max.x() + 1, track_width_mm)}));
  if (on_strip.empty()) {
    result.travelling = TravellingPart::of(result.footprint, pose.stable.com_wall_mm, shift_mm, track_width_mm);
    return result;
  }
  Polygon all{on_strip.front(), {on_strip.begin() + 1, on_strip.end()}};
  result.travelling = TravellingPart::of(all, pose.stable.com_wall_mm, shift_mm, track_width_mm);
  return result;
}

class Spreader {
 public:
  Spreader(const PartModel& part, const Environment& environment, const Uncertainty& uncertainty)
      : part_(part), environment_(environment), uncertainty_(uncertainty) {}

  PartSpread run() {
    PartSpread& result = result_;
    result.uncertainty = uncertainty_;
    result.speed_mm_s = interval_of(uncertainty_, "conveying_speed_mm_s", environment_.conveying_speed_mm_s);
    result.least = result.most = part_;
    result.least.poses.clear();
    result.most.poses.clear();
    for (std::size_t i = 0; i < part_.poses.size(); ++i) {
      const double prior = part_.poses[i].stable.prior;
      add(part_.poses[i], {static_cast<int>(i), 0, true, prior, prior});
    }
    const auto friction = interval_of(uncertainty_, "settling_friction", environment_.settling_friction);
    if (uncertainty_.com_mm > 0 || uncertainty_.outline_mm > 0 || friction.first < friction.second) ranges(friction);
    result.least.longest_mm = result.most.longest_mm = part_.longest_mm + 2 * uncertainty_.outline_mm;
    return std::move(result_);
  }

 private:
  void add(const PoseModel& pose, PartSpread::Pose known) {
    const double o = uncertainty_.outline_mm;
    const auto tilt = interval_of(uncertainty_, "tilt_deg", value_of(environment_, "tilt_deg"));
    Environment low = environment_, high = environment_;
    if (tilt.first < tilt.second) {
      set_value(low, "tilt_deg", tilt.first);
      set_value(high, "tilt_deg", tilt.second);
    }
    const double com_height = part_.shapes[pose.stable.aspect].com_height_mm;
    const double least_shift = wall_shift(com_height, low), most_shift = wall_shift(com_height, high);
    const double shift = 0.5 * (least_shift + most_shift);
    known.away_mm = o + uncertainty_.com_mm + 0.5 * std::abs(most_shift - least_shift);
    PoseModel least = pose, most = pose;
    if (o > 0 || least_shift != most_shift) {
      const double width = environment_.track_width_mm;
      const std::vector<Loop> drawn = loops_of(pose.footprint);
      const std::vector<Loop> left = o > 0 ? material(pose.footprint, o, false) : drawn;
      known.remains = !left.empty();
      least = with_material(pose, left, shift, width);
      most = with_material(pose, o > 0 ? material(pose.footprint, o, true) : drawn, shift, width);
    }
    least.x_min -= o;
    least.x_max += o;
    most.x_min += o;
    most.x_max -= o;
    result_.poses.push_back(known);
    result_.least.poses.push_back(std::move(least));
    result_.most.poses.push_back(std::move(most));
  }

  // The priors' bounds; and the poses that the part as drawn does not rest in.
  void ranges(const std::pair<double, double>& friction) {
    for (PartSpread::Pose& pose : result_.poses) pose.least_prior = pose.most_prior = 0;
    const std::size_t nominal = part_.poses.size();
    for (int aspect = 0; aspect < static_cast<int>(part_.shapes.size()); ++aspect) {
      const AspectShape& shape = part_.shapes[aspect];
      Loop corners;
      for (const Polygon& body : shape.bodies) corners.insert(corners.end(), body.outer.begin(), body.outer.end());
      const PoseErrors errors{friction.first, friction.second, uncertainty_.com_mm, uncertainty_.outline_mm};
      const double period = kTurn / part_.symmetry[aspect];
      for (const PoseRange& range : pose_ranges(corners, errors, wall_poses(corners, environment_.settling_friction))) {
        const std::size_t i = pose_at(aspect, range.orientation_rad, period);
        if (i == result_.poses.size()) {
          const StablePose stable{aspect, std::fmod(range.orientation_rad, period), range.com_wall_mm, 0, 0, 0};
          add(pose_model(shape, stable, environment_), {});
        }
        result_.poses[i].least_prior += shape.probability * range.least_basin_rad / kTurn;
        result_.poses[i].most_prior += shape.probability * range.most_basin_rad / kTurn;
      }
    }
    for (std::size_t i = 0; i < result_.poses.size(); ++i) {
      PartSpread::Pose& pose = result_.poses[i];
      const StablePose& stable = result_.least.poses[i].stable;
      pose.most_prior = std::min(pose.most_prior, part_.shapes[stable.aspect].probability);
      if (i >= nominal) continue;
      pose.least_prior = std::min(pose.least_prior, stable.prior);  // rounding
      pose.most_prior = std::max(pose.most_prior, stable.prior);
    }
  }
  std::size_t pose_at(int aspect, double orientation, double period) const {
    for (std::size_t i = 0; i < result_.poses.size(); ++i) {
      const StablePose& stable = result_.least.poses[i].stable;
      if (stable.aspect == aspect && std::abs(std::remainder(orientation - stable.orientation_rad, period)) < 1e-6)
        return i;
    }
    return result_.poses.size();
  }

  const PartModel& part_;
  const Environment& environment_;
  const Uncertainty& uncertainty_;
  PartSpread result_;
};

}  // namespace

PartSpread part_spread(const PartModel& part, const Environment& environment, const Uncertainty& uncertainty) {
  return Spreader(part, environment, uncertainty).run();
}

Spreads spreads_of(const PartModel& part, const Environment& environment, const Uncertainty& uncertainty) {
  Spreads spreads{part_spread(part, environment, uncertainty), {}};
  for (const std::string& name : uncertain_values(uncertainty))
    spreads.alone.emplace_back(name, part_spread(part, environment, only(uncertainty, name)));
  return spreads;
}

std::vector<std::string> uncertain_values(const Uncertainty& uncertainty) {
  std::vector<std::string> names;
  if (uncertainty.outline_mm > 0) names.push_back("outline_mm");
  if (uncertainty.com_mm > 0) names.push_back("com_mm");
  if (uncertainty.feature_mm > 0) names.push_back("feature_mm");
  for (const auto& [name, interval] : uncertainty.intervals) names.push_back(name);
  return names;
}

Uncertainty only(const Uncertainty& uncertainty, const std::string& name) {
  Uncertainty alone;
  if (name == "outline_mm") alone.outline_mm = uncertainty.outline_mm;
  if (name == "com_mm") alone.com_mm = uncertainty.com_mm;
  if (name == "feature_mm") alone.feature_mm = uncertainty.feature_mm;
  if (const auto found = uncertainty.intervals.find(name); found != uncertainty.intervals.end())
    alone.intervals.insert(*found);
  return alone;
}

PartModel chosen_poses(const PartModel& part, const std::vector<int>& poses) {
  PartModel chosen;
  chosen.shapes = part.shapes;
  chosen.symmetry = part.symmetry;
  chosen.diameter_mm = part.diameter_mm;
  chosen.longest_mm = part.longest_mm;
  for (const int i : poses) chosen.poses.push_back(part.poses[static_cast<std::size_t>(i)]);
  return chosen;
}

PartModel member_of(const PartModel& part, const Environment& environment, double outline_mm, const Point& com_mm) {
  PartModel member = part;
  for (AspectShape& shape : member.shapes) {
    const auto move = [&](Polygon& polygon) {
      polygon = placed(with_edges_moved(polygon, [&](const Point&) { return outline_mm; }), 0, -com_mm);
    };
    move(shape.footprint);
    for (Polygon& body : shape.bodies) move(body);
  }
  for (PoseModel& pose : member.poses) {
    const AspectShape& shape = member.shapes[pose.stable.aspect];
    double lowest = 0;
    for (const Polygon& body : shape.bodies)
      lowest = std::min(lowest, bounding_box(placed(body, pose.stable.orientation_rad, Point::Zero()).outer).min.y());
    StablePose stable = pose.stable;
    stable.com_wall_mm = -lowest;
    pose = pose_model(shape, stable, environment);
  }
  member.diameter_mm += 2 * outline_mm;
  for (const PoseModel& pose : member.poses) member.longest_mm = std::max(member.longest_mm, pose.x_max - pose.x_min);
  return member;
}

void set_value(Environment& environment, const std::string& name, double value) {
  const double radians = value * std::numbers::pi / 180;
  if (name == "wall_friction") {
    environment.wall_friction = value;
  } else if (name == "drive_deg") {
    environment.drive_rad = radians;
  } else if (name == "tilt_deg") {
    environment.tilt_rad = radians;
  } else if (name == "settling_friction") {
    environment.settling_friction = value;
  } else if (name == "conveying_speed_mm_s") {
    environment.conveying_speed_mm_s = value;
  } else {
    throw std::logic_error("no uncertain value " + name);
  }
}

double value_of(const Environment& environment, const std::string& name) {
  if (name == "wall_friction") return environment.wall_friction;
  if (name == "drive_deg") return environment.drive_rad * 180 / std::numbers::pi;
  if (name == "tilt_deg") return environment.tilt_rad * 180 / std::numbers::pi;
  if (name == "settling_friction") return environment.settling_friction;
  if (name == "conveying_speed_mm_s") return environment.conveying_speed_mm_s;
  throw std::logic_error("no uncertain value " + name);
}

}  // namespace formotion::feeder
