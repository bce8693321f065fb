#include "applications/feeder/passages.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>

#include "io/problem_file.hpp"
#include "witness/feeder_specs.hpp"

using namespace formotion;
using namespace formotion::witness;

namespace {

feeder::FeederSpec shipped(const std::string& name) {
  return read_problem_file(FORMOTION_SOURCE_DIR "/problems/feeder/" + name + ".json").feeder;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

struct Work {
  std::int64_t without = 0, with = 0;
  int feasible = 0;
};

// Scores candidates of one topology, each another coordinate away from the one before it, with a memory and without.
Work walk(const feeder::FeederSpec& spec, int topology, std::vector<double> start, int candidates, std::uint64_t seed) {
  const feeder::FeederProblem problem(spec);
  const auto memory = problem.memory();
  REQUIRE(memory);
  Random random(seed);
  const std::vector<int>& used = problem.topologies()[topology].variables;
  Work work;
  for (int i = 0; i < candidates; ++i) {
    const Candidate candidate{topology, start};
    const Score without = problem.score(candidate), with = problem.score(candidate, memory.get());
    CHECK(without.feasible == with.feasible);
    CHECK(same_bits({without.violation}, {with.violation}));
    CHECK(same_bits(without.objectives, with.objectives));
    CHECK(with.work <= without.work);
    work.without += without.work;
    work.with += with.work;
    work.feasible += with.feasible;
    std::vector<double> next = start;
    const std::size_t k = static_cast<std::size_t>(below(random, static_cast<int>(used.size())));
    const Variable& variable = problem.variables()[used[k]];
    next[k] = std::clamp(next[k] + uniform(random, -0.5, 0.5), variable.min, variable.max);
    if (below(random, 4) || with.feasible) start = next;
  }
  return work;
}

}  // namespace

TEST_CASE("a score has the same bits with a memory and without and takes no more work") {
  // A balcony and a cut-out that work on the el bracket, and from there one coordinate at a time.
  const Work cut = walk(shipped("el_bracket"), 1, {8.65, 0.1, 0.1, 0.1, 44.9, 21.9, 8.9}, 1200, 1);
  CHECK(cut.with < 0.8 * cut.without);
  const Work plate = walk(shipped("plate_with_hole"), 1, {14, 3, 6, 20}, 400, 2);
  CHECK(plate.with < 0.8 * plate.without);
  const Work scallops = walk(shipped("plate_with_hole"), 2, {14, 30, 45}, 400, 3);
  CHECK(scallops.with <= scallops.without);
  CHECK(cut.feasible + plate.feasible + scallops.feasible > 100);
}

TEST_CASE("the largest error that a pose bears does not depend on what was asked before") {
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    Random random(seed);
    const feeder::FeederSpec spec = random_feeder(random);
    const feeder::PartModel part = feeder::part_model(spec.part, spec.environment, {});
    const feeder::Layout layout =
        feeder::lay_out(spec.designs[0], spec.environment, spec.manufacture, part.diameter_mm, {});
    for (const feeder::VoidGroup& group : feeder::grouped_in_own_frames(layout, part.longest_mm)) {
      const std::vector<Interval> held;
      for (const feeder::PoseModel& pose : part.poses) {
        std::int64_t sweeps = 0;
        const double margin = least_margin({pose.travelling, VoidOutline::of(group.loops), held}).margin_mm;
        const bool kept = margin > 0;
        const double most = std::abs(margin);
        const feeder::GroupTravel travel{pose, group.loops, held};
        const double at_once = feeder::EdgeError(travel, kept, most).largest(sweeps);
        feeder::EdgeError asked(travel, kept, most);
        for (int i = 0; i < 5; ++i) {
          const double e = uniform(random, 0, 1.1 * most);
          CHECK(asked.bears(e, sweeps) == (e <= at_once));
        }
        CHECK(same_bits({asked.largest(sweeps)}, {at_once}));
        ++compared;
      }
    }
  }
  CHECK(compared > 100);
}

TEST_CASE("a feature that stands clear of others is the same loops wherever it stands") {
  const feeder::FeederSpec spec =
      feeder_spec(flat_part(el_outline(), true), {balcony(8.123, 60.7), cutout({{0.1, 5}, {20.3, 5}, {10.7, 30}})}, 40);
  const feeder::PartModel part = feeder::part_model(spec.part, spec.environment, {});
  const auto groups_of = [&](const feeder::DesignSpec& design) {
    return feeder::grouped_in_own_frames(
        feeder::lay_out(design, spec.environment, spec.manufacture, part.diameter_mm, {}), part.longest_mm);
  };
  const auto both = groups_of(spec.designs[0]), alone = groups_of({spec.designs[0][1]});
  REQUIRE(both.size() == 2);
  CHECK(both[1].origin_mm > 60);
  for (std::size_t i = 0; i < 3; ++i) CHECK(both[1].loops[0][i] == alone[0].loops[0][i]);
}
