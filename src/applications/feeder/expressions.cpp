#include "applications/feeder/expressions.hpp"

#include <algorithm>

namespace formotion::feeder {
namespace {

void collect(const Affine& expression, std::vector<int>& used) {
  for (const auto& [index, coefficient] : expression.terms) {
    if (coefficient != 0) used.push_back(index);
  }
}
void collect(const AffineLoop& loop, std::vector<int>& used) {
  for (const AffinePoint& p : loop) {
    collect(p[0], used);
    collect(p[1], used);
  }
}
std::vector<int> ascending(std::vector<int> indices) {
  std::sort(indices.begin(), indices.end());
  indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
  return indices;
}

std::size_t corners_of(const FeatureSpec& feature) {
  const auto* cutout = std::get_if<Cutout>(&feature.shape);
  return cutout ? cutout->polygon_mm.size() : 0;
}

bool cutouts_differ(const std::vector<DesignSpec>& designs) {
  std::size_t known = 0;
  for (const DesignSpec& design : designs) {
    for (const FeatureSpec& feature : design) {
      const std::size_t corners = corners_of(feature);
      if (corners != 0 && known != 0 && corners != known) return true;
      known = std::max(known, corners);
    }
  }
  return false;
}

}  // namespace

std::vector<int> variables_of(const PartSpec& part) {
  std::vector<int> used;
  for (const AspectSpec& aspect : part.aspects) {
    collect(aspect.outline_mm, used);
    for (const AffineLoop& hole : aspect.holes_mm) collect(hole, used);
    for (const LayerSpec& layer : aspect.layers) {
      collect(layer.outline_mm, used);
      for (const AffineLoop& hole : layer.holes_mm) collect(hole, used);
    }
  }
  return ascending(std::move(used));
}

std::vector<int> variables_of(const FeatureSpec& feature) {
  FeatureSpec copy = feature;  // the visitor may change what it visits
  std::vector<int> used;
  Expressions::each(copy, [&](Affine& expression) { collect(expression, used); });
  return ascending(std::move(used));
}

std::vector<Topology> topologies_of(const FeederSpec& spec) {
  const std::vector<int> of_part = variables_of(spec.part);
  const bool by_corners = cutouts_differ(spec.designs);
  std::vector<Topology> topologies;
  for (const DesignSpec& design : spec.designs) {
    Topology topology;
    topology.variables = of_part;
    for (const FeatureSpec& feature : design) {
      const std::vector<int> used = variables_of(feature);
      topology.variables.insert(topology.variables.end(), used.begin(), used.end());
      topology.label += (topology.label.empty() ? "" : " + ") + type_name(feature);
      if (const std::size_t corners = corners_of(feature); by_corners && corners != 0)
        topology.label += "(" + std::to_string(corners) + ")";
    }
    topology.variables = ascending(std::move(topology.variables));
    topologies.push_back(std::move(topology));
  }
  return topologies;
}

FeatureSpec literal(FeatureSpec feature, std::span<const double> values) {
  Expressions::each(feature, [&](Affine& expression) { expression = {expression(values), {}}; });
  return feature;
}

}  // namespace formotion::feeder
