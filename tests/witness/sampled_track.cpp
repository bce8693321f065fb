#include "witness/sampled_track.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "analysis/constraints/hull_margin.hpp"
#include "analysis/constraints/planar_support.hpp"
#include "analysis/constraints/support_travel.hpp"
#include "analysis/geometry/boolean.hpp"
#include "analysis/geometry/offset.hpp"
#include "witness/exact_support.hpp"

namespace formotion::witness {
namespace {

using namespace feeder;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFar_mm = 5000;     // voids that go on beyond the strip reach this far
constexpr double kSame_mm = 1e-5;    // margins that differ by less agree
constexpr double kUnsure_mm = 1e-4;  // decisions by less than this are not compared
constexpr double kTouch_mm = 1e-9;   // metal is closed: what lies on an edge is supported
constexpr int kPlaces = 4;           // lowest places of a travel that are zoomed in on
constexpr int kDiscCorners = 96;     // a disc is true to 0.05 % of its radius
constexpr int kFineDiscCorners = 384;
constexpr double kFinest_mm = 1e-7;                      // where zooming ends
constexpr double kBeside_mm = 1.5 * kEventTolerance_mm;  // what lives shorter decides nothing (support_travel.hpp)
constexpr double kClosely = 0.01;                        // of the step, where a first look surprises

// The features as the contract places and cuts them.
struct Plan {
  double width = 0;
  std::vector<Loop> voids;  // all of the track's, counter-clockwise
  struct Blade {
    double start, end, height;
    bool holds;
  };
  std::vector<Blade> blades;
  bool round = false;  // arcs that stand for circles: shapes agree to the chord tolerance only
};

struct Built {
  std::vector<Loop> voids;
  double length = 0;
};

Built build(const FeatureSpec& feature, double width, Plan& plan) {
  const auto v = [](const Affine& a) { return a({}); };
  const auto box = [](double x0, double y0, double x1, double y1) {
    return x1 > x0 && y1 > y0 ? std::vector<Loop>{rectangle(x0, y0, x1, y1)} : std::vector<Loop>{};
  };
  if (const auto* f = std::get_if<Balcony>(&feature.shape)) {
    return {box(0, v(f->width_mm), v(f->length_mm), kFar_mm), v(f->length_mm)};
  }
  if (const auto* f = std::get_if<Gap>(&feature.shape)) {
    return {box(0, -kFar_mm, v(f->length_mm), kFar_mm), v(f->length_mm)};
  }
  if (const auto* f = std::get_if<Canyon>(&feature.shape)) {
    return {box(0, v(f->from_mm), v(f->length_mm), v(f->to_mm)), v(f->length_mm)};
  }
  if (const auto* f = std::get_if<Slot>(&feature.shape)) {
    return {box(0, v(f->from_mm), v(f->length_mm), v(f->to_mm)), v(f->length_mm)};
  }
  if (const auto* f = std::get_if<Cutout>(&feature.shape)) {
    Loop loop;
    for (const AffinePoint& p : f->polygon_mm) loop.emplace_back(v(p[0]), v(p[1]));
    if (signed_area(loop) < 0) std::reverse(loop.begin(), loop.end());
    return {{loop}, bounding_box(loop).max.x()};
  }
  if (const auto* f = std::get_if<DishOut>(&feature.shape)) {
    plan.round = true;
    const double d = v(f->depth_mm), l = v(f->length_mm);
    if (d <= 0 || l <= 0) return {{}, l};
    const double r = (l * l / 4 + d * d) / (2 * d);
    Loop circle;
    const int n = std::clamp(static_cast<int>(2 * std::numbers::pi * std::sqrt(r / 0.008)), 64, 1500);
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * std::numbers::pi * i / n;
      circle.emplace_back(l / 2 + r * std::cos(angle), width - d + r + r * std::sin(angle));
    }
    return {{circle}, l};
  }
  if (const auto* f = std::get_if<Scallop>(&feature.shape)) {
    const double d = v(f->depth_mm), slope = std::tan(v(f->half_angle_rad));
    if (d <= 0) return {{}, 0};
    const double x = d * slope, far = d + 300;
    return {{{{x, width - d}, {x + far * slope, width - d + far}, {x - far * slope, width - d + far}}}, 2 * x};
  }
  if (const auto* f = std::get_if<Drawing>(&feature.shape)) {
    Built built{f->voids_mm, 0};
    for (Loop& loop : built.voids) {
      if (signed_area(loop) < 0) std::reverse(loop.begin(), loop.end());
      built.length = std::max(built.length, bounding_box(loop).max.x());
    }
    return built;
  }
  if (const auto* f = std::get_if<HoldDown>(&feature.shape)) return {{}, v(f->length_mm)};
  return {};
}

Plan plan_of(const FeederProblem& problem, int topology, std::span<const double> values, double diameter) {
  const FeederSpec& spec = problem.spec();
  Plan plan;
  plan.width = spec.environment.track_width_mm;
  double end = 0;
  bool any_floating = false, first = true;
  for (const FeatureSpec& feature : problem.literal_design(topology, values)) {
    Built built = build(feature, plan.width, plan);
    double start = 0;
    if (feature.at_mm) {
      start = (*feature.at_mm)({});
    } else if (any_floating && !first) {
      start = end + spec.environment.spacing_mm.value_or(diameter);
    }
    any_floating = any_floating || !feature.at_mm;
    first = false;
    end = start + built.length;
    if (const double radius = spec.manufacture.cutter_radius_mm.value_or(0); radius > 0) {
      plan.round = true;
      std::vector<Loop> milled;
      for (const Loop& loop : built.voids) {
        for (Loop& reached :
             moved_edges(moved_edges({loop}, -radius, false, kDiscCorners), radius, false, kDiscCorners))
          milled.push_back(reached);
      }
      built.voids = milled;
    }
    for (Loop& loop : built.voids) {
      for (Point& p : loop) p.x() += start;
      plan.voids.push_back(std::move(loop));
    }
    if (const auto* f = std::get_if<Wiper>(&feature.shape))
      plan.blades.push_back({start, end, f->height_mm({}), false});
    if (const auto* f = std::get_if<HoldDown>(&feature.shape)) {
      plan.blades.push_back({start, end, f->height_mm({}), true});
    }
  }
  return plan;
}

struct Stretch {
  double from, to;
};

struct Pose {
  Polygon footprint;  // on the wall, centre of mass at x = 0
  double com_wall = 0, shift = 0, height = 0;
  double x_min = 0, x_max = 0;  // of all layers
  std::vector<Stretch> held;    // positions of the centre of mass
  double blade = kInfinity;     // least clearance under a blade
};

struct Travelled {
  double least = kInfinity;  // over positions with support
  double first_lost = kInfinity;
};

// The support margin, spelled out: the signed distance of the supported point to the hull of all points that can be its
// corners. Voids are disjoint, so a place where one's edge crosses the part's is on metal.
std::optional<double> margin(const Pose& pose, const Track& track, double x) {
  const Point supported(x, pose.com_wall - pose.shift);
  Polygon part = pose.footprint;
  for (Point& p : part.outer) p.x() += x;
  for (Loop& hole : part.holes) {
    for (Point& p : hole) p.x() += x;
  }
  const Box box = bounding_box(part.outer);
  Loop points;
  const auto in_strip = [&](const Point& p) { return p.y() >= -kTouch_mm && p.y() <= track.width_mm + kTouch_mm; };
  const auto over_void = [&](const Point& p) {
    return std::any_of(track.voids.begin(), track.voids.end(),
                       [&](const Polygon& hole) { return locate(hole, p, kTouch_mm) == Side::Inside; });
  };
  const auto each_edge = [](const Polygon& polygon, const auto& visit) {
    for (std::size_t i = 0; i < polygon.outer.size(); ++i) {
      visit(polygon.outer[i], polygon.outer[(i + 1) % polygon.outer.size()]);
    }
    for (const Loop& hole : polygon.holes) {
      for (std::size_t i = 0; i < hole.size(); ++i) visit(hole[i], hole[(i + 1) % hole.size()]);
    }
  };
  each_edge(part, [&](const Point& a, const Point& b) {
    if (in_strip(a) && !over_void(a)) points.push_back(a);
    for (const double y : {0.0, track.width_mm}) {
      if ((a.y() - y) * (b.y() - y) >= 0) continue;
      const Point p(a.x() + (b.x() - a.x()) * (y - a.y()) / (b.y() - a.y()), y);
      if (!over_void(p)) points.push_back(p);
    }
  });
  for (const Polygon& hole : track.voids) {
    each_edge(hole, [&](const Point& c, const Point& d) {
      if (std::max(c.x(), d.x()) < box.min.x() || std::min(c.x(), d.x()) > box.max.x() ||
          std::max(c.y(), d.y()) < box.min.y() || std::min(c.y(), d.y()) > box.max.y()) {
        return;
      }
      if (in_strip(c) && locate(part, c, kTouch_mm) != Side::Outside) points.push_back(c);
      for (const double y : {0.0, track.width_mm}) {
        if ((c.y() - y) * (d.y() - y) >= 0) continue;
        const Point p(c.x() + (d.x() - c.x()) * (y - c.y()) / (d.y() - c.y()), y);
        if (locate(part, p, kTouch_mm) != Side::Outside) points.push_back(p);
      }
      each_edge(part, [&](const Point& a, const Point& b) {
        const double det = cross(b - a, d - c), t = cross(c - a, d - c), s = cross(c - a, b - a);
        if (det == 0 || t / det < 0 || t / det > 1 || s / det < 0 || s / det > 1) return;
        const Point p = a + t / det * (b - a);
        if (in_strip(p)) points.push_back(p);
      });
    });
  }
  if (points.empty()) return std::nullopt;
  const Loop hull = convex_hull(points);
  double distance = kInfinity;
  bool inside = hull.size() > 2;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Point &a = hull[i], &b = hull[(i + 1) % hull.size()];
    distance = std::min(distance, distance_to_segment(supported, a, b));
    inside = inside && cross(b - a, supported - a) >= 0;
  }
  return inside ? distance : -distance;
}

