#include "applications/feeder/stage_kinds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "applications/feeder/expressions.hpp"
#include "applications/feeder/turning_track.hpp"

namespace formotion::feeder {
namespace {

bool has_obstacles(const FeatureSpec& feature) {
  if (const auto* drawing = std::get_if<Drawing>(&feature.shape)) return !drawing->walls_mm.empty();
  return std::holds_alternative<Fence>(feature.shape) || std::holds_alternative<WallProfile>(feature.shape) ||
         std::holds_alternative<Pin>(feature.shape);
}

double least(const Affine& expression, const std::vector<Variable>& variables) {
  double value = expression.constant;
  for (const auto& [index, coefficient] : expression.terms) {
    value += std::min(coefficient * variables[index].min, coefficient * variables[index].max);
  }
  return value;
}

// The least x, from its start, at which the feature can act.
struct LeastX {
  const std::vector<Variable>& variables;
  double operator()(const Cutout& f) const { return of(f.polygon_mm); }
  double operator()(const Fence& f) const { return of(f.polygon_mm); }
  double operator()(const WallProfile& f) const { return of(f.profile_mm); }
  double operator()(const Pin& f) const {
    Affine edge = f.x_mm;
    edge.constant -= 0.5 * f.diameter_mm.constant;
    for (const auto& [index, coefficient] : f.diameter_mm.terms) edge.terms.emplace_back(index, -0.5 * coefficient);
    return least(edge, variables);
  }
  double operator()(const Drawing& f) const {
    double x = std::numeric_limits<double>::infinity();
    for (const std::vector<Loop>* loops : {&f.voids_mm, &f.walls_mm}) {
      for (const Loop& loop : *loops) x = std::min(x, bounding_box(loop).min.x());
    }
    return x;
  }
  double operator()(const auto&) const { return 0; }
  double of(const AffineLoop& loop) const {
    double x = std::numeric_limits<double>::infinity();
    for (const AffinePoint& p : loop) x = std::min(x, least(p[0], variables));
    return x;
  }
};

bool composes(const FeederSpec& spec, const PartModel& part, const DesignSpec& design) {
  const bool turns = std::any_of(design.begin(), design.end(), [](const FeatureSpec& f) { return has_obstacles(f); });
  if (design.empty() || (turns && is_belt(spec.environment))) return false;
  // Parts that turn may be as long as they are wide.
  const double reach = turns ? part.diameter_mm : part.longest_mm;
  const double spacing = spec.environment.spacing_mm.value_or(part.diameter_mm);
  std::vector<int> used;
  for (std::size_t i = 0; i < design.size(); ++i) {
    if (design[i].at_mm) return false;
    const double ahead = std::min(0.0, std::visit(LeastX{spec.variables}, design[i].shape));
    if (i > 0 && spacing + ahead < reach) return false;
    for (const int variable : variables_of(design[i])) {
      if (std::find(used.begin(), used.end(), variable) != used.end()) return false;
      used.push_back(variable);
    }
  }
  return true;
}

// The feature in variables of its own, numbered as they come; which of the problem's they are.
struct Renamed {
  FeatureSpec feature;
  std::vector<int> variables;
};
Renamed renamed(FeatureSpec feature) {
  Renamed result;
  Expressions::each(feature, [&](Affine& expression) {
    std::erase_if(expression.terms, [](const auto& term) { return term.second == 0; });
    for (auto& [index, coefficient] : expression.terms) {
      const auto known = std::find(result.variables.begin(), result.variables.end(), index);
      const auto number = known - result.variables.begin();
      if (known == result.variables.end()) result.variables.push_back(index);
      index = static_cast<int>(number);
    }
    std::sort(expression.terms.begin(), expression.terms.end());
  });
  result.feature = std::move(feature);
  return result;
}

// Equal for features of one kind.
std::vector<double> key_of(const Renamed& renamed, const std::vector<Variable>& variables) {
  std::vector<double> key{static_cast<double>(renamed.feature.shape.index())};
  FeatureSpec feature = renamed.feature;  // the visitor may change what it visits
  Expressions::each(feature, [&](Affine& expression) {
    key.push_back(expression.constant);
    key.push_back(static_cast<double>(expression.terms.size()));
    for (const auto& [index, coefficient] : expression.terms) {
      key.push_back(index);
      key.push_back(coefficient);
    }
  });
  for (const int index : renamed.variables) {
    const Variable& variable = variables[index];
    key.insert(key.end(), {variable.min, variable.max, variable.start()});
  }
  if (const auto* drawing = std::get_if<Drawing>(&feature.shape)) {
    for (const std::vector<Loop>* loops : {&drawing->voids_mm, &drawing->walls_mm}) {
      key.push_back(static_cast<double>(loops->size()));
      for (const Loop& loop : *loops) {
        key.push_back(static_cast<double>(loop.size()));
        for (const Point& p : loop) key.insert(key.end(), {p.x(), p.y()});
      }
    }
  }
  return key;
}

// Cut-outs of different numbers of corners are told apart.
void label_kinds(std::vector<FeatureKind>& kinds) {
  std::vector<std::size_t> counts;
  for (const FeatureKind& kind : kinds) {
    if (const auto* cutout = std::get_if<Cutout>(&kind.feature.shape)) counts.push_back(cutout->polygon_mm.size());
  }
  const bool differ = std::any_of(counts.begin(), counts.end(), [&](std::size_t n) { return n != counts.front(); });
  for (FeatureKind& kind : kinds) {
    kind.stage.label = type_name(kind.feature);
    const auto* cutout = std::get_if<Cutout>(&kind.feature.shape);
    if (cutout && differ) kind.stage.label += "(" + std::to_string(cutout->polygon_mm.size()) + ")";
  }
}

// How far the ends of expressions move.
struct Displacement {
  std::span<const double> half_widths;
  using Bound = std::optional<double>;

