#include "applications/feeder/uncertainty_limits.hpp"

#include <algorithm>
#include <cmath>

#include "applications/feeder/feeder_problem.hpp"
#include "applications/feeder/part_spread.hpp"

namespace formotion::feeder {
namespace {

constexpr double kFirstRung = 0.125;
constexpr double kMonotonePrecision = 1e-3;
constexpr double kLadderPrecision = 0.05;

// Where values end: frictions at 0, tilts short of a wall, speeds above 0.
std::pair<double, double> range_of(const std::string& name) {
  if (name == "wall_friction" || name == "settling_friction") return {0, 10};
  if (name == "tilt_deg") return {-60, 60};
  if (name == "conveying_speed_mm_s") return {1e-3, 1e6};
  return {-360, 360};
}

// The largest factor that holds; none if kMostScale does.
std::optional<double> largest_factor(bool monotone, const std::function<bool(double)>& holds) {
  double good = 0, bad = 0;
  for (double rung = monotone ? 1 : kFirstRung; bad == 0; rung *= monotone ? 4 : 2) {
    const double factor = std::min(rung, kMostScale);
    (holds(factor) ? good : bad) = factor;
    if (good == kMostScale) return std::nullopt;
  }
  // The first halvings find the size, if nothing of it holds yet.
  const double precision = monotone ? kMonotonePrecision : kLadderPrecision;
  for (int k = 0; k < 60 && bad - good > precision * std::max(good, precision); ++k) {
    const double middle = (good + bad) / 2;
    (holds(middle) ? good : bad) = middle;
  }
  return good;
}

}  // namespace

Uncertainty scaled(const Uncertainty& uncertainty, const Environment& environment, double factor) {
  Uncertainty result = uncertainty;
  result.outline_mm *= factor;
  result.com_mm *= factor;
  result.feature_mm *= factor;
  for (auto& [name, interval] : result.intervals) {
    const double middle = value_of(environment, name);
    const auto [least, most] = range_of(name);
    interval = {std::clamp(middle + factor * (interval.first - middle), least, most),
                std::clamp(middle + factor * (interval.second - middle), least, most)};
  }
  return result;
}

UncertaintyLimits uncertainty_limits(const Uncertainty& uncertainty, const Environment& environment, bool monotone,
                                     const std::function<bool(const Uncertainty&)>& is_feasible) {
  const auto limit = [&](const Uncertainty& values) {
    return largest_factor(monotone, [&](double factor) { return is_feasible(scaled(values, environment, factor)); });
  };
  UncertaintyLimits limits;
  limits.scale = limit(uncertainty);
  for (const std::string& name : uncertain_values(uncertainty)) {
    const Uncertainty alone = only(uncertainty, name);
    const std::optional<double> factor = limit(alone);
    AloneLimit found{name, std::nullopt, std::nullopt};
    if (factor) {
      const Uncertainty at = scaled(alone, environment, *factor);
      if (at.intervals.empty()) {
        found.half_width = at.outline_mm + at.com_mm + at.feature_mm;  // one of them
      } else {
        found.interval = at.intervals.begin()->second;
      }
    }
    limits.alone.push_back(std::move(found));
  }
  return limits;
}

std::optional<UncertaintyLimits> uncertainty_limits(const FeederProblem& problem, int topology,
                                                    std::span<const double> values) {
  if (!problem.spec().uncertainty.any()) return std::nullopt;
  FeederSpec spec = problem.spec();
  spec.designs = {problem.literal_design(topology, values)};
  spec.grammar = std::nullopt;
  spec.robust = true;
  spec.objectives = {known_objectives().front()};  // a tolerance would be sought for in vain
  const auto is_feasible = [&](const Uncertainty& uncertainty) {
    spec.uncertainty = uncertainty;
    const FeederProblem member(spec);
    Candidate candidate;
    for (const int used : member.topologies()[0].variables)
      candidate.values.push_back(values[static_cast<std::size_t>(used)]);
    return member.score(candidate).feasible;
  };
  const Uncertainty given = spec.uncertainty;
  if (!is_feasible({})) return std::nullopt;
  const std::vector<PlacedFeature> placed = problem.place(topology, values);
  const bool turns = std::any_of(placed.begin(), placed.end(), [](const PlacedFeature& feature) {
    return !feature.obstacles.empty() || !feature.wall_face_mm.empty();
  });
  return uncertainty_limits(given, spec.environment, !turns, is_feasible);
}

}  // namespace formotion::feeder
