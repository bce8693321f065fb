#include "applications/feeder/stages.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "io/problem_file.hpp"
#include "witness/feeder_specs.hpp"

using namespace formotion;
using namespace formotion::witness;

namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

// Like the stamped bracket: a plate with a step, a slanting edge and a hole.
feeder::PartSpec stamped_part() {
  return flat_part({{0, 0}, {38, 0}, {38, 12}, {30, 18}, {14, 18}, {14, 26}, {0, 26}}, true,
                   {{{4, 16}, {4, 22}, {10, 22}, {10, 16}}});
}

feeder::FeatureSpec passive_feature(Random& random, double width) {
  const double from = uniform(random, -2, 14), to = from + uniform(random, 1, 12), length = uniform(random, 8, 60);
  switch (below(random, 9)) {
    case 0:
      return balcony(uniform(random, 5, 14), 60);
    case 1:
      return gap(uniform(random, 4, 18));
    case 2:
      return slot(from, to, length);
    case 3:
      return canyon(from, to, 60);
    case 4:
      return dish_out(uniform(random, 18, 26), 60);
    case 5:
      return scallop(uniform(random, width - 18, width - 6), uniform(random, 20, 60));
    case 6:
      return wiper(uniform(random, 2, 8));
    case 7:
      return hold_down(uniform(random, 2, 8), length);
    default:
      return cutout({{0, from}, {uniform(random, 15, 40), uniform(random, 0, 16)}, {length, uniform(random, 10, 45)}});
  }
}

// Up to which error one state ends as it does, or is kept or lost as asked; 0 where it is not.
double tolerance_of(const StagedProblem& staged, int kind, const std::vector<double>& values, const StageResult& result,
                    std::size_t state) {
  StageDemand demanded(staged.states().size(), false);
  demanded[state] = true;
  return staged.tolerance(kind, values, result, demanded, kNoLimit).tolerance_mm;
}

struct Composed {
  std::vector<feeder::Outcome> outcomes;
  std::vector<int> ends;
  double tolerance_mm = kNoLimit, length_mm = 0;
};

// Stage by stage, as plainly as possible.
Composed composed(const StagedProblem& staged, int topology) {
  Composed track;
  std::vector<StageResult> results;
  for (const StageUse& use : staged.stages(topology)) {
    results.push_back(staged.pass(use.kind, {}));
    track.length_mm += results.back().length_mm;
  }
  for (std::size_t i = 0; i < staged.states().size(); ++i) {
    feeder::Outcome outcome = feeder::Outcome::Delivered;
    double kept = kNoLimit, lost = 0;
    for (std::size_t s = 0; s < results.size(); ++s) {
      const int end = results[s].ends[i].to;
      const double found = tolerance_of(staged, staged.stages(topology)[s].kind, {}, results[s], i);
      if (end >= 0) {
        kept = std::min(kept, found);
        continue;
      }
      lost = std::max(lost, found);
      if (outcome == feeder::Outcome::Delivered)
        outcome = end == kLostState ? feeder::Outcome::Rejected : feeder::Outcome::Jammed;
    }
    const bool delivered = outcome == feeder::Outcome::Delivered;
    track.outcomes.push_back(outcome);
    track.ends.push_back(delivered ? static_cast<int>(i) : kLostState);
    track.tolerance_mm = std::min(track.tolerance_mm, delivered ? kept : lost);
  }
  return track;
}

// Kinds of every passive type with free numbers, on the el: one topology each.
feeder::FeederSpec free_kinds() {
  feeder::FeederSpec spec = feeder_spec(flat_part(el_outline(), true), {}, 40);
  spec.environment.tilt_rad = 0.08;
  const auto variable = [&](double min, double max) {
    const int index = static_cast<int>(spec.variables.size());
    spec.variables.push_back({"v" + std::to_string(index), min, max, std::nullopt});
    return Affine{0, {{index, 1.0}}};
  };
  spec.designs = {{{feeder::Balcony{variable(4, 20), variable(40, 60)}, {}}},
                  {{feeder::Gap{variable(2, 30)}, {}}},
                  {{feeder::Canyon{variable(0, 14), variable(15, 45), literal(60)}, {}}},
                  {{feeder::Slot{variable(-2, 14), variable(15, 45), variable(5, 50)}, {}}},
                  {{feeder::Wiper{variable(1, 6)}, {}}}};
  feeder::Cutout corners;
  for (int i = 0; i < 4; ++i) corners.polygon_mm.push_back({variable(0, 60), variable(0, 45)});
  spec.designs.push_back({{corners, {}}});
  return spec;
}

