#include "applications/feeder/tolerance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>

#include "analysis/geometry/offset.hpp"

namespace formotion::feeder {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kPrecision_mm = 1e-8;
constexpr int kMostRefinements = 24;
constexpr double kFineArc_rad = 0.05;

class Search {
 public:
  Search(const PartModel& part, const Layout& layout, const std::vector<bool>& delivered)
      : part_(part), layout_(layout), delivered_(delivered) {
    for (const PoseModel& pose : part.poses) {
      held_.push_back(held_intervals(pose, layout));
      clearance_.push_back(blade_clearance(pose, layout));
    }
  }

  ToleranceResult run(const std::vector<double>& nominal) {
    // The poses that look weakest first: the others then need one test each.
    std::vector<int> order(part_.poses.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return nominal[a] < nominal[b]; });
    double best = *std::min_element(nominal.begin(), nominal.end());
    for (const int pose : order) {
      if (best <= 0) break;
      LeastMargin least;
      if (slack(pose, best, least) >= 0) continue;
      best = largest(pose, best);
    }
    return {std::max(best, 0.0), sweeps_};
  }

 private:
  struct Outlines {
    double e = -1;
    std::vector<VoidOutline> groups;
  };

  // The voids as they are when every edge is off by e to the adverse side of a pose.
  const std::vector<VoidOutline>& outlines(bool grown, double e) {
    Outlines& kept = grown ? grown_ : shrunk_;
    if (kept.e != e) {
      kept.e = e;
      kept.groups.clear();
      OffsetOptions options;
      options.tangents = tangents_;
      for (const VoidGroup& group : groups_at(e)) {
        const std::vector<Loop> loops = offset(group.loops, grown ? e : -e, options);
        if (!loops.empty()) kept.groups.push_back(VoidOutline::of(loops));
      }
    }
    return kept.groups;
  }

  // Growing brings voids nearer to each other.
  const std::vector<VoidGroup>& groups_at(double e) {
    const double reach = part_.longest_mm + 2.2 * e;
    if (groups_.empty() || reach != groups_reach_) {
      if (groups_.empty() || grouped_count(reach) != groups_.size()) groups_ = grouped(layout_, reach);
      groups_reach_ = reach;
    }
    return groups_;
  }
  std::size_t grouped_count(double reach) const {
    std::vector<std::pair<double, double>> spans;
    for (const LaidFeature& feature : layout_.features) {
      if (!feature.voids.empty()) spans.emplace_back(feature.x_min, feature.x_max);
    }
    std::sort(spans.begin(), spans.end());
    std::size_t count = 0;
    double end = 0;
    for (const auto& [from, to] : spans) {
      if (count == 0 || from - end >= reach) {
        ++count;
        end = to;
      }
      end = std::max(end, to);
    }
    return count;
  }

  // How much better than demanded pose i does at e: negative if it fails. least: where its margin is least.
  double slack(int i, double e, LeastMargin& least) {
    const PoseModel& pose = part_.poses[i];
    least = {};
    bool unsupported = false;
    for (const VoidOutline& voids : outlines(delivered_[i], e)) {
      ++sweeps_;
      const LeastMargin found = least_margin({pose.travelling, voids, held_[i]});
      unsupported = unsupported || found.unsupported;
      if (found.margin_mm < least.margin_mm) least = found;
    }
    least.margin_mm = std::min(least.margin_mm, pose.travelling.plain_margin_mm);
    if (delivered_[i] && unsupported) return -e - kPrecision_mm;
    if (delivered_[i]) return std::min(least.margin_mm, clearance_[i]) - e;
    return std::min(std::max(-least.margin_mm, -clearance_[i]), part_.diameter_mm) - e;
  }

  // The largest e below high that pose i bears; where it fails just above, arcs are made exact, until they were not to
  // blame.
  double largest(int i, double high) {
    double low = 0;
    for (int refinement = 0; refinement < kMostRefinements; ++refinement) {
      Failure failure;
      low = root(i, low, high, failure);
      if (low == high) break;
      if (refine(i, failure)) continue;
      // A delivered pose that fails at one place of the true shape fails. A lost one is kept at every place: elsewhere
      // arcs may be to blame.
      if (delivered_[i] || !finer_is_better(i, failure) || !refine(i, failure)) break;
    }
    return low;
  }

  struct Failure {
    double e = 0;
    LeastMargin least;
  };