  double of(const Affine& expression) const {
    double moves = 0;
    for (const auto& [index, coefficient] : expression.terms) moves += std::abs(coefficient) * half_widths[index];
    return moves;
  }
  Bound operator()(const Balcony& f) const { return std::hypot(of(f.width_mm), of(f.length_mm)); }
  Bound operator()(const Gap& f) const { return of(f.length_mm); }
  Bound operator()(const Canyon& f) const { return band(f); }
  Bound operator()(const Slot& f) const { return band(f); }
  Bound operator()(const Cutout& f) const {
    double most = 0;
    for (const AffinePoint& p : f.polygon_mm) most = std::max(most, std::hypot(of(p[0]), of(p[1])));
    return most;
  }
  Bound operator()(const Wiper& f) const { return of(f.height_mm); }
  Bound operator()(const Drawing& f) const { return f.walls_mm.empty() ? Bound(0) : std::nullopt; }
  Bound operator()(const auto&) const { return std::nullopt; }
  template <class Band>
  Bound band(const Band& f) const {
    return std::hypot(std::max(of(f.from_mm), of(f.to_mm)), of(f.length_mm));
  }
};

}  // namespace

StageCatalogue stage_catalogue(const FeederSpec& spec, const PartModel& part) {
  StageCatalogue catalogue;
  std::map<std::vector<double>, int> known;
  const std::vector<Topology> topologies = topologies_of(spec);
  for (std::size_t t = 0; t < topologies.size(); ++t) {
    std::vector<StageUse>& stages = catalogue.stages.emplace_back();
    if (!composes(spec, part, spec.designs[t])) continue;
    for (const FeatureSpec& feature : spec.designs[t]) {
      Renamed own = renamed(feature);
      const auto [kind, is_new] =
          known.try_emplace(key_of(own, spec.variables), static_cast<int>(catalogue.kinds.size()));
      StageUse use{kind->second, {}};
      const std::vector<int>& of_topology = topologies[t].variables;
      for (const int variable : own.variables) {
        const auto place = std::lower_bound(of_topology.begin(), of_topology.end(), variable);
        use.values.push_back(static_cast<int>(place - of_topology.begin()));
      }
      stages.push_back(std::move(use));
      if (!is_new) continue;
      StageKind stage;
      for (const int variable : own.variables) stage.variables.push_back(spec.variables[variable]);
      stage.passive = !has_obstacles(feature);
      catalogue.kinds.push_back({std::move(own.feature), std::move(stage)});
    }
  }
  label_kinds(catalogue.kinds);
  return catalogue;
}

std::optional<double> displacement_mm(const FeatureSpec& feature, const Manufacture& manufacture,
                                      std::span<const double> half_widths) {
  const std::optional<double> moves = std::visit(Displacement{half_widths}, feature.shape);
  const bool blade = std::holds_alternative<Wiper>(feature.shape);
  const bool rounded = manufacture.cutter_radius_mm && *manufacture.cutter_radius_mm > 0;
  if (rounded && !blade && moves != 0) return std::nullopt;
  return moves;
}

}  // namespace formotion::feeder
