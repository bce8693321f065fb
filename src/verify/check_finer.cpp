#include <algorithm>
#include <cmath>
#include <sstream>

#include "analysis/constraints/planar_support.hpp"
#include "analysis/geometry/boolean.hpp"
#include "analysis/geometry/offset.hpp"
#include "verify/checks.hpp"
#include "verify/travel_places.hpp"

namespace formotion {
namespace {

using namespace feeder;

constexpr double kStep_mm = 0.01;        // of a look at a whole travel
constexpr double kFineStep_mm = 0.0005;  // about its lowest place
constexpr double kBeside_mm = 3e-8;      // what no neighbour shows is the rounding of a touch
constexpr double kMarginsAgree_mm = 1e-6;
constexpr double kBisection_mm = 1e-9;
constexpr double kFineArc_rad = 0.02;
constexpr double kTolerancesAgree_mm = 1e-4;  // fine arcs leave circles by e / 20,000, and margins may follow steeply
constexpr int kRungs = 12;                    // errors that parts which turn are tried at

std::string text(double mm) {
  std::ostringstream out;
  out.precision(9);
  out << mm << " mm";
  return out.str();
}

// The travel of one pose past the voids by samples: the least margin where something supports it, and whether
// it is anywhere without support.
struct Sampled {
  double least_mm = 1e300;
  double x_mm = 0;
  bool unsupported = false;
  std::int64_t places = 0;
};

Sampled sampled(const TestedDesign& design, const PoseModel& pose, const std::vector<Loop>& voids) {
  Sampled result;
  const Track track{design.environment().track_width_mm, united(voids)};
  const std::vector<Interval> held = held_intervals(pose, design.layout);
  const auto margin = [&](double x) {
    Polygon part = pose.footprint;
    for (Point& p : part.outer) p.x() += x;
    for (Loop& hole : part.holes) {
      for (Point& p : hole) p.x() += x;
    }
    return support_margin(part, track, {x, pose.travelling.supported_y_mm});
  };
  const Interval range = voids.empty() ? Interval{0, 0} : travel_range(pose.footprint, voids);
  const auto look = [&](double x) {
    if (std::any_of(held.begin(), held.end(), [&](const Interval& h) { return h.from <= x && x <= h.to; })) return;
    ++result.places;
    const std::optional<double> here = margin(x);
    if (here && *here >= result.least_mm) return;
    const std::optional<double> before = margin(x - kBeside_mm), behind = margin(x + kBeside_mm);
    if (!here) {
      result.unsupported = result.unsupported || (!before && !behind);
      return;
    }
    if (std::min(before.value_or(1e300), behind.value_or(1e300)) > *here + kMarginsAgree_mm) return;
    result.least_mm = *here;
    result.x_mm = x;
  };
  const int steps = static_cast<int>(std::ceil((range.to - range.from) / kStep_mm));
  for (int k = 0; k <= steps; ++k) look(range.from + k * kStep_mm);
  const double lowest = result.x_mm;
  const int fine = static_cast<int>(std::ceil(2 * kStep_mm / kFineStep_mm));
  for (int k = -fine; k <= fine; ++k) look(lowest + k * kFineStep_mm);
  return result;
}

// The track's voids with every edge off by e.
std::vector<Loop> moved(const Layout& plain, double e, const OffsetOptions& options = {}) {
  std::vector<Loop> loops;
  for (const LaidFeature& feature : plain.features)
    loops.insert(loops.end(), feature.voids.begin(), feature.voids.end());
  return e == 0 || loops.empty() ? loops : offset(loops, e, options);
}

// The contract's condition on errors of e, pose by pose.
class Passive {
 public:
  explicit Passive(const TestedDesign& design) : design_(design) {}

  bool holds(double e) const {
    OffsetOptions options;
    options.arc_step_rad = kFineArc_rad;
    const VoidOutline grown = VoidOutline::of(moved(design_.plain, e, options)),
                      shrunk = VoidOutline::of(moved(design_.plain, -e, options));
    for (std::size_t i = 0; i < design_.part.poses.size(); ++i) {
      const PoseModel& pose = design_.part.poses[i];
      const bool delivered = design_.arrivals[i].result.outcome == Outcome::Delivered;
      const double clearance = blade_clearance(pose, design_.layout);
      const VoidOutline& voids = delivered ? grown : shrunk;
      LeastMargin least;
      if (!voids.edges.edges.empty())
        least = least_margin({pose.travelling, voids, held_intervals(pose, design_.layout)});
      const double margin = std::min(least.margin_mm, pose.travelling.plain_margin_mm);
      if (delivered ? least.unsupported || std::min(margin, clearance) < e
                    : std::min(std::max(-margin, -clearance), design_.part.diameter_mm) < e)
        return false;
    }
    return true;
  }