// Random values, valid ones.
std::vector<double> valid_values(const StagedProblem& staged, int kind, Random& random) {
  for (;;) {
    std::vector<double> values;
    for (const Variable& v : staged.kinds()[kind].variables) values.push_back(uniform(random, v.min, v.max));
    if (staged.pass(kind, values).valid) return values;
  }
}

}  // namespace

TEST_CASE("a track's outcomes and tolerance are composed of its stages") {
  int equal = 0, tracks = 0, kinds_of_end[3] = {0, 0, 0};
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Random random(seed);
    feeder::FeederSpec spec = feeder_spec(seed % 2 ? flat_part(el_outline(), true) : stamped_part(), {}, 40);
    spec.environment.tilt_rad = uniform(random, 0, 0.1);
    if (seed % 3 == 0) spec.environment.spacing_mm = 60;
    for (int i = 0, n = 2 + below(random, 2); i < n; ++i) spec.designs[0].push_back(passive_feature(random, 40));
    const feeder::FeederProblem problem(spec);
    REQUIRE(problem.staged());
    const StagedProblem& staged = *problem.staged();
    const feeder::FeederEvaluation whole = problem.evaluate(0, {});
    if (!whole.metrics.tolerance_mm) continue;  // an invalid shape
    const Composed track = composed(staged, 0);
    ++tracks;
    INFO("seed " << seed << " " << problem.topologies()[0].label);
    double longest = 0, diameter = 0;
    for (const feeder::StablePose& pose : problem.stable_poses({})) {
      const AspectShape shape = problem.shapes({})[pose.aspect];
      const Box box = bounding_box(placed(shape.footprint, pose.orientation_rad, {0, 0}).outer);
      longest = std::max(longest, box.max.x() - box.min.x());
      diameter = std::max(diameter, formotion::diameter(shape.footprint.outer));
    }
    for (std::size_t i = 0; i < whole.poses.size(); ++i) {
      CHECK(whole.poses[i].outcome == track.outcomes[i]);
      const auto outcome = track.outcomes[i];
      ++kinds_of_end[outcome == feeder::Outcome::Delivered ? 0 : outcome == feeder::Outcome::Rejected ? 1 : 2];
    }
    CHECK(*whole.metrics.tolerance_mm <= track.tolerance_mm + 2e-8);
    const double spacing = spec.environment.spacing_mm.value_or(diameter);
    if (spacing - longest >= 2.2 * *whole.metrics.tolerance_mm) {
      CHECK(*whole.metrics.tolerance_mm == Approx(track.tolerance_mm).margin(2e-8).epsilon(0));
      if (track.tolerance_mm > 0.01) ++equal;
    }
    Composition composition{0, track.ends, *whole.metrics.tolerance_mm, track.length_mm};
    const std::vector<double> objectives = staged.objectives(composition);
    for (std::size_t k = 0; k < objectives.size(); ++k) {
      const std::string& name = spec.objectives[k].name;
      if (name == "efficiency") CHECK(objectives[k] == Approx(whole.metrics.efficiency).margin(1e-12));
      if (name == "length_mm") CHECK(objectives[k] == Approx(whole.metrics.length_mm).margin(1e-9));
      if (name == "feature_count") CHECK(objectives[k] == whole.metrics.feature_count);
      if (name == "feed_rate_per_min" && whole.metrics.feed_rate_per_min)
        CHECK(objectives[k] == Approx(*whole.metrics.feed_rate_per_min).margin(1e-9));
    }
  }
  CHECK(tracks > 25);
  CHECK(equal > 8);
  for (const int count : kinds_of_end) CHECK(count > 10);
}

