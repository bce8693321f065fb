#include "applications/feeder/grammar.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "applications/feeder/part_model.hpp"
#include "applications/feeder/pruning.hpp"

namespace formotion::feeder {
namespace {

constexpr std::int64_t kMostSequences = 1000000;  // before pruning: more are not even listed
constexpr int kFewestCorners = 3, kMostCorners = 6;
constexpr double kBeyondPart_mm = 10;  // by how much balconies and canyons are longer than the part
constexpr double kFoot_mm = 2;         // how far a ramp's foot goes on behind the wall's face

// What bounds are made of.
struct Measures {
  double track_mm = 0;
  double diameter_mm = 0, longest_mm = 0, widest_mm = 0;  // widest: the largest extent of a pose across the track
  double least_com_mm = 0, most_com_mm = 0;               // heights of centres of mass over the wall
  double least_height_mm = 0, most_height_mm = 0;         // of aspects over the track
};

Measures measures_of(const FeederSpec& spec) {
  std::vector<double> values;
  for (const Variable& variable : spec.variables) values.push_back(variable.start());
  const PartModel part = part_model(spec.part, spec.environment, values);
  Measures m;
  m.track_mm = spec.environment.track_width_mm;
  m.diameter_mm = part.diameter_mm;
  m.longest_mm = part.poses.empty() ? part.diameter_mm : part.longest_mm;
  m.widest_mm = part.poses.empty() ? part.diameter_mm : 0;
  m.least_com_mm = part.poses.empty() ? 0 : part.diameter_mm;
  m.most_com_mm = part.poses.empty() ? part.diameter_mm : 0;
  for (const PoseModel& pose : part.poses) {
    for (const Polygon& body : pose.bodies) m.widest_mm = std::max(m.widest_mm, bounding_box(body.outer).max.y());
    m.least_com_mm = std::min(m.least_com_mm, pose.stable.com_wall_mm);
    m.most_com_mm = std::max(m.most_com_mm, pose.stable.com_wall_mm);
  }
  m.least_height_mm = m.most_height_mm = part.shapes.front().height_mm;
  for (const AspectShape& shape : part.shapes) {
    m.least_height_mm = std::min(m.least_height_mm, shape.height_mm);
    m.most_height_mm = std::max(m.most_height_mm, shape.height_mm);
  }
  return m;
}

// Bounds to a tenth of a millimetre, outwards; the start between them.
Variable variable(double min, double max, double start) {
  Variable v;
  v.min = std::floor(10 * min) / 10;
  v.max = std::max(std::ceil(10 * max) / 10, v.min);
  v.value = std::clamp(std::round(10 * start) / 10, v.min, v.max);
  return v;
}

// The default bounds of every number that a feature of the grammar may have. One name means the same for all types.
std::map<std::string, Variable> default_variables(const Measures& m) {
  const double on_track = std::min(m.track_mm, m.widest_mm);
  const double beyond = 0.1 * m.diameter_mm;  // past the edges that a void is open to
  const double between = 0.5 * (m.least_com_mm + m.most_com_mm);
  const double taller =
      m.least_height_mm < m.most_height_mm ? 0.5 * (m.least_height_mm + m.most_height_mm) : 1.25 * m.most_height_mm;
  std::map<std::string, Variable> known{
      {"width_mm", variable(0.5 * m.least_com_mm, on_track, between)},
      {"length_mm", variable(0, long_mm(m.longest_mm), 0.5 * m.longest_mm)},
      {"from_mm", variable(-beyond, on_track, 0.25 * on_track)},
      {"to_mm", variable(0, m.track_mm + beyond, 0.75 * on_track)},
      {"depth_mm", variable(0, m.track_mm, m.track_mm - between)},
      {"wider_mm", variable(0, 2 * m.longest_mm, m.longest_mm)},
      {"half_angle_deg", variable(5, 80, 30)},
      {"height_mm", variable(0.5 * m.least_height_mm, 1.5 * m.most_height_mm, taller)},
      {"run_mm", variable(0.5 * m.longest_mm, 3 * m.longest_mm, 2 * m.longest_mm)},
      {"rise_mm", variable(0, m.widest_mm, 0.7 * m.widest_mm)},
      {"drop_mm", variable(0, 0.25 * m.widest_mm, 0.1 * m.widest_mm)},
      {"back_mm", variable(0, 1.5 * m.longest_mm, 0.75 * m.longest_mm)},
      {"x_mm", variable(0, 2 * m.longest_mm, 0.5 * m.longest_mm)},
      {"y_mm", variable(0, m.widest_mm, 0.25 * m.widest_mm)},
      {"diameter_mm", variable(0.05 * m.diameter_mm, 0.3 * m.diameter_mm, 0.12 * m.diameter_mm)},
  };
  // Corners of a convex polygon in their order, so that the first three, four and five are convex, too.
  constexpr double kStart[kMostCorners][2] = {{0.25, 0.1}, {1.1, 0.35}, {0.9, 0.8}, {0.6, 1}, {0.3, 0.9}, {0.15, 0.5}};
  for (int i = 0; i < kMostCorners; ++i) {
    known["x" + std::to_string(i) + "_mm"] = variable(0, 2 * m.longest_mm, kStart[i][0] * m.longest_mm);
    known["y" + std::to_string(i) + "_mm"] = variable(-beyond, m.track_mm + beyond, kStart[i][1] * on_track);
  }
  return known;
}

Affine constant(double value) { return {value, {}}; }

Affine sum(Affine a, const Affine& b) {
  a.constant += b.constant;
  a.terms.insert(a.terms.end(), b.terms.begin(), b.terms.end());
  std::sort(a.terms.begin(), a.terms.end());
  return a;
}

Affine scaled(Affine a, double factor) {
  a.constant *= factor;
  for (auto& [index, coefficient] : a.terms) coefficient *= factor;
  return a;
}

// number: the variable of a feature's number, by the number's name.
FeatureSpec feature_of(const GrammarKind& kind, double longest_mm,
                       const std::function<Affine(const std::string&)>& number) {
  FeatureSpec feature;
  if (kind.type == "balcony") {
    feature.shape = Balcony{number("width_mm"), constant(long_mm(longest_mm))};
  } else if (kind.type == "gap") {
    feature.shape = Gap{number("length_mm")};
  } else if (kind.type == "canyon") {
    feature.shape = Canyon{number("from_mm"), number("to_mm"), constant(long_mm(longest_mm))};
  } else if (kind.type == "slot") {
    feature.shape = Slot{number("from_mm"), number("to_mm"), number("length_mm")};
  } else if (kind.type == "cutout") {
    Cutout cutout;
    for (int i = 0; i < kind.corners; ++i) {
      const std::string corner = std::to_string(i) + "_mm";
      cutout.polygon_mm.push_back({number("x" + corner), number("y" + corner)});
    }
    feature.shape = std::move(cutout);
  } else if (kind.type == "dish-out") {
    const Affine depth = number("depth_mm");  // an arc of a circle is at most half as deep as long
    feature.shape = DishOut{depth, sum(scaled(depth, 2), number("wider_mm"))};
  } else if (kind.type == "scallop") {
    feature.shape = Scallop{number("depth_mm"), scaled(number("half_angle_deg"), std::numbers::pi / 180)};
  } else if (kind.type == "wiper") {
    feature.shape = Wiper{number("height_mm")};
  } else if (kind.type == "hold-down") {
    feature.shape = HoldDown{number("height_mm"), number("length_mm")};
  } else if (kind.type == "fence") {  // a ramp: it rises from the wall and ends in a step
    const Affine run = number("run_mm"), foot = constant(-kFoot_mm);
    feature.shape = Fence{{{constant(0), foot}, {run, foot}, {run, number("rise_mm")}}};
  } else if (kind.type == "wall") {  // a recess: a step down, and a ramp back
    const Affine bottom = scaled(number("drop_mm"), -1), length = number("length_mm");
    feature.shape =
        WallProfile{{{constant(0), bottom}, {length, bottom}, {sum(length, number("back_mm")), constant(0)}}};
  } else {
    feature.shape = Pin{number("x_mm"), number("y_mm"), number("diameter_mm")};
  }
  return feature;
}

std::string variable_name(int place, const std::string& number) { return "f" + std::to_string(place) + "." + number; }

// Topologies being filled in from sequences.
class Expansion {
 public:
  explicit Expansion(FeederSpec& spec)
      : spec_(spec), measures_(measures_of(spec)), known_(default_variables(measures_)) {
    for (std::size_t i = 0; i < spec.variables.size(); ++i) indices_[spec.variables[i].name] = static_cast<int>(i);
  }

