// One random nest, its escape height, and all that a planner tries against it.
#pragma once

#include <limits>
#include <vector>

#include "analysis/energy/nests.hpp"
#include "witness/escape_planner.hpp"

namespace formotion::witness {

inline constexpr double kUnder_mm = 1e-6;  // ways that are lower by more than this contradict a lower bound

struct Attack {
  const char* why_not = nullptr;  // nothing to attack
  bool is_enclosed = false, got_below = false;
  double lower_mm = 0, upper_mm = 0;                           // rises over the start
  double alone_mm = std::numeric_limits<double>::infinity();   // the planner's own lowest way
  double pushed_mm = std::numeric_limits<double>::infinity();  // from the way of the upper bound, lowered
  long free_samples = 0;
  Configuration start;
  std::vector<Configuration> path;  // below the lower bound
};

// Places along a way, every step_mm or less.
inline std::vector<Configuration> dense(const PlannedNest& nest, const std::vector<Configuration>& way,
                                        double step_mm) {
  std::vector<Configuration> all;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    const Configuration &a = way[i], &b = way[i + 1];
    const double turn = std::remainder(b.theta_rad - a.theta_rad, 2 * std::numbers::pi);
    const int steps = std::clamp(static_cast<int>(std::ceil(nest.way_mm(a, b) / step_mm)), 1, 200);
    for (int k = 0; k < steps; ++k) {
      const double h = static_cast<double>(k) / steps;
      all.push_back({std::lerp(a.x_mm, b.x_mm, h), std::lerp(a.y_mm, b.y_mm, h), a.theta_rad + h * turn});
    }
  }
  if (!way.empty()) all.push_back(way.back());
  return all;
}

// samples: free configurations for each of the planner's tasks. Half of the starts sink as far as they can.
inline Attack attacked_nest(std::uint64_t seed, long samples, double gap_mm) {
  Attack attack;
  const testing::RandomNest drawn(seed);
  const testing::Nest nest(drawn.part, drawn.fixed, drawn.grow_mm);
  const PlannedNest planned(drawn.part, drawn.fixed, drawn.grow_mm);
  const auto no = [&](const char* why) {
    attack.why_not = why;
    return attack;
  };
  if (!nest.obstacles.round_exactly) return no("tangents stand for arcs");
  if (planned.clearance_mm(drawn.start) < 1e-3) return no("no free start");
  Random random(seed + 1000);
  attack.start = seed % 2 == 0 ? drawn.start : sunk(planned, drawn.start, random);
  if (nest.is_out(attack.start)) return no("out at its start");
  EscapeOptions options;
  options.gap_mm = gap_mm;
  const EscapeBracket bracket = nest.escape(attack.start, options);
  attack.lower_mm = bracket.lower_mm;
  attack.is_enclosed = std::isinf(bracket.lower_mm);
  if (bracket.lower_mm < 0.01) return no("nothing to rise over");
  if (!attack.is_enclosed && !bracket.upper_mm) return no("no upper bound");
  attack.upper_mm = bracket.upper_mm.value_or(bracket.lower_mm);

  const EscapeGoal goal = beyond(nest.obstacles, nest.gravity);
  WayQuestion question;
  question.start = attack.start;
  question.from_mm = goal.from_mm;
  question.to_mm = goal.to_mm;
  question.free_samples = samples;
  question.seed = seed;
  const double base = attack.start.y_mm;
  const auto ask = [&](double below_mm, bool hinted, double& found_mm) {
    question.below_mm = below_mm;
    question.hint = hinted ? dense(planned, bracket.path, 0.25) : std::vector<Configuration>{};
    FoundWay found = look_for_way(planned, question);
    attack.free_samples += found.free_samples;
    if (!found.got_out) return;
    found_mm = found.highest_mm - base;
    if (found_mm >= attack.lower_mm - kUnder_mm) return;
    attack.got_below = true;
    attack.path = std::move(found.path);
  };
  double under = std::numeric_limits<double>::infinity();
  if (attack.is_enclosed) {
    ask(base + 80, false, under);
    return attack;
  }
  ask(base + attack.lower_mm - kUnder_mm, true, under);
  ask(base + attack.upper_mm + 0.01, true, attack.pushed_mm);
  ask(base + attack.upper_mm + 10, false, attack.alone_mm);
  return attack;
}

}  // namespace formotion::witness