TEST_CASE("a stage's tolerances change by no more than its edges move") {
  const feeder::FeederProblem problem(free_kinds());
  const StagedProblem& staged = *problem.staged();
  int changed = 0;
  for (int kind = 0; kind < static_cast<int>(staged.kinds().size()); ++kind) {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      Random random(seed);
      const std::vector<double> a = valid_values(staged, kind, random);
      std::vector<double> b = a, half;
      const double step = std::pow(10, uniform(random, -3, 0.5));
      for (std::size_t i = 0; i < b.size(); ++i) {
        const Variable& v = staged.kinds()[kind].variables[i];
        b[i] = std::clamp(a[i] + uniform(random, -step, step), v.min, v.max);
        half.push_back(std::abs(b[i] - a[i]));
      }
      const StageResult at_a = staged.pass(kind, a), at_b = staged.pass(kind, b);
      if (!at_b.valid) continue;
      const double moved = staged.displacement_mm(kind, half).value();
      for (std::size_t state = 0; state < staged.states().size(); ++state) {
        const double t_a = tolerance_of(staged, kind, a, at_a, state);
        const double t_b = tolerance_of(staged, kind, b, at_b, state);
        const bool alike = (at_a.ends[state].to >= 0) == (at_b.ends[state].to >= 0);
        INFO(staged.kinds()[kind].label << " seed " << seed << " state " << state);
        CHECK(std::abs(t_a - (alike ? t_b : 0)) <= moved + 3e-8);
        CHECK(std::abs(t_b - (alike ? t_a : 0)) <= moved + 3e-8);
        changed += t_a != t_b;
      }
    }
  }
  CHECK(changed > 100);
}

TEST_CASE("a state bears exactly the errors up to its tolerance") {
  const feeder::FeederProblem problem(free_kinds());
  const StagedProblem& staged = *problem.staged();
  int borne = 0;
  for (int kind = 0; kind < static_cast<int>(staged.kinds().size()); ++kind) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      Random random(seed);
      const std::vector<double> values = valid_values(staged, kind, random);
      const StageResult result = staged.pass(kind, values);
      for (int state = 0; state < static_cast<int>(staged.states().size()); ++state) {
        const bool kept = result.ends[state].to >= 0;
        const double t = tolerance_of(staged, kind, values, result, state);
        std::int64_t work = 0;
        INFO(staged.kinds()[kind].label << " seed " << seed << " state " << state << (kept ? " kept " : " lost ") << t);
        if (t > 1e-6) CHECK(staged.bears(kind, values, state, kept, t - 5e-8, work));
        if (t > 1e-6) CHECK(staged.bears(kind, values, state, kept, uniform(random, 0.01, 0.99) * t, work));
        CHECK_FALSE(staged.bears(kind, values, state, kept, t + 5e-8, work));
        CHECK_FALSE(staged.bears(kind, values, state, kept, 1.5 * t + 0.01, work));
        CHECK_FALSE(staged.bears(kind, values, state, !kept, 0.01, work));
        borne += t > 1e-6;
      }
    }
  }
  CHECK(borne > 100);
}

TEST_CASE("features that differ in the names of their variables alone are one kind") {
  const feeder::FeederSpec spec = read_problem_file(FORMOTION_SOURCE_DIR "/problems/feeder/el_bracket.json").feeder;
  const feeder::FeederProblem problem(spec);
  REQUIRE(problem.staged());
  const StagedProblem& staged = *problem.staged();
  REQUIRE(staged.kinds().size() == 2);
  CHECK(staged.kinds()[0].label == "cutout");
  CHECK(staged.kinds()[1].label == "balcony");
  REQUIRE(staged.stages(1).size() == 2);
  CHECK(staged.stages(1)[0].kind == 1);
  CHECK(staged.stages(1)[0].values == std::vector<int>{0});
  CHECK(staged.stages(1)[1].values == std::vector<int>{1, 2, 3, 4, 5, 6});
  CHECK(staged.goals().size() == problem.stable_poses({}).size());

  feeder::FeederSpec twice = free_kinds();  // the same gap with other variables; a second cut-out of three corners
  twice.variables.push_back({"other", 2, 30, std::nullopt});
  const int other = static_cast<int>(twice.variables.size()) - 1;
  twice.designs.push_back({{feeder::Gap{{0, {{other, 1.0}}}}, {}}, cutout({{0, 5}, {20, 5}, {10, 30}})});
  const feeder::FeederProblem more(twice);
  CHECK(more.staged()->stages(6)[0].kind == more.staged()->stages(1)[0].kind);
  CHECK(more.staged()->kinds().size() == 7);
  CHECK(more.staged()->kinds().back().label == "cutout(3)");
}

