#include "applications/feeder/turning.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/motion/outcome_map.hpp"

namespace formotion::feeder {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kFirstRung_mm = 0.01;
constexpr double kTolerancePrecision_mm = 1e-3;
constexpr int kRing = 24;  // further starts on a belt that the tolerance looks at

PoseTravel pose_travel_of(const StartTravel& travel, const std::string& aspect, double orientation, double prior,
                          bool has_voids) {
  PoseTravel result;
  result.result.aspect = aspect;
  result.result.orientation_rad = orientation;
  result.result.prior = prior;
  result.result.outcome = travel.outcome;
  result.result.exit_orientation_rad = travel.exit_rad;
  if (has_voids || travel.outcome == Outcome::Delivered || travel.outcome == Outcome::Rejected)
    result.result.margin_mm = travel.margin_mm;
  result.result.decided_by = travel.decided_by;
  result.result.marginal = travel.marginal;
  result.result.reason = travel.reason;
  result.lacking_mm = travel.lacking_mm;
  result.nominal_mm = travel.margin_mm;
  return result;
}

double extent_along(const AspectShape& shape, double theta) {
  double low = 1e300, high = -1e300;
  for (const Polygon& body : shape.bodies) {
    for (const Point& p : body.outer) {
      const double x = rotated(p, theta).x();
      low = std::min(low, x);
      high = std::max(high, x);
    }
  }
  return high - low;
}

bool has_voids(const Layout& layout) {
  return std::any_of(layout.features.begin(), layout.features.end(), [](const auto& f) { return !f.voids.empty(); });
}

// Ends as maps tell them apart: an outcome, and for parts that an edge has guided out the orientation.
class EndClasses {
 public:
  explicit EndClasses(int symmetry) : period_(kTurn / symmetry) {}
  int of(const StartTravel& travel) {
    if (travel.outcome != Outcome::Delivered) return -1 - static_cast<int>(travel.outcome);
    if (!travel.settled) return 0;  // leaves as it came, or turned from there
    for (std::size_t i = 0; i < exits_.size(); ++i) {
      if (std::abs(std::remainder(*travel.exit_rad - exits_[i], period_)) <= kSameExit_rad)
        return static_cast<int>(i) + 1;
    }
    exits_.push_back(*travel.exit_rad);
    return static_cast<int>(exits_.size());
  }

 private:
  double period_;
  std::vector<double> exits_;
};

// The basins of the poses on the plain wall, each with its pose's end.
void map_of_basins(const PartModel& part, TurningEvaluation& evaluation) {
  for (std::size_t aspect = 0; aspect < part.shapes.size(); ++aspect) {
    std::vector<MapInterval> intervals;
    const int order = part.symmetry[aspect];
    for (std::size_t i = 0; i < part.poses.size(); ++i) {
      const StablePose& stable = part.poses[i].stable;
      if (stable.aspect != static_cast<int>(aspect)) continue;
      for (int k = 0; k < order; ++k) {
        const PoseResult& end = evaluation.poses[i].result;
        MapInterval interval{end.aspect, std::fmod(stable.basin_from_rad + k * kTurn / order, kTurn), 0, end.outcome,
                             end.exit_orientation_rad};
        interval.sample_rad = stable.orientation_rad;
        intervals.push_back(interval);
      }
    }
    std::sort(intervals.begin(), intervals.end(),
              [](const MapInterval& a, const MapInterval& b) { return a.from_rad < b.from_rad; });
    for (std::size_t i = 0; i < intervals.size(); ++i)
      intervals[i].to_rad = i + 1 < intervals.size() ? intervals[i + 1].from_rad : intervals.front().from_rad;
    if (intervals.size() == 1) {
      intervals.front().from_rad = 0;
      intervals.front().to_rad = kTurn;
    }
    // Neighbours that end alike are one.
    std::vector<MapInterval> merged;
    for (const MapInterval& interval : intervals) {
      if (!merged.empty() && merged.back().outcome == interval.outcome &&
          merged.back().exit_orientation_rad == interval.exit_orientation_rad) {
        merged.back().to_rad = interval.to_rad;
      } else {
        merged.push_back(interval);
      }
    }
    if (merged.size() > 1 && merged.front().outcome == merged.back().outcome &&
        merged.front().exit_orientation_rad == merged.back().exit_orientation_rad) {
      merged.back().to_rad = merged.front().to_rad;
      merged.erase(merged.begin());
    } else if (merged.size() == 1) {
      merged.front().from_rad = 0;
      merged.front().to_rad = kTurn;
    }
    evaluation.map.insert(evaluation.map.end(), merged.begin(), merged.end());
  }
}

void map_of_belt(const PartModel& part, const Layout& layout, TurningTrack& track, const TravelOptions& options,
                 TurningEvaluation& evaluation) {
  for (int aspect = 0; aspect < static_cast<int>(part.shapes.size()); ++aspect) {
    const AspectShape& shape = part.shapes[aspect];
    EndClasses classes(part.symmetry[aspect]);
    const int first_class = 10000 * aspect;  // aspects never leave alike
    const OutcomeMap map = outcome_map(
        [&](double theta) {
          const StartTravel travel = track.travel_quickly(aspect, track.belt_start(theta));
          return StartOutcome{classes.of(travel), travel.history};
        },
        {});
    evaluation.projections += map.starts;
    for (const OutcomeInterval& found : map.intervals) {
      const StartTravel travel = track.travel(aspect, track.belt_start(found.sample_rad), options);
      ++evaluation.projections;
      MapInterval interval{shape.name,      found.from_rad, found.to_rad,    travel.outcome,
                           travel.exit_rad, found.thin,     found.sample_rad};
      evaluation.map.push_back(interval);
      PoseTravel arrival = pose_travel_of(travel, shape.name, found.sample_rad,
                                          shape.probability * interval.width_rad() / kTurn, has_voids(layout));
      arrival.aspect = aspect;
      arrival.extent_mm = extent_along(shape, found.sample_rad);
      if (travel.exit_rad && travel.settled) {
        arrival.exit_pose = exit_pose(part, aspect, *travel.exit_rad);
        arrival.exit_class = first_class + classes.of(travel);
      }
      evaluation.arrivals.push_back(std::move(arrival));
    }
  }
}

// Whether one arrival ends as before, with the margin that the errors must leave.
bool ends_alike(const PoseTravel& nominal, const StartTravel& travel, double margin_mm, double period) {
  const PoseResult& before = nominal.result;
  if (travel.outcome != before.outcome) return false;
  if (before.outcome != Outcome::Delivered) return true;
  return travel.margin_mm >= margin_mm && travel.exit_rad &&
         std::abs(std::remainder(*travel.exit_rad - *before.exit_orientation_rad, period)) <= kSameExit_rad;
}

class ToleranceSearch {
 public:
  ToleranceSearch(const PartModel& part, const Layout& layout, const Environment& environment,
                  const TurningEvaluation& nominal, const std::vector<bool>& counted)
      : part_(part), layout_(layout), environment_(environment), nominal_(nominal), counted_(counted) {
    for (std::size_t i = 0; i < nominal.arrivals.size(); ++i) {
      const PoseTravel& arrival = nominal.arrivals[i];
      if (counts(i) && arrival.result.outcome == Outcome::Delivered && has_voids(layout))
        most_ = std::min(most_, std::max(0.0, arrival.nominal_mm));
    }
  }

