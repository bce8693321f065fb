#include "cases.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace formotion::bench {
namespace {

Affine literal(double value) { return {value, {}}; }
Affine variable(int index) { return {0, {{index, 1.0}}}; }
AffineLoop literal(const Loop& loop) {
  AffineLoop result;
  for (const Point& p : loop) result.push_back({literal(p.x()), literal(p.y())});
  return result;
}

std::vector<Objective> named(const std::vector<std::string>& names) {
  std::vector<Objective> objectives;
  for (const std::string& name : names) {
    for (const Objective& known : feeder::known_objectives()) {
      if (known.name == name) objectives.push_back(known);
    }
  }
  return objectives;
}

}  // namespace

double uniform(Random& random, double from, double to) {
  return from + (to - from) * static_cast<double>(random() >> 11) * 0x1.0p-53;
}

feeder::FeederSpec el_bracket(const std::vector<std::string>& objectives) {
  feeder::FeederSpec spec;
  feeder::AspectSpec up;
  up.name = "up";
  up.outline_mm = literal({{0, 0}, {30, 0}, {30, 10}, {10, 10}, {10, 20}, {0, 20}});
  up.height_mm = 3;
  up.probability = 0.5;
  feeder::AspectSpec down = up;
  down.name = "down";
  down.outline_mm = literal({{0, 0}, {0, 20}, {-10, 20}, {-10, 10}, {-30, 10}, {-30, 0}});
  spec.part.aspects = {up, down};
  spec.environment.track_width_mm = 40;
  spec.environment.tilt_rad = 5 * std::numbers::pi / 180;
  spec.goal.one_pose = true;
  spec.variables = {{"w", 6, 20, 9.0}, {"x0", 0, 60, {}}, {"y0", 0, 45, {}}, {"x1", 0, 60, {}},
                    {"y1", 0, 45, {}}, {"x2", 0, 60, {}}, {"y2", 0, 45, {}}};
  feeder::Cutout triangle;
  for (int i = 0; i < 3; ++i) triangle.polygon_mm.push_back({variable(1 + 2 * i), variable(2 + 2 * i)});
  spec.designs = {{{feeder::Balcony{variable(0), literal(60)}, {}}, {triangle, {}}}};
  spec.objectives = named(objectives);
  return spec;
}

std::vector<Candidate> random_candidates(const feeder::FeederProblem& problem, int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Candidate> candidates(count);
  for (Candidate& candidate : candidates) {
    for (const Variable& v : problem.variables()) candidate.values.push_back(uniform(random, v.min, v.max));
  }
  return candidates;
}

std::vector<Candidate> feasible_candidates(const feeder::FeederProblem& problem, int count, std::uint64_t seed) {
  Random random(seed);
  const std::span<const Variable> variables = problem.variables();
  const Candidate best{0, {8.65, 7.373, 0.516, 8.4255, 44.825, 33.174, 10.824}};  // a run's, tolerance 0.64 mm
  std::vector<Candidate> feasible;
  Candidate here = best;
  while (static_cast<int>(feasible.size()) < count) {
    Candidate next = here;
    for (std::size_t i = 0; i < next.values.size(); ++i) {
      const double range = 0.01 * (variables[i].max - variables[i].min);
      next.values[i] = std::clamp(next.values[i] + uniform(random, -range, range), variables[i].min, variables[i].max);
    }
    if (!problem.score(next).feasible) continue;
    feasible.push_back(next);
    here = feasible.size() % 20 ? next : best;
  }
  return feasible;
}

Loop star(Random& random, int corners, double inner, double outer) {
  Loop loop;
  for (int i = 0; i < corners; ++i) {
    const double angle = (i + uniform(random, 0.1, 0.9)) * 2 * std::numbers::pi / corners;
    const double radius = uniform(random, inner, outer);
    loop.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return loop;
}

Loop gear(int corners, double inner, double outer) {
  Loop loop;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    const double radius = i % 2 ? inner : outer;
    loop.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return loop;
}

feeder::FeederSpec part_over_cutout(const Loop& part, const Loop& hole) {
  feeder::FeederSpec spec;
  feeder::AspectSpec up;
  up.name = "up";
  up.outline_mm = literal(part);
  up.height_mm = 3;
  spec.part.aspects = {up};
  spec.environment.track_width_mm = 60;
  spec.goal.one_pose = true;
  spec.designs = {{{feeder::Cutout{literal(hole)}, {}}}};
  spec.objectives = named({"efficiency", "margin_mm", "length_mm"});
  return spec;
}

}  // namespace formotion::bench