// Samples of a travel with zooming: what is below `lost` counts as lost.
Travelled travelled(const Pose& pose, const Track& track, const Stretch& track_range, double step,
                    const std::vector<double>& also) {
  const double from = track_range.from - pose.x_max - 1, to = track_range.to - pose.x_min + 1;
  Travelled result;
  const auto value = [&](double x) {  // infinite where held or nothing supports
    for (const Stretch& held : pose.held) {
      if (held.from < x && x < held.to) return kInfinity;
    }
    const auto found = margin(pose, track, x);
    double m = found.value_or(kInfinity);
    if (m < result.least - 1e-6) {  // what no neighbour shows is the rounding of a touch
      const auto before = margin(pose, track, x - kBeside_mm), behind = margin(pose, track, x + kBeside_mm);
      if (std::min(before.value_or(kInfinity), behind.value_or(kInfinity)) > m + kSame_mm) m = kInfinity;
    }
    if (!found || m < -kUnsure_mm) result.first_lost = std::min(result.first_lost, x);
    result.least = std::min(result.least, m);
    return m;
  };
  std::vector<std::pair<double, double>> samples;  // (x, margin)
  const int count = std::max(8, static_cast<int>((to - from) / step));
  for (int k = 0; k <= count; ++k) {
    const double x = from + (to - from) * (k + 0.381966) / (count + 1);
    samples.emplace_back(x, value(x));
  }
  // Jumps: the margin is lowest on one of their sides.
  for (std::size_t k = 0; k + 1 < samples.size(); ++k) {
    auto [a, at_a] = samples[k];
    auto [b, at_b] = samples[k + 1];
    if (!(std::abs(at_a - at_b) >= 2 * (b - a))) continue;
    while (b - a > kFinest_mm) {
      const double middle = 0.5 * (a + b), at_middle = value(middle);
      const bool left = std::abs(at_a - at_middle) > std::abs(at_middle - at_b);
      (left ? b : a) = middle;
      (left ? at_b : at_a) = at_middle;
    }
  }
  std::vector<std::pair<double, double>> low;  // local minima: (margin, x)
  for (std::size_t k = 1; k + 1 < samples.size(); ++k) {
    const double m = samples[k].second;
    if (m < kInfinity && m <= samples[k - 1].second && m <= samples[k + 1].second)
      low.emplace_back(m, samples[k].first);
  }
  std::sort(low.begin(), low.end());
  if (low.size() > kPlaces) low.resize(kPlaces);
  for (const double x : also) low.emplace_back(value(x), x);
  for (const Stretch& held : pose.held) {
    for (const double x : {held.from - 1e-7, held.to + 1e-7}) low.emplace_back(value(x), x);
  }
  for (auto [m, x] : low) {
    for (double h = step; h > kFinest_mm; h *= 0.25) {
      double best_x = x;
      for (int k = -4; k <= 4; ++k) {
        const double tried = value(x + h * k / 4);
        if (tried < m) {
          m = tried;
          best_x = x + h * k / 4;
        }
      }
      x = best_x;
    }
  }
  return result;
}