  TurningTolerance run() {
    TurningTolerance result;
    double good = 0, bad = 0;
    for (double e = kFirstRung_mm; bad == 0; e *= std::numbers::sqrt2) {
      const double rung = std::min(e, most_);
      if (rung <= good) break;
      (holds(rung) ? good : bad) = rung;
    }
    while (bad > 0 && bad - good > kTolerancePrecision_mm) {
      const double middle = (good + bad) / 2;
      (holds(middle) ? good : bad) = middle;
    }
    result.tolerance_mm = good;
    result.projections = projections_;
    return result;
  }

 private:
  bool counts(std::size_t arrival) const { return counted_.empty() || counted_[arrival]; }

  bool holds(double e) {
    const bool voids = has_voids(layout_);
    for (const double obstacles : {e, -e}) {
      for (const double by : voids ? std::vector<double>{e, -e} : std::vector<double>{0}) {
        std::optional<TurningTrack> track = TurningTrack::of(part_, layout_, environment_, {obstacles, by});
        if (!track || !holds_on(*track, by, e, voids)) return false;
      }
    }
    return true;
  }

  bool holds_on(TurningTrack& track, double voids_by, double e, bool voids) {
    const bool belt = is_belt(environment_);
    for (std::size_t i = 0; i < nominal_.arrivals.size(); ++i) {
      if (!counts(i)) continue;
      const PoseTravel& arrival = nominal_.arrivals[i];
      const bool delivered = arrival.result.outcome == Outcome::Delivered;
      if (voids && delivered != (voids_by > 0)) continue;  // larger voids threaten what is kept, smaller what is lost
      const double period = kTurn / part_.symmetry[arrival.aspect];
      const Configuration start =
          belt ? track.belt_start(arrival.result.orientation_rad) : track.pose_start(part_.poses[i]);
      ++projections_;
      const StartTravel travel =
          voids ? track.travel(arrival.aspect, start) : track.travel_quickly(arrival.aspect, start);
      if (!ends_alike(arrival, travel, voids && delivered ? e : 0, period)) return false;
    }
    return !belt || ring_ends_alike(track);
  }

  // On a belt boundaries move with the errors; but no start may end in a way that none ended in before.
  bool ring_ends_alike(TurningTrack& track) {
    for (int aspect = 0; aspect < static_cast<int>(part_.shapes.size()); ++aspect) {
      for (int k = 0; k < kRing; ++k) {
        ++projections_;
        const StartTravel travel = track.travel_quickly(aspect, track.belt_start(kTurn * k / kRing));
        const double period = kTurn / part_.symmetry[aspect];
        const bool known =
            std::any_of(nominal_.arrivals.begin(), nominal_.arrivals.end(), [&](const PoseTravel& arrival) {
              return arrival.aspect == aspect && ends_alike(arrival, travel, 0, period);
            });
        if (!known) return false;
      }
    }
    return true;
  }