  // Regula falsi with bisection where it does not halve the bracket: slack falls with e, but may jump.
  double root(int i, double low, double high, Failure& failure) {
    double at_low = slack(i, low, failure.least), at_high = 0;
    failure.e = low;
    if (at_low < 0) return low;
    probe(i, high, low, high, at_low, at_high, failure);
    bool bisect = false;
    while (high - low > kPrecision_mm) {
      const double width = high - low;
      double e = bisect ? 0.5 * (low + high) : low + width * at_low / (at_low - at_high);
      e = std::clamp(e, low + 0.5 * std::min(kPrecision_mm, width), high - 0.5 * std::min(kPrecision_mm, width));
      probe(i, e, low, high, at_low, at_high, failure);
      // A hit from one side leaves the other end of the bracket far away: look just beyond it.
      if (low == e && high - low > kPrecision_mm) {
        probe(i, e + 0.9 * kPrecision_mm, low, high, at_low, at_high, failure);
      } else if (high == e && high - low > kPrecision_mm) {
        probe(i, e - 0.9 * kPrecision_mm, low, high, at_low, at_high, failure);
      }
      bisect = high - low > 0.5 * width;
    }
    return low;
  }

  void probe(int i, double e, double& low, double& high, double& at_low, double& at_high, Failure& failure) {
    LeastMargin least;
    const double value = slack(i, e, least);
    if (value >= 0) {
      low = e;
      at_low = value;
    } else {
      high = e;
      at_high = value;
      failure = {e, least};
    }
  }

  // Whether lost pose i, which seems to be kept, is lost with finer arcs; failure becomes the place where it is.
  bool finer_is_better(int i, Failure& failure) {
    OffsetOptions options;
    options.arc_step_rad = kFineArc_rad;
    options.tangents = tangents_;
    for (const VoidGroup& group : groups_at(failure.e)) {
      const std::vector<Loop> loops = offset(group.loops, -failure.e, options);
      if (loops.empty()) continue;
      ++sweeps_;
      const VoidOutline outline = VoidOutline::of(loops);
      const LeastMargin found = least_margin({part_.poses[i].travelling, outline, held_[i]});
      if (found.margin_mm >= -failure.e) continue;
      failure.least = found;
      return true;
    }
    return false;
  }

