#include "applications/feeder/pruning.hpp"

#include <catch2/catch.hpp>
#include <numbers>

#include "witness/feeder_specs.hpp"

using namespace formotion;
using namespace formotion::witness;

namespace {

const std::vector<std::string> kPassive{"balcony",  "gap",     "canyon", "slot",     "cutout3",
                                        "dish-out", "scallop", "wiper",  "hold-down"};

feeder::FeederSpec with_grammar(feeder::PartSpec part, std::vector<std::string> features, int max_features) {
  feeder::FeederSpec spec = feeder_spec(std::move(part), {}, 60);
  spec.designs.clear();
  spec.grammar = feeder::GrammarSpec{std::move(features), max_features, 0, {}};
  return spec;
}

void aim_at(feeder::FeederSpec& spec, const std::string& aspect, double orientation_deg) {
  spec.goal = {};
  spec.goal.aspect = aspect;
  spec.goal.orientation_rad = orientation_deg * std::numbers::pi / 180;
}

bool prunes(const feeder::FeederSpec& spec, const std::vector<std::string>& sequence) {
  std::vector<feeder::GrammarKind> kinds;
  std::vector<int> places;
  for (const std::string& name : sequence) {
    places.push_back(static_cast<int>(kinds.size()));
    kinds.push_back(feeder::kinds_of({name}).front());
  }
  return feeder::Pruning(spec, kinds).prunes(places);
}

// The grammar's topologies with none left out.
feeder::FeederSpec expanded_wholly(feeder::FeederSpec spec) {
  const feeder::PartSpec part = spec.part;
  spec.variables = {{"nothing", 0, 0, std::nullopt}};  // nothing is pruned of a part with a variable
  spec.part.aspects[0].outline_mm[0][0].terms = {{0, 1.0}};
  REQUIRE_FALSE(expand_grammar(spec));
  spec.part = part;
  return spec;
}

// El, L, triangles, quadrilaterals and stars, one face or two, or blocks of two heights.
feeder::PartSpec random_part(Random& random) {
  switch (below(random, 5)) {
    case 0:
      return block();
    case 1:
      return flat_part(el_outline(), below(random, 2) == 0);
    case 2:
      return flat_part(bibazu_l(), below(random, 2) == 0);
    default:
      return flat_part(random_polygon(random, 25).outer, below(random, 2) == 0);
  }
}

}  // namespace

TEST_CASE("no design of a pruned topology is feasible: 4000 random ones") {
  int tried = 0, delivering = 0, feasible_elsewhere = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Random random(seed);
    feeder::FeederSpec spec = with_grammar(random_part(random), kPassive, 2);
    if (below(random, 3) == 0) spec.environment.tilt_rad = 0.1;
    if (below(random, 4) == 0) spec.environment.settling_friction = 0.5;
    spec.objectives = {feeder::known_objectives()[0]};
    const feeder::PartModel part = part_model(spec.part, spec.environment, {});
    if (part.poses.size() < 2) continue;
    if (below(random, 2) == 0) {
      const feeder::StablePose& goal =
          part.poses[static_cast<std::size_t>(below(random, static_cast<int>(part.poses.size())))].stable;
      spec.goal = {};
      spec.goal.aspect = below(random, 4) == 0 ? "any" : part.shapes[static_cast<std::size_t>(goal.aspect)].name;
      spec.goal.orientation_rad = goal.orientation_rad;
    }
    const feeder::FeederProblem problem(expanded_wholly(spec));
    const std::vector<feeder::GrammarKind> kinds = feeder::kinds_of(kPassive);
    const int n = static_cast<int>(kinds.size());
    feeder::Pruning pruning(problem.spec(), kinds);
    for (int i = 0; i < 200; ++i) {
      const int topology = below(random, static_cast<int>(problem.topologies().size()));
      const std::vector<int> sequence =
          topology < n ? std::vector<int>{topology} : std::vector<int>{(topology - n) / n, (topology - n) % n};
      const bool pruned = pruning.prunes(sequence);
      if (!pruned && i % 4 != 0) continue;
      Candidate candidate{topology, {}};
      for (const int v : problem.topologies()[static_cast<std::size_t>(topology)].variables) {
        const Variable& variable = problem.variables()[static_cast<std::size_t>(v)];
        candidate.values.push_back(uniform(random, variable.min, variable.max));
      }
      const Score score = problem.score(candidate);
      CAPTURE(seed, problem.topologies()[static_cast<std::size_t>(topology)].label, candidate.values);
      if (pruned) {
        REQUIRE_FALSE(score.feasible);
        delivering += score.objectives[0] > 0;
        ++tried;
      } else {
        feasible_elsewhere += score.feasible;
      }
    }
  }
  CHECK(tried >= 4000);
  CHECK(delivering > 500);
  CHECK(feasible_elsewhere > 20);
}