Track track_with(double width, const std::vector<Loop>& loops, bool exactly) {
  return {width, exactly ? united_exactly(loops) : united(loops)};
}

// Where the track has voids within the strip.
Stretch range_of(const Track& track) {
  Stretch range{0, 0};
  for (const Polygon& piece : intersection(loops_of(track.voids), {rectangle(-1e5, -1, 1e5, track.width_mm + 1)})) {
    const Box box = bounding_box(piece.outer);
    range = {std::min(range.from, box.min.x()), std::max(range.to, box.max.x())};
  }
  return range;
}

struct Text {
  std::ostringstream out;
  template <class T>
  Text& operator<<(const T& value) {
    out << value;
    return *this;
  }
  operator std::string() const { return out.str(); }
};

// The lost pose's fall by the void rule, from scratch: 1 rejected, 0 jammed, -1 unsure.
int falls(const Pose& pose, const Track& track, double x) {
  Loop points = support_generators(placed(pose.footprint, 0, {x, 0}), track);
  const Point supported(x, pose.com_wall - pose.shift);
  if (points.empty()) return -1;
  for (Point& p : points) p -= supported;
  const HullMargin nearest = hull_margin(points);
  if (nearest.other_from >= 0) return -1;
  const Point from = points[nearest.from], to = points[nearest.to];
  if ((to - from).norm() < 1e-6) return -1;
  const Point direction = (to - from).normalized(), normal(direction.y(), -direction.x());
  const Loop body = placed(pose.footprint, 0, {x, 0}).outer;
  double low = kInfinity, high = -kInfinity;
  const auto beyond = [&](const Point& p) { return normal.dot(p - supported - from); };
  for (const Point& p : body) {
    low = std::min(low, direction.dot(p));
    high = std::max(high, direction.dot(p));
    if (p.y() > track.width_mm && beyond(p) > 0) {
      if (std::min(p.y() - track.width_mm, beyond(p)) < kUnsure_mm) return -1;
      return 1;  // over the free edge itself
    }
  }
  std::vector<Loop> loops = loops_of(track.voids);
  const double reach = 1e4;
  const Loop unsupported_half{
      from + supported - reach * direction, from + supported - reach * direction + reach * normal,
      from + supported + reach * direction + reach * normal, from + supported + reach * direction};
  const auto material = intersection(loops_of(placed(pose.footprint, 0, {x, 0})), {unsupported_half});
  bool unsure = false;
  for (const Polygon& piece : intersection(loops, {rectangle(-1e5, 0, 1e5, track.width_mm)})) {
    double over = 0;
    for (const Polygon& common : intersection(loops_of(material), loops_of(piece)))
      over += area_moments(common).area_mm2;
    if (over == 0) continue;
    double opening = 0;
    for (std::size_t i = 0; i < piece.outer.size(); ++i) {
      const Point &a = piece.outer[i], &b = piece.outer[(i + 1) % piece.outer.size()];
      if (a.y() > track.width_mm - 1e-7 && b.y() > track.width_mm - 1e-7) opening = std::max(opening, (a - b).norm());
    }
    const int fits = fits_by_trying(piece, direction, high - low, pose.height);
    const bool open = opening >= pose.height;
    if (std::abs(opening - pose.height) < 0.01 || (over < 1e-3 && (open || fits)))
      unsure = true;
    else if (open || fits > 0)
      return 1;
    else if (fits < 0)
      unsure = true;
  }
  return unsure ? -1 : 0;
}

}  // namespace