  void add(const std::vector<GrammarKind>& kinds, const std::vector<int>& sequence) {
    DesignSpec design;
    for (std::size_t place = 0; place < sequence.size(); ++place) {
      design.push_back(feature_of(kinds[static_cast<std::size_t>(sequence[place])], measures_.longest_mm,
                                  [&](const std::string& number) { return use(static_cast<int>(place), number); }));
    }
    spec_.designs.push_back(std::move(design));
  }

 private:
  Affine use(int place, const std::string& number) {
    const std::string name = variable_name(place, number);
    const auto [found, is_new] = indices_.try_emplace(name, static_cast<int>(spec_.variables.size()));
    if (is_new) {
      spec_.variables.push_back(known_.at(number));
      spec_.variables.back().name = name;
    }
    return {0, {{found->second, 1.0}}};
  }

  FeederSpec& spec_;
  Measures measures_;
  std::map<std::string, Variable> known_;
  std::map<std::string, int> indices_;
};

double sequence_count(std::size_t kinds, int max_features) {
  double count = 0, of_length = 1;
  for (int length = 1; length <= max_features; ++length) count += of_length *= static_cast<double>(kinds);
  return count;
}

// The next sequence of the same length, last place first; false after the last one.
bool next(std::vector<int>& sequence, int kinds) {
  for (std::size_t i = sequence.size(); i-- > 0;) {
    if (++sequence[i] < kinds) return true;
    sequence[i] = 0;
  }
  return false;
}

}  // namespace

const std::vector<std::string>& catalogue_names() {
  static const std::vector<std::string> kNames{"balcony",   "gap",     "canyon",  "slot",     "cutout",  "cutout3",
                                               "cutout4",   "cutout5", "cutout6", "dish-out", "scallop", "wiper",
                                               "hold-down", "fence",   "wall",    "pin"};
  return kNames;
}

double long_mm(double longest_pose_mm) { return std::ceil(longest_pose_mm) + kBeyondPart_mm; }

std::vector<GrammarKind> kinds_of(const std::vector<std::string>& catalogue) {
  std::vector<GrammarKind> kinds;
  for (const std::string& name : catalogue) {
    if (name.rfind("cutout", 0) != 0) {
      kinds.push_back({name, 0});
      continue;
    }
    for (int corners = kFewestCorners; corners <= kMostCorners; ++corners) {
      if (name == "cutout" || name == "cutout" + std::to_string(corners)) kinds.push_back({"cutout", corners});
    }
  }
  return kinds;
}

std::vector<std::string> variable_names(const GrammarSpec& grammar) {
  std::vector<std::string> names;
  for (int place = 0; place < grammar.max_features; ++place) {
    for (const GrammarKind& kind : kinds_of(grammar.features)) {
      feature_of(kind, 0, [&](const std::string& number) {
        const std::string name = variable_name(place, number);
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
        return constant(0);
      });
    }
  }
  return names;
}

std::optional<GrammarDefect> expand_grammar(FeederSpec& spec) {
  GrammarSpec& grammar = *spec.grammar;
  const std::vector<GrammarKind> kinds = kinds_of(grammar.features);
  const std::string fewer = "fewer features, or a smaller max_features";
  if (const double count = sequence_count(kinds.size(), grammar.max_features); count > kMostSequences) {
    return GrammarDefect{"max_features",
                         std::to_string(grammar.max_features) + " of " + std::to_string(kinds.size()) +
                             " kinds of features, more than a million sequences",
                         fewer};
  }
  Pruning pruning(spec, kinds);
  std::vector<std::vector<int>> kept;
  grammar.sequences = 0;
  for (int length = 1; length <= grammar.max_features; ++length) {
    std::vector<int> sequence(static_cast<std::size_t>(length), 0);
    do {
      ++grammar.sequences;
      if (!pruning.prunes(sequence)) kept.push_back(sequence);
    } while (next(sequence, static_cast<int>(kinds.size())));
  }
  grammar.pruned = pruning.found();
  if (static_cast<std::int64_t>(kept.size()) > kMostTopologies) {
    return GrammarDefect{
        "max_features",
        std::to_string(kept.size()) + " topologies (of " + std::to_string(grammar.sequences) + " sequences)",
        "at most " + std::to_string(kMostTopologies) + ": " + fewer};
  }
  if (kept.empty()) {
    const std::string help = helpful_features(spec, grammar);
    return GrammarDefect{
        "features", "features that cannot reach the goal: " + grammar.pruned.front().reason,
        help.empty() ? "a part and a goal that features can tell from the rest" : "one more feature: " + help};
  }
  Expansion expansion(spec);
  for (const std::vector<int>& sequence : kept) expansion.add(kinds, sequence);
  return std::nullopt;
}

}  // namespace formotion::feeder