TEST_CASE("symmetric voids are pruned for a part that comes with its mirror image and only then") {
  const feeder::FeederSpec flips = with_grammar(flat_part(el_outline(), true), {"gap"}, 2);
  for (const std::string type : {"balcony", "gap", "canyon", "slot", "dish-out", "scallop"}) {
    CHECK(prunes(flips, {type}));
    CHECK(prunes(flips, {type, "slot"}));
    CHECK(prunes(flips, {type, "wiper"}));  // both faces are as tall
    CHECK_FALSE(prunes(flips, {type, "cutout3"}));
    CHECK_FALSE(prunes(flips, {type, "fence"}));
    CHECK_FALSE(prunes(flips, {type, "pin"}));
  }
  CHECK_FALSE(prunes(flips, {"cutout3"}));

  feeder::FeederSpec one_face = with_grammar(flat_part(el_outline(), false), {"gap"}, 2);
  CHECK_FALSE(prunes(one_face, {"slot"}));
  feeder::FeederSpec either = flips;
  aim_at(either, "any", 0);
  CHECK_FALSE(prunes(either, {"slot"}));  // the mirror image is the goal, too
  aim_at(either, "up", 0);
  CHECK(prunes(either, {"slot"}));

  // Features that may act at the same time.
  feeder::FeederSpec near = flips;
  near.environment.spacing_mm = 20;
  CHECK(prunes(near, {"slot"}));
  CHECK_FALSE(prunes(near, {"slot", "slot"}));

  // Faces of other centres of mass, heights, or of another shape.
  feeder::FeederSpec heavier = flips;
  heavier.part.aspects[1].com_mm = Point(-12, 7);
  CHECK_FALSE(prunes(heavier, {"slot"}));
  feeder::FeederSpec taller = flips;
  taller.part.aspects[1].height_mm = 4;
  aim_at(taller, "up", 0);
  CHECK(prunes(taller, {"slot"}));
  CHECK_FALSE(prunes(taller, {"slot", "wiper"}));
  taller.environment.tilt_rad = 0.1;  // the supported points differ
  CHECK_FALSE(prunes(taller, {"slot"}));

  // A triangle's poses on its two legs are each other's mirror images, the one on its base is its own.
  feeder::FeederSpec triangle = with_grammar(flat_part({{0, 0}, {30, 0}, {15, 20}}, false), {"gap"}, 1);
  CHECK_FALSE(prunes(triangle, {"slot"}));
  aim_at(triangle, "up", 0);
  CHECK_FALSE(prunes(triangle, {"slot"}));
  const feeder::PartModel part = part_model(triangle.part, triangle.environment, {});
  REQUIRE(part.poses.size() == 3);
  triangle.goal.orientation_rad = part.poses[1].stable.orientation_rad;
  CHECK(prunes(triangle, {"slot"}));
}

TEST_CASE("friction that leaves one of two mirror poses makes them separable") {
  feeder::FeederSpec spec = with_grammar(flat_part(bibazu_l(), true), {"gap"}, 1);
  CHECK(prunes(spec, {"slot"}));
  spec.environment.settling_friction = 0.8;  // leans against the feed on either face
  CHECK_FALSE(prunes(spec, {"slot"}));
}