int fits_by_trying(const Polygon& polygon, const Point& direction, double length, double width) {
  // In a frame whose x axis is the direction.
  Eigen::Matrix2d turn;
  turn << direction.x(), direction.y(), -direction.y(), direction.x();
  Polygon turned = polygon;
  for (Point& p : turned.outer) p = turn * p;
  for (Loop& hole : turned.holes) {
    for (Point& p : hole) p = turn * p;
  }
  const Box box = bounding_box(turned.outer);
  const auto inside = [&](const Point& centre, double l, double w) {
    const Box room{centre - Point(l / 2, w / 2), centre + Point(l / 2, w / 2)};
    if ((room.min.array() < box.min.array()).any() || (room.max.array() > box.max.array()).any()) return false;
    if (locate(turned, centre, 0) != Side::Inside) return false;
    for (const Loop& loop : loops_of(turned)) {
      for (std::size_t i = 0; i < loop.size(); ++i) {  // no edge may enter the rectangle (Liang and Barsky 1984)
        const Point &a = loop[i], d = loop[(i + 1) % loop.size()] - a;
        double t0 = 0, t1 = 1;
        for (int axis = 0; axis < 2 && t0 < t1; ++axis) {
          const double lo = room.min[axis] - a[axis], hi = room.max[axis] - a[axis];
          if (d[axis] == 0) {
            if (lo >= 0 || hi <= 0) t1 = -1;
            continue;
          }
          t0 = std::max(t0, std::min(lo / d[axis], hi / d[axis]));
          t1 = std::min(t1, std::max(lo / d[axis], hi / d[axis]));
        }
        if (t0 < t1) return false;
      }
    }
    return true;
  };
  const int n = 50;
  const Point pitch = (box.max - box.min) / n;
  bool smaller = false;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      const Point centre = box.min + Point(pitch.x() * i, pitch.y() * j);
      if (inside(centre, length + 1e-5, width + 1e-5)) return 1;
      smaller = smaller ||
                inside(centre, std::max(1e-6, length - pitch.x() - 1e-5), std::max(1e-6, width - pitch.y() - 1e-5));
    }
  }
  return smaller ? -1 : 0;
}