TEST_CASE("features that depend on one another make no stages") {
  const auto composes = [](const feeder::FeederSpec& spec) {
    const StagedProblem* staged = feeder::FeederProblem(spec).staged();
    return staged != nullptr;
  };
  const feeder::FeederSpec good = feeder_spec(flat_part(el_outline(), true), {balcony(9, 60), gap(10)}, 40);
  CHECK(composes(good));
  feeder::FeederSpec placed = good, near = good, shared = good, behind = good;
  placed.designs[0][1] = at(gap(10), 80);
  near.environment.spacing_mm = 20;
  behind.designs[0][1] = cutout({{-30, 5}, {20, 5}, {10, 30}});
  shared.variables.push_back({"w", 5, 15, std::nullopt});
  const Affine w{0, {{0, 1.0}}};
  shared.designs[0] = {{feeder::Balcony{w, literal(60)}, {}}, {feeder::Gap{w}, {}}};
  for (const feeder::FeederSpec& spec : {placed, near, shared, behind}) CHECK_FALSE(composes(spec));
}

TEST_CASE("starting values lie within their bounds and set poses apart") {
  const feeder::FeederProblem problem(free_kinds());
  const StagedProblem& staged = *problem.staged();
  for (int kind = 0; kind < static_cast<int>(staged.kinds().size()); ++kind) {
    const auto starts = staged.starts(kind);
    INFO(staged.kinds()[kind].label);
    CHECK(starts.size() <= 64);
    // All poses are equally high.
    CHECK(starts.empty() == (staged.kinds()[kind].label == "wiper"));
    for (const std::vector<double>& values : starts) {
      REQUIRE(values.size() == staged.kinds()[kind].variables.size());
      for (std::size_t i = 0; i < values.size(); ++i) {
        CHECK(values[i] >= staged.kinds()[kind].variables[i].min);
        CHECK(values[i] <= staged.kinds()[kind].variables[i].max);
      }
      const StageResult result = staged.pass(kind, values);
      CHECK(result.valid);
      CHECK(std::any_of(result.ends.begin(), result.ends.end(), [](const StageEnd& end) { return end.to >= 0; }));
      CHECK(std::any_of(result.ends.begin(), result.ends.end(),
                        [](const StageEnd& end) { return end.to == kLostState; }));
    }
  }
}

TEST_CASE("a lost pose that has no time to tip is stuck where the goal asks for tipping") {
  feeder::FeederSpec spec = feeder_spec(flat_part(el_outline(), true), {gap(11)}, 40);
  spec.environment.conveying_speed_mm_s = 400;
  spec.goal.require_tip = true;
  const feeder::FeederProblem problem(spec);
  const StageResult result = problem.staged()->pass(0, {});
  const feeder::FeederEvaluation whole = problem.evaluate(0, {});
  int stuck = 0;
  for (std::size_t i = 0; i < whole.poses.size(); ++i) {
    const feeder::PoseResult& pose = whole.poses[i];
    if (pose.outcome != feeder::Outcome::Rejected) continue;
    const bool in_time = !pose.unsupported_mm || !pose.tip_mm || *pose.unsupported_mm >= *pose.tip_mm;
    CHECK((result.ends[i].to == kLostState) == in_time);
    stuck += !in_time;
  }
  CHECK(stuck > 0);
}