  // Makes arcs exact wherever the part's edges and corners meet them in the failure's configuration, and where arcs
  // meet other boundaries under it. False if they were exact already: then the failure is one of the true shape.
  bool refine(int i, const Failure& failure) {
    const double e = failure.e;
    if (e <= 0) return false;
    const PoseModel& pose = part_.poses[i];
    const Point at(failure.least.x_mm, pose.travelling.supported_y_mm);
    const Point room = Point::Constant(0.1 * e);
    const Point lo = pose.travelling.edges.box.min + at - room, hi = pose.travelling.edges.box.max + at + room;
    const std::vector<VoidOutline>& outlines_now = outlines(delivered_[i], e);
    std::vector<Loop> loops;
    std::vector<Point> corners;
    for (const VoidGroup& group : groups_) {
      for (const Loop& loop : group.loops) {
        loops.push_back(loop);
        for (const Point& p : loop) {
          if ((p.array() > lo.array() - e).all() && (p.array() < hi.array() + e).all()) corners.push_back(p);
        }
      }
    }
    const auto to_voids = [&](const Point& p) {
      double nearest = kInfinity;
      for (const Loop& loop : loops) {
        for (std::size_t k = 0; k < loop.size(); ++k) {
          nearest = std::min(nearest, distance_to_segment(p, loop[k], loop[(k + 1) % loop.size()]));
        }
      }
      return nearest;
    };
    const auto to_outline = [&](const Point& p) {
      double nearest = kInfinity;
      for (const VoidOutline& outline : outlines_now) {
        for (const EdgeSet::Edge& edge : outline.edges.edges) {
          nearest = std::min(nearest, distance_to_segment(p, edge.a, edge.b));
        }
      }
      return nearest;
    };
    bool added = false;
    const auto make_exact = [&](const Point& corner, const Point& p) {
      for (const ArcTangent& known : tangents_) {
        const double apart =
            std::remainder(known.angle_rad - std::atan2(p.y() - corner.y(), p.x() - corner.x()), 2 * std::numbers::pi);
        if (known.corner == corner && e * apart * apart < kPrecision_mm) return;
      }
      tangents_.push_back({corner, std::atan2(p.y() - corner.y(), p.x() - corner.x())});
      added = true;
    };
    // A place of the exact boundary, on the arc about corner, that the polygon misses.
    const auto on_arc = [&](const Point& corner, const Point& p) {
      if ((p.array() < lo.array()).any() || (p.array() > hi.array()).any()) return;
      if (to_outline(p) > kPrecision_mm && to_voids(p) > e - 1e-9) make_exact(corner, p);
    };
    for (const Point& corner : corners) {
      // The deciding hull edge lies on the corner between two tangents.
      for (const Point& end : {Point(failure.least.from + at), Point(failure.least.to + at)}) {
        const double excess = (end - corner).norm() - e;
        if (excess > kPrecision_mm && excess < 0.05 * e && to_voids(end) > e + kPrecision_mm) make_exact(corner, end);
      }
      for (const EdgeSet::Edge& edge : pose.travelling.edges.edges) {
        const Point a = edge.a + at, along = edge.b - edge.a, from = a - corner;
        // A corner of the part between the arc and its tangents.
        const double out = from.norm() - e;
        if (out > 0 && out < 0.05 * e && to_voids(a) > e) make_exact(corner, a);
        // The edge about to touch the arc.
        const Point normal = Point(along.y(), -along.x()).normalized();
        for (const double side : {-e, e}) {
          const Point touching = corner + side * normal;
          if (distance_to_segment(touching, a, a + along) < 0.05 * e) on_arc(corner, touching);
        }
        const double aa = along.squaredNorm(), half_b = from.dot(along), c = from.squaredNorm() - e * e;
        const double discriminant = half_b * half_b - aa * c;
        if (discriminant < 0) continue;
        for (const double sign : {-1.0, 1.0}) {
          const double t = (-half_b + sign * std::sqrt(discriminant)) / aa;
          if (t >= 0 && t <= 1) on_arc(corner, a + t * along);
        }
      }
      for (const Point& other : corners) {  // two arcs
        const Point between = other - corner;
        const double d = between.norm();
        if (d <= 1e-9 || d >= 2 * e) continue;
        const Point across(-between.y() / d, between.x() / d);
        for (const double side : {-1.0, 1.0}) {
          on_arc(corner, corner + 0.5 * between + side * std::sqrt(e * e - 0.25 * d * d) * across);
        }
      }
      for (const Loop& loop : loops) {  // an arc and a straight edge, moved
        for (std::size_t k = 0; k < loop.size(); ++k) {
          const Point t = (loop[(k + 1) % loop.size()] - loop[k]).normalized();
          const Point normal = (delivered_[i] ? e : -e) * Point(t.y(), -t.x());
          const Point from = loop[k] + normal - corner;
          const double off = cross(t, from);
          if (std::abs(off) >= e) continue;
          const Point foot = corner + off * Point(-t.y(), t.x());
          for (const double side : {-1.0, 1.0}) on_arc(corner, foot + side * std::sqrt(e * e - off * off) * t);
        }
      }
    }
    if (added) grown_.e = shrunk_.e = -1;
    return added;
  }

  const PartModel& part_;
  const Layout& layout_;
  const std::vector<bool>& delivered_;
  std::vector<std::vector<Interval>> held_;
  std::vector<double> clearance_;
  std::vector<VoidGroup> groups_;
  double groups_reach_ = 0;
  std::vector<ArcTangent> tangents_;
  Outlines grown_, shrunk_;
  std::int64_t sweeps_ = 0;
};

}  // namespace

std::vector<Interval> held_intervals(const PoseModel& pose, const Layout& layout) {
  std::vector<Interval> held;
  for (const LaidFeature& feature : layout.features) {
    if (!feature.holds_down || pose.height_mm > *feature.blade_mm) continue;
    if (*feature.blade_mm >= 2 * pose.height_mm) continue;
    const Interval under{feature.start_mm - pose.x_min, feature.end_mm - pose.x_max};
    if (under.from < under.to) held.push_back(under);
  }
  return held;
}

double blade_clearance(const PoseModel& pose, const Layout& layout) {
  double clearance = kInfinity;
  for (const LaidFeature& feature : layout.features) {
    if (feature.blade_mm) clearance = std::min(clearance, *feature.blade_mm - pose.height_mm);
  }
  return clearance;
}

ToleranceResult tolerance(const PartModel& part, const Layout& layout, const std::vector<bool>& delivered,
                          const std::vector<double>& nominal_mm) {
  return Search(part, layout, delivered).run(nominal_mm);
}

}  // namespace formotion::feeder
