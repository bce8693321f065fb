#include "applications/feeder/grammar.hpp"

#include <catch2/catch.hpp>
#include <set>

#include "applications/feeder/expressions.hpp"
#include "applications/feeder/part_model.hpp"
#include "applications/feeder/track_layout.hpp"
#include "witness/feeder_specs.hpp"

using namespace formotion;
using namespace formotion::witness;

namespace {

feeder::FeederSpec with_grammar(feeder::PartSpec part, std::vector<std::string> features, int max_features) {
  feeder::FeederSpec spec = feeder_spec(std::move(part), {}, 40);
  spec.designs.clear();
  spec.grammar = feeder::GrammarSpec{std::move(features), max_features, 0, {}};
  return spec;
}

feeder::FeederSpec el(std::vector<std::string> features, int max_features) {
  return with_grammar(flat_part(el_outline(), false), std::move(features), max_features);
}

std::vector<std::string> labels(const feeder::FeederSpec& spec) {
  std::vector<std::string> all;
  for (const Topology& topology : topologies_of(spec)) all.push_back(topology.label);
  return all;
}

const Variable& named(const feeder::FeederSpec& spec, const std::string& name) {
  for (const Variable& variable : spec.variables) {
    if (variable.name == name) return variable;
  }
  throw std::out_of_range(name);
}

}  // namespace

TEST_CASE("a grammar is all sequences of its kinds: short ones first and then in the catalogue's order") {
  feeder::FeederSpec spec = el({"slot", "fence"}, 2);
  REQUIRE_FALSE(expand_grammar(spec));
  CHECK(labels(spec) ==
        std::vector<std::string>{"slot", "fence", "slot + slot", "slot + fence", "fence + slot", "fence + fence"});
  CHECK(spec.grammar->sequences == 6);

  feeder::FeederSpec all = el({"balcony", "gap", "canyon", "slot", "cutout", "dish-out", "scallop", "wiper",
                               "hold-down", "fence", "wall", "pin"},
                              2);
  REQUIRE_FALSE(expand_grammar(all));
  CHECK(all.grammar->sequences == 15 + 15 * 15);
  std::int64_t pruned = 0;
  for (const auto& entry : all.grammar->pruned) pruned += entry.count;
  CHECK(pruned + static_cast<std::int64_t>(all.designs.size()) == all.grammar->sequences);
  const std::vector<std::string> names = labels(all);
  CHECK(std::set<std::string>(names.begin(), names.end()).size() == names.size());
}

TEST_CASE("cutout stands for polygons of three to six corners and cutout4 for those of four alone") {
  feeder::FeederSpec spec = el({"cutout"}, 1);
  REQUIRE_FALSE(expand_grammar(spec));
  CHECK(labels(spec) == std::vector<std::string>{"cutout(3)", "cutout(4)", "cutout(5)", "cutout(6)"});
  CHECK(topologies_of(spec)[1].variables.size() == 8);
  feeder::FeederSpec four = el({"cutout4"}, 1);
  REQUIRE_FALSE(expand_grammar(four));
  CHECK(labels(four) == std::vector<std::string>{"cutout"});
}

TEST_CASE("variables of a grammar are named by place and number and what the problem states is kept") {
  feeder::FeederSpec spec = el({"balcony", "gap", "cutout3"}, 2);
  spec.variables = {{"f1.width_mm", 8, 9, 8.5}};
  REQUIRE_FALSE(expand_grammar(spec));
  CHECK(named(spec, "f1.width_mm").min == 8);
  CHECK(named(spec, "f1.width_mm").max == 9);
  CHECK(named(spec, "f1.width_mm").value == 8.5);
  const std::vector<std::string> possible = variable_names(*spec.grammar);
  CHECK(possible.size() == 2 * (1 + 1 + 6));
  std::set<std::string> names;
  for (const Variable& variable : spec.variables) {
    CAPTURE(variable.name);
    CHECK(names.insert(variable.name).second);
    CHECK(std::find(possible.begin(), possible.end(), variable.name) != possible.end());
    REQUIRE(variable.value);
    CHECK(variable.min <= *variable.value);
    CHECK(*variable.value <= variable.max);
  }
  // The same number has the same bounds at every place.
  CHECK(named(spec, "f0.length_mm").max == named(spec, "f1.length_mm").max);
}

TEST_CASE("starting values of every kind of feature are possible shapes: long parts and short ones") {
  const std::vector<feeder::PartSpec> parts{flat_part(el_outline(), false), flat_part(bibazu_l(), false), block(),
                                            flat_part({{0, 0}, {3, 0}, {3, 1}, {0, 2}}, false)};
  for (const feeder::PartSpec& part : parts) {
    feeder::FeederSpec spec = with_grammar(part,
                                           {"balcony", "gap", "canyon", "slot", "cutout", "dish-out", "scallop",
                                            "wiper", "hold-down", "fence", "wall", "pin"},
                                           1);
    spec.variables = {{"nothing", 0, 0, std::nullopt}};  // a part with a variable: nothing is pruned
    spec.part.aspects[0].outline_mm[0][0].terms = {{0, 1.0}};
    REQUIRE_FALSE(expand_grammar(spec));
    std::vector<double> values;
    for (const Variable& variable : spec.variables) values.push_back(variable.start());
    const feeder::PartModel model = part_model(spec.part, spec.environment, values);
    REQUIRE(spec.designs.size() == 15);
    for (const feeder::DesignSpec& design : spec.designs) {
      const auto layout = lay_out(design, spec.environment, spec.manufacture, model.diameter_mm, values);
      CAPTURE(layout.features[0].type);
      for (const auto& violation : layout.invalid) UNSCOPED_INFO(violation.what);
      CHECK(layout.invalid.empty());
    }
  }
}

TEST_CASE("balconies and canyons are longer than every pose") {
  feeder::FeederSpec spec = with_grammar(flat_part(bibazu_l(), false), {"balcony", "canyon"}, 1);
  REQUIRE_FALSE(expand_grammar(spec));
  const feeder::PartModel model = part_model(spec.part, spec.environment, {});
  for (const feeder::DesignSpec& design : spec.designs) {
    const auto* balcony = std::get_if<feeder::Balcony>(&design[0].shape);
    const Affine& length = balcony ? balcony->length_mm : std::get<feeder::Canyon>(design[0].shape).length_mm;
    REQUIRE(length.is_literal());
    CHECK(length.constant >= model.longest_mm + 9);
  }
}

TEST_CASE("too many topologies are an error that says how many") {
  feeder::FeederSpec many = el({"fence", "wall", "pin", "cutout", "slot"}, 5);
  const auto defect = expand_grammar(many);
  REQUIRE(defect);
  CHECK(defect->key == "max_features");
  CHECK(defect->found.find("topologies") != std::string::npos);
  CHECK(defect->expected.find("20000") != std::string::npos);
  feeder::FeederSpec millions = el({"fence", "wall", "pin", "cutout", "slot"}, 12);
  REQUIRE(expand_grammar(millions));
}