std::vector<Loop> moved_edges(const std::vector<Loop>& voids, double e, bool outer, int disc_corners) {
  if (e == 0) return voids;
  const double reach = std::abs(e), radius = outer ? reach / std::cos(std::numbers::pi / disc_corners) : reach;
  std::vector<Loop> bands;
  for (const Loop& loop : voids) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Point &a = loop[i], &b = loop[(i + 1) % loop.size()];
      Loop disc;
      for (int k = 0; k < disc_corners; ++k) {
        const double angle = 2 * std::numbers::pi * k / disc_corners;
        disc.push_back(a + radius * Point(std::cos(angle), std::sin(angle)));
      }
      bands.push_back(std::move(disc));
      if (a == b) continue;
      const Point along = (b - a).normalized(), side = reach * Point(along.y(), -along.x());
      bands.push_back({a + side, b + side, b - side, a - side});
    }
  }
  if (e < 0) return loops_of(difference(voids, bands));
  bands.insert(bands.end(), voids.begin(), voids.end());
  return loops_of(united(bands));
}

Confirmation compare(const FeederProblem& problem, int topology, std::span<const double> values,
                     const ConfirmOptions& options) {
  const FeederSpec& spec = problem.spec();
  const FeederEvaluation said = problem.evaluate(topology, values);
  const std::vector<AspectShape> shapes = problem.shapes(values);
  const std::vector<StablePose> stable = problem.stable_poses(values);
  Confirmation result;
  const auto disagree = [&](const std::string& text) { result.disagreements.push_back(text); };
  if (stable.size() != said.poses.size()) disagree("as many poses as stable ones");
  if (said.metrics.feature_count == 0 || !result.disagreements.empty()) return result;

  double diameter = 0;
  for (const AspectShape& shape : shapes) {
    Loop all;
    for (const Polygon& body : shape.bodies) all.insert(all.end(), body.outer.begin(), body.outer.end());
    for (const Point& p : all) {
      for (const Point& q : all) diameter = std::max(diameter, (p - q).norm());
    }
  }
  if (!said.metrics.tolerance_mm) return result;  // impossible shapes: nothing to sample
  const Plan plan = plan_of(problem, topology, values, diameter);
  const std::vector<Loop> nominal_loops = loops_of(united_exactly(plan.voids));
  const Track nominal{plan.width, united_exactly(plan.voids)};
  const Stretch nominal_range = range_of(nominal);
  const double accuracy = plan.round ? 0.02 : kUnsure_mm;

  std::vector<Pose> poses;
  for (const StablePose& s : stable) {
    const AspectShape& shape = shapes[s.aspect];
    Pose pose;
    pose.footprint = placed(shape.footprint, s.orientation_rad, {0, s.com_wall_mm});
    pose.com_wall = s.com_wall_mm;
    pose.shift = shape.com_height_mm * std::tan(spec.environment.tilt_rad);
    pose.height = shape.height_mm;
    Box box;
    for (const Polygon& body : shape.bodies) {
      for (const Point& p : placed(body, s.orientation_rad, {0, s.com_wall_mm}).outer) box.include(p);
    }
    pose.x_min = box.min.x();
    pose.x_max = box.max.x();
    for (const Plan::Blade& blade : plan.blades) {
      pose.blade = std::min(pose.blade, blade.height - pose.height);
      const bool holds = blade.holds && pose.height <= blade.height && blade.height < 2 * pose.height;
      if (holds && blade.start - pose.x_min < blade.end - pose.x_max) {
        pose.held.push_back({blade.start - pose.x_min, blade.end - pose.x_max});
      }
    }
    poses.push_back(std::move(pose));
  }

  double weakest = kInfinity;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Pose& pose = poses[i];
    const PoseResult& answer = said.poses[i];
    const std::string who = Text() << "pose " << i << " (" << name(answer.outcome) << "): ";
    const bool delivered = answer.outcome == Outcome::Delivered;
    std::vector<double> also;
    if (answer.decided_by) {
      for (const double off : {-1e-6, 0.0, 1e-6, 1e-3}) also.push_back(answer.decided_by->x_mm + off);
    }
    Travelled sampled;
    bool lost = false;
    double signed_margin = 0;
    for (const double step : {options.step_mm, kClosely * options.step_mm}) {
      sampled = travelled(pose, nominal, nominal_range, step, also);
      lost = sampled.first_lost < kInfinity || pose.blade < 0;
      const double depth = std::min(diameter, std::max({0.0, -sampled.least, -pose.blade}));
      signed_margin = delivered ? sampled.least : depth;
      if (lost != delivered && std::abs(*answer.margin_mm - signed_margin) < (plan.round ? 0.02 : kSame_mm)) break;
    }
    weakest = std::min(weakest, std::min(std::abs(signed_margin), std::abs(pose.blade)));
    if (std::abs(signed_margin) < accuracy || std::abs(pose.blade) < accuracy) continue;
    ++result.outcomes;
    if (lost == delivered) {
      disagree(Text() << who << "by samples " << (lost ? "lost" : "delivered") << ", least margin " << sampled.least);
      continue;
    }
    ++result.margins;
    if (std::abs(*answer.margin_mm - signed_margin) > (plan.round ? 0.02 : kSame_mm)) {
      disagree(Text() << who << "margin " << *answer.margin_mm << ", by samples " << signed_margin);
    }
    if (delivered || pose.blade < 0) continue;
    if (answer.decided_by && sampled.first_lost < answer.decided_by->x_mm - accuracy - 1e-3) {
      disagree(Text() << who << "lost at " << answer.decided_by->x_mm << ", by samples already at "
                      << sampled.first_lost);
    }
    if (!answer.decided_by || plan.round) continue;
    const int fell = falls(pose, nominal, answer.decided_by->x_mm + 1e-6);
    result.falls += fell >= 0;
    if (fell >= 0 && (fell == 1) != (answer.outcome == Outcome::Rejected)) {
      disagree(Text() << who << "by trying " << (fell ? "rejected" : "jammed"));
    }
  }
  if (!options.tolerance || weakest < accuracy) return result;

  // Holds at a little less than the tolerance with voids that are too adverse, fails at a little more with voids that
  // are not adverse enough.
  const double tolerance = *said.metrics.tolerance_mm;
  const auto holds = [&](double e, bool adverse, int corners, double step, std::string* failing) {
    const Track grown = track_with(plan.width, moved_edges(nominal_loops, e, adverse, corners), false);
    const Track shrunk = track_with(plan.width, moved_edges(nominal_loops, -e, adverse, corners), false);
    const Stretch grown_range = range_of(grown);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const bool delivered = said.poses[i].outcome == Outcome::Delivered;
      std::vector<double> also;
      if (said.poses[i].decided_by) also.push_back(said.poses[i].decided_by->x_mm);
      const Travelled sampled =
          travelled(poses[i], delivered ? grown : shrunk, delivered ? grown_range : nominal_range, step, also);
      const double found = delivered ? std::min(sampled.least, poses[i].blade)
                                     : std::min(diameter, std::max(-sampled.least, -poses[i].blade));
      if (found < e - 1e-7) {
        if (failing) *failing = Text() << "pose " << i << " has " << found;
        return false;
      }
    }
    return true;
  };
  ++result.tolerances;
  const double room = plan.round ? 0.01 : 1e-6;
  std::string failing;
  // Surprises are looked at again with finer discs and steps.
  const double below = 0.999 * tolerance - (plan.round ? room : 0), above = 1.001 * tolerance + room;
  if (below > 0 && !holds(below, true, kDiscCorners, options.step_mm, nullptr) &&
      !holds(below, true, kFineDiscCorners, kClosely * options.step_mm, &failing)) {
    disagree(Text() << "tolerance " << tolerance << ": at " << below << " " << failing);
  }
  if (holds(above, false, kDiscCorners, options.step_mm, nullptr) &&
      holds(above, false, kFineDiscCorners, kClosely * options.step_mm, nullptr)) {
    disagree(Text() << "tolerance " << tolerance << ": all poses still hold at " << above);
  }
  return result;
}

std::vector<std::string> confirm(const FeederProblem& problem, int topology, std::span<const double> values) {
  return compare(problem, topology, values).disagreements;
}

}  // namespace formotion::witness
