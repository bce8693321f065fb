// The topology grammar: all short sequences of a catalogue of features, as topologies whose numbers are variables
// f0.width_mm, f1.length_mm, ... with bounds from the part's size.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "applications/feeder/spec.hpp"

namespace formotion::feeder {

inline constexpr std::int64_t kMostTopologies = 20000;

// What a place in a sequence can be: a type of feature, of cut-outs with a number of corners.
struct GrammarKind {
  std::string type;
  int corners = 0;  // of cut-outs: 3 to 6
  bool operator==(const GrammarKind&) const = default;
};

// What a catalogue may name: types, and "cutout3" to "cutout6" for cut-outs of so many corners.
const std::vector<std::string>& catalogue_names();
// "cutout" stands for all four numbers of corners.
std::vector<GrammarKind> kinds_of(const std::vector<std::string>& catalogue);
// How long a balcony or a canyon is, so that every pose is once wholly over it, also with its ends off by some mm.
double long_mm(double longest_pose_mm);
// Of all sequences of the grammar, pruned or not: "f0.width_mm", ..., by place, then in the catalogue's order.
std::vector<std::string> variable_names(const GrammarSpec& grammar);

// What is wrong with a grammar, for an input error.
struct GrammarDefect {
  std::string key;  // of the grammar: "features", "max_features"
  std::string found, expected;
};

// Fills designs (short sequences first, then in the catalogue's order), appends the variables that they use and that
// the specification does not state, and says what is pruned. Everything but the designs must be complete. A part with
// variables is measured at their starting values.
std::optional<GrammarDefect> expand_grammar(FeederSpec& spec);

}  // namespace formotion::feeder