  const PartModel& part_;
  const Layout& layout_;
  const Environment& environment_;
  const TurningEvaluation& nominal_;
  const std::vector<bool>& counted_;
  double most_ = kMostTurningTolerance_mm;
  std::int64_t projections_ = 0;
};

}  // namespace

int exit_pose(const PartModel& part, int aspect, double exit_rad) {
  for (std::size_t i = 0; i < part.poses.size(); ++i) {
    const StablePose& stable = part.poses[i].stable;
    if (stable.aspect != aspect) continue;
    if (std::abs(std::remainder(exit_rad - stable.orientation_rad, kTurn / part.symmetry[aspect])) <= kSameExit_rad)
      return static_cast<int>(i);
  }
  return -1;
}

TurningEvaluation travel_all_turning(const PartModel& part, const Layout& layout, const Environment& environment,
                                     bool detail) {
  TurningEvaluation evaluation;
  const TravelOptions options{false, detail};
  TurningTrack track = *TurningTrack::of(part, layout, environment);  // what is not shrunk does not vanish
  for (const PoseModel& pose : part.poses) {
    const int aspect = pose.stable.aspect;
    const Configuration start =
        is_belt(environment) ? track.belt_start(pose.stable.orientation_rad) : track.pose_start(pose);
    StartTravel travel = track.travel(aspect, start, options);
    ++evaluation.projections;
    PoseTravel result = pose_travel_of(travel, part.shapes[aspect].name, pose.stable.orientation_rad, pose.stable.prior,
                                       has_voids(layout));
    result.aspect = aspect;
    result.extent_mm = pose.x_max - pose.x_min;
    if (travel.exit_rad) {
      result.exit_pose = result.exit_class = exit_pose(part, aspect, *travel.exit_rad);
      // The pose's own orientation, rather than a last bit beside it.
      if (result.exit_pose >= 0 && part.symmetry[aspect] == 1)
        result.result.exit_orientation_rad = part.poses[result.exit_pose].stable.orientation_rad;
    }
    evaluation.poses.push_back(std::move(result));
  }
  if (is_belt(environment)) {
    map_of_belt(part, layout, track, options, evaluation);
  } else {
    evaluation.arrivals = evaluation.poses;
    map_of_basins(part, evaluation);
  }
  return evaluation;
}

TurningTolerance turning_tolerance(const PartModel& part, const Layout& layout, const Environment& environment,
                                   const TurningEvaluation& nominal, const std::vector<bool>& counted) {
  return ToleranceSearch(part, layout, environment, nominal, counted).run();
}

std::vector<Sensitivity> gyration_sensitivity(const PartModel& part, const Layout& layout,
                                              const Environment& environment, const TurningEvaluation& nominal) {
  std::vector<Sensitivity> results;
  for (const double factor : {0.5, 0.8, 1.25, 2.0}) {
    Sensitivity result{factor, true, 0};
    const bool belt = is_belt(environment);
    // Factors of each aspect's own radius: evaluated one aspect at a time.
    for (int aspect = 0; aspect < static_cast<int>(part.shapes.size()); ++aspect) {
      Environment other = environment;
      other.radius_of_gyration_mm = factor * gyration_mm(part.shapes[aspect], environment);
      TurningTrack track = *TurningTrack::of(part, layout, other);
      for (std::size_t i = 0; i < nominal.arrivals.size(); ++i) {
        const PoseTravel& arrival = nominal.arrivals[i];
        if (arrival.aspect != aspect) continue;
        const Configuration start =
            belt ? track.belt_start(arrival.result.orientation_rad) : track.pose_start(part.poses[i]);
        if (ends_alike(arrival, track.travel(aspect, start), 0, kTurn / part.symmetry[aspect])) continue;
        result.same_outcomes = false;
        result.changed_probability += arrival.result.prior;
      }
    }
    results.push_back(result);
  }
  return results;
}

std::vector<std::vector<std::vector<double>>> transition_matrices(const PartModel& part, const Layout& layout,
                                                                  const Environment& environment) {
  std::vector<std::vector<std::vector<double>>> matrices;
  for (const LaidFeature& feature : layout.features) {
    Layout alone;
    alone.features.push_back(feature);
    TurningTrack track = *TurningTrack::of(part, alone, environment);
    std::vector<std::vector<double>> matrix(part.poses.size(), std::vector<double>(part.poses.size(), 0));
    for (std::size_t i = 0; i < part.poses.size(); ++i) {
      const int aspect = part.poses[i].stable.aspect;
      const StartTravel travel = track.travel(aspect, track.pose_start(part.poses[i]));
      if (!travel.exit_rad) continue;
      if (const int j = exit_pose(part, aspect, *travel.exit_rad); j >= 0) matrix[i][j] = 1;
    }
    matrices.push_back(std::move(matrix));
  }
  return matrices;
}

}  // namespace formotion::feeder
