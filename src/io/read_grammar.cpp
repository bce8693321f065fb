// The key "grammar": a catalogue of features in place of designs.
#include <algorithm>
#include <cmath>

#include "applications/feeder/grammar.hpp"
#include "io/problem_reader.hpp"
#include "io/suggestion.hpp"

namespace formotion {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kMostFeatures = 12;

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

void read_catalogue(const Json& value, feeder::GrammarSpec& grammar, IssueList& issues) {
  const std::string pointer = "/grammar/features";
  const std::vector<std::string>& known = feeder::catalogue_names();
  if (!value.is_array() || value.empty()) {
    issues.add(pointer, described(value), "an array of features' types: " + listed(known));
    return;
  }
  for (std::size_t i = 0; i < value.size(); ++i) {
    const std::string at = pointer + "/" + std::to_string(i);
    const auto name = read_string(value[i], at, issues);
    if (!name) continue;
    if (std::find(known.begin(), known.end(), *name) == known.end()) {
      const std::string found = *name == "drawing" ? "a drawing, which has no numbers to search"
                                                   : "the unknown type '" + *name + "'" + did_you_mean(*name, known);
      issues.add(at, found, "one of " + listed(known));
      continue;
    }
    const std::vector<feeder::GrammarKind> before = feeder::kinds_of(grammar.features);
    for (const feeder::GrammarKind& kind : feeder::kinds_of({*name})) {
      if (std::find(before.begin(), before.end(), kind) == before.end()) continue;
      issues.add(at, "'" + *name + "' again", "each kind of feature once ('cutout' stands for cutout3 to cutout6)");
      break;
    }
    grammar.features.push_back(*name);
  }
}

}  // namespace

feeder::GrammarSpec read_grammar(const Json& value, ReadContext& context) {
  feeder::GrammarSpec grammar;
  ObjectReader object(value, "/grammar", context.issues);
  if (const Json* features = object.require("features", "an array of features' types"))
    read_catalogue(*features, grammar, context.issues);
  const std::string expected = "a whole number from 1 to " + std::to_string(kMostFeatures);
  if (const Json* most = object.require("max_features", expected)) {
    const double number = most->is_number() ? most->get<double>() : 0;
    if (number >= 1 && number <= kMostFeatures && number == std::floor(number)) {
      grammar.max_features = static_cast<int>(number);
    } else {
      context.issues.add(object.at("max_features"), described(*most), expected);
    }
  }
  object.finish();
  return grammar;
}

void expand_grammar(feeder::FeederSpec& spec, IssueList& issues) {
  if (const auto defect = feeder::expand_grammar(spec))
    issues.add("/grammar/" + defect->key, defect->found, defect->expected);
}

}  // namespace formotion