  double largest(double most) const {
    double low = 0, high = most;
    while (high - low > kBisection_mm) {
      const double middle = 0.5 * (low + high);
      (holds(middle) ? low : high) = middle;
    }
    return low;
  }

 private:
  const TestedDesign& design_;
};

void check_margins(const TestedDesign& design, Check& check) {
  const std::vector<Loop> voids = moved(design.plain, 0);
  for (std::size_t i = 0; i < design.part.poses.size(); ++i) {
    const PoseTravel& arrival = design.arrivals[i];
    const PoseResult& claimed = arrival.result;
    const bool delivered = claimed.outcome == Outcome::Delivered;
    const Sampled found = sampled(design, design.part.poses[i], voids);
    check.count += found.places;
    if (delivered && (found.unsupported || found.least_mm < *claimed.margin_mm - kMarginsAgree_mm)) {
      check.fail(design.pose_name(arrival) + " is claimed to keep " + text(*claimed.margin_mm) + ", but has " +
                 (found.unsupported ? "no support" : text(found.least_mm)) + " at x = " + text(found.x_mm));
    }
    if (!delivered && -found.least_mm > *claimed.margin_mm + kMarginsAgree_mm &&
        *claimed.margin_mm < design.part.diameter_mm) {
      check.fail(design.pose_name(arrival) + " is claimed to be lost by " + text(*claimed.margin_mm) + ", but lies " +
                 text(-found.least_mm) + " beyond its support at x = " + text(found.x_mm));
    }
  }
}

// At the claimed tolerance, by samples: delivered poses past grown voids, lost ones past shrunk ones.
void check_margins_at_tolerance(const TestedDesign& design, Check& check) {
  OffsetOptions options;
  options.arc_step_rad = kFineArc_rad;
  const double e = design.claimed_mm;
  const std::vector<Loop> grown = moved(design.plain, e, options);
  for (std::size_t i = 0; i < design.part.poses.size(); ++i) {
    const PoseTravel& arrival = design.arrivals[i];
    if (arrival.result.outcome != Outcome::Delivered) continue;
    const Sampled found = sampled(design, design.part.poses[i], grown);
    check.count += found.places;
    if (found.unsupported || found.least_mm < e - kTolerancesAgree_mm)
      check.fail("with voids grown by the claimed " + text(e) + ", " + design.pose_name(arrival) + " keeps " +
                 (found.unsupported ? "no support" : text(found.least_mm)) + " at x = " + text(found.x_mm));
  }
}

void check_passive(const TestedDesign& design, Check& check) {
  check.unit = "positions";
  check_margins(design, check);
  if (design.claimed_mm <= 0) return;
  check_margins_at_tolerance(design, check);
  const double found = Passive(design).largest(2 * design.claimed_mm + 0.01);
  check.worst = found - design.claimed_mm;
  check.worst_of = "mm that the tolerance by bisection is more than claimed";
  if (std::abs(found - design.claimed_mm) > kTolerancesAgree_mm)
    check.fail("a tolerance of " + text(design.claimed_mm) + " is claimed, bisection finds " + text(found));
}

// Errors on a finer ladder than the tolerance's own: outcomes of parts that turn are not monotone in them.
void check_turning(const TestedDesign& design, Check& check) {
  check.unit = "tracks with errors";
  double good = 0;
  for (int rung = 1; rung <= kRungs && check.holds; ++rung) {
    const double e = design.claimed_mm * rung / kRungs;
    for (const double obstacles : {e, -e}) {
      for (const double voids : design.has_voids ? std::vector<double>{e, -e} : std::vector<double>{0}) {
        CompareOptions options;
        options.errors = {obstacles, voids};
        options.delivered = !design.has_voids || voids > 0;
        options.lost = !design.has_voids || voids < 0;
        ++check.count;
        const Comparison found = compare_ends(design, design.layout, options);
        if (!found.difference) continue;
        std::string how = std::string("with obstacles ") + (obstacles > 0 ? "grown" : "shrunk");
        if (design.has_voids) how += std::string(" and voids ") + (voids > 0 ? "grown" : "shrunk");
        check.fail(how + " by " + text(e) + " of the claimed " + text(design.claimed_mm) + ", " + *found.difference);
      }
    }
    if (check.holds) good = e;
  }
  check.worst = good;
  check.worst_of = "mm up to which all errors hold";
}

}  // namespace

Check check_finer(const TestedDesign& design) {
  Check check{"finer"};
  if (design.claimed_mm <= 0) check.note = "no tolerance is claimed";
  design.turns ? check_turning(design, check) : check_passive(design, check);
  return check;
}

}  // namespace formotion