TEST_CASE("the two faces of a part that is its own mirror image are told apart by nothing passive") {
  feeder::FeederSpec spec = with_grammar(flat_part({{0, 0}, {30, 0}, {15, 20}}, true), {"gap"}, 1);
  for (const std::string type : {"slot", "cutout3", "cutout6", "wiper"}) CHECK(prunes(spec, {type}));
  CHECK_FALSE(prunes(spec, {"fence"}));
  aim_at(spec, "any", 0);
  CHECK_FALSE(prunes(spec, {"cutout3"}));
}

TEST_CASE("a wiper keeps no taller pose than it rejects and a rail rejects none") {
  feeder::FeederSpec spec = with_grammar(block(), {"wiper"}, 1);
  aim_at(spec, "flat", 0);
  const feeder::PartModel part = part_model(spec.part, spec.environment, {});
  REQUIRE(part.poses.size() >= 2);
  CHECK(prunes(spec, {"wiper"}));  // the flat block lies on two edges, both as tall
  // A square block has one flat pose.
  spec.part.aspects[0].outline_mm = literal(Loop{{0, 0}, {20, 0}, {20, 20}, {0, 20}});
  spec.part.aspects[1].outline_mm = literal(Loop{{0, 0}, {20, 0}, {20, 19.9}, {0, 19.9}});
  spec.part.aspects[1].height_mm = 20;
  aim_at(spec, spec.part.aspects[0].name, 0);
  CHECK_FALSE(prunes(spec, {"wiper"}));
  CHECK(prunes(spec, {"hold-down"}));
  aim_at(spec, spec.part.aspects[1].name, 0);
  CHECK(prunes(spec, {"wiper"}));
}

TEST_CASE("a balcony cannot keep the pose that needs most width alone nor a gap the one that bears least") {
  // Windows in closed form: docs/feeder.md.
  feeder::FeederSpec spec = with_grammar(flat_part(bibazu_l(), false), {"gap"}, 1);
  const feeder::PartModel part = part_model(spec.part, spec.environment, {});
  REQUIRE(part.poses.size() == 3);  // at 34.8, 180 and 270 degrees
  const auto aim = [&](std::size_t pose) {
    aim_at(spec, "up", 0);
    spec.goal.orientation_rad = part.poses[pose].stable.orientation_rad;
  };
  aim(1);  // alone from 10.404 to 14.087 mm
  CHECK_FALSE(prunes(spec, {"balcony"}));
  CHECK(prunes(spec, {"gap"}));
  aim(0);  // alone from 10.451 to 20.046 mm
  CHECK(prunes(spec, {"balcony"}));
  CHECK_FALSE(prunes(spec, {"gap"}));
  aim(2);
  CHECK(prunes(spec, {"balcony"}));
  CHECK_FALSE(prunes(spec, {"balcony", "slot"}));
}

TEST_CASE("a part with one pose needs no feature and nothing is pruned") {
  feeder::FeederSpec spec = with_grammar(flat_part({{0, 0}, {20, 0}, {20, 20}, {0, 20}}, false), {"gap"}, 1);
  for (const std::string& type : kPassive) CHECK_FALSE(prunes(spec, {type}));
}

TEST_CASE("what is pruned is told by its laws and helpful features are those that are not pruned") {
  feeder::FeederSpec spec = with_grammar(flat_part(el_outline(), true), {"balcony", "slot"}, 2);
  const auto defect = expand_grammar(spec);
  REQUIRE(defect);
  REQUIRE(spec.grammar->pruned.size() == 1);
  CHECK(spec.grammar->pruned[0].count == 6);
  CHECK(spec.grammar->pruned[0].pattern == "only balcony and slot");
  CHECK(spec.grammar->pruned[0].reason.find("mirror images") != std::string::npos);
  CHECK(defect->expected == "one more feature: cutout, fence, wall or pin");
}
