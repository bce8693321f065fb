#include "applications/feeder/tolerance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "analysis/geometry/offset.hpp"

namespace formotion::feeder {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kPrecision_mm = 1e-8;
constexpr int kMostTangents = 24;  // refinements of arcs: each one at least quarters the error that it meets

// The place that decided a margin, in the world.
struct Place {
  LeastMargin least;
  double supported_y_mm = 0;
};

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
      if (slack(pose, best, nullptr) >= 0) continue;
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

  // How much better than demanded pose i does at e: negative if it fails. place: what decided.
  double slack(int i, double e, Place* place) {
    const PoseModel& pose = part_.poses[i];
    LeastMargin least;
    for (const VoidOutline& voids : outlines(delivered_[i], e)) {
      ++sweeps_;
      const LeastMargin found = least_margin({pose.travelling, voids, held_[i]});
      if (found.margin_mm < least.margin_mm) least = found;
    }
    least.margin_mm = std::min(least.margin_mm, pose.travelling.plain_margin_mm);
    if (place) *place = {least, pose.travelling.supported_y_mm};
    if (delivered_[i]) return std::min(least.margin_mm, clearance_[i]) - e;
    return std::min(std::max(-least.margin_mm, -clearance_[i]), part_.diameter_mm) - e;
  }

  // The largest e below high that pose i bears; arcs that decide are made exact where they do.
  double largest(int i, double high) {
    double low = 0;
    for (int refinement = 0; refinement < kMostTangents; ++refinement) {
      Place place;
      const double found = root(i, low, high, place);
      low = std::max(low, found);
      if (!refine(place, found)) break;
    }
    return low;
  }

  // Regula falsi with bisection where it does not halve the bracket: slack falls with e, but may jump.
  double root(int i, double low, double high, Place& place) {
    double at_low = slack(i, low, &place);
    if (at_low < 0) return low;
    double at_high = slack(i, high, nullptr);
    if (at_high >= 0) return high;
    bool bisect = false;
    while (high - low > kPrecision_mm) {
      const double width = high - low;
      double e = bisect ? 0.5 * (low + high) : low + width * at_low / (at_low - at_high);
      e = std::clamp(e, low + 0.5 * std::min(kPrecision_mm, width), high - 0.5 * std::min(kPrecision_mm, width));
      probe(i, e, low, high, at_low, at_high, place);
      // A hit from one side leaves the other end of the bracket far away: look just beyond it.
      if (low == e && high - low > kPrecision_mm) {
        probe(i, e + 0.9 * kPrecision_mm, low, high, at_low, at_high, place);
      } else if (high == e && high - low > kPrecision_mm) {
        probe(i, e - 0.9 * kPrecision_mm, low, high, at_low, at_high, place);
      }
      bisect = high - low > 0.5 * width;
    }
    return low;
  }

  void probe(int i, double e, double& low, double& high, double& at_low, double& at_high, Place& place) {
    Place here;
    const double value = slack(i, e, &here);
    if (value >= 0) {
      low = e;
      at_low = value;
      place = here;
    } else {
      high = e;
      at_high = value;
    }
  }

  // Adds tangents where the deciding hull edge ends on the polygon that stands for an arc; false if it does not.
  bool refine(const Place& place, double e) {
    if (e <= 0 || !std::isfinite(place.least.margin_mm)) return false;
    bool added = false;
    for (const Point& end : {place.least.from, place.least.to}) {
      const Point p = end + Point(place.least.x_mm, place.supported_y_mm);
      double nearest = kInfinity;
      Point corner = Point::Zero();
      for (const VoidGroup& group : groups_) {
        for (const Loop& loop : group.loops) {
          for (std::size_t k = 0; k < loop.size(); ++k) {
            const double to_edge = distance_to_segment(p, loop[k], loop[(k + 1) % loop.size()]);
            nearest = std::min(nearest, to_edge);
            if ((p - loop[k]).norm() <= nearest) {
              nearest = (p - loop[k]).norm();
              corner = loop[k];
            }
          }
        }
      }
      const double excess = nearest - e;
      if (excess < kPrecision_mm || excess > 0.2 * e || (p - corner).norm() > nearest + 1e-12) continue;
      tangents_.push_back({corner, std::atan2(p.y() - corner.y(), p.x() - corner.x())});
      added = true;
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
