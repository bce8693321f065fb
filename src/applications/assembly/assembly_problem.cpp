#include "applications/assembly/assembly_problem.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "applications/assembly/judge.hpp"
#include "applications/assembly/residuals.hpp"
#include "applications/shared/judging.hpp"
#include "applications/shared/used_variables.hpp"

namespace formotion::assembly {
namespace {

std::vector<Topology> topologies_of(const AssemblySpec& spec) {
  std::vector<Topology> topologies;
  for (const DesignSpec& design : spec.designs) {
    std::set<int> used;
    collect(spec.part.outline_mm, used);
    for (const AffineLoop& hole : spec.part.holes_mm) collect(hole, used);
    for (const AffineLoop& loop : design.fixed_mm) collect(loop, used);
    if (design.chamfer_mm) collect(*design.chamfer_mm, used);
    for (const Number* number : {&spec.friction, &spec.support.kx, &spec.support.ky, &spec.support.ktheta})
      collect(number->value, used);
    for (const Affine& a : spec.support.centre_mm) collect(a, used);
    const std::size_t shapes = design.fixed_mm.size();
    topologies.push_back(
        {std::to_string(shapes) + (shapes == 1 ? " fixed shape" : " fixed shapes"), {used.begin(), used.end()}});
  }
  return topologies;
}

// Chamfers alone need no residuals. With dampers, whose histories are short, they are not worth what they cost
// (docs/assembly.md).
bool has_residuals(const AssemblySpec& spec) {
  if (spec.support.damper) return false;
  const auto is_force = [](const std::string& name) { return AssemblyResiduals::has(name) && name != "chamfer_mm"; };
  return std::any_of(spec.objectives.begin(), spec.objectives.end(),
                     [&](const Objective& o) { return is_force(o.name); }) ||
         std::any_of(spec.bounds.begin(), spec.bounds.end(), [&](const Bound& b) { return is_force(b.metric); });
}

}  // namespace

struct AssemblyProblem::Model {
  AssemblySpec spec;
  std::vector<Topology> topologies;
  std::unique_ptr<AssemblyResiduals> residuals;
};

AssemblyProblem::AssemblyProblem(AssemblySpec spec) : model_(std::make_unique<Model>()) {
  model_->topologies = topologies_of(spec);
  model_->spec = std::move(spec);
  if (has_residuals(model_->spec)) model_->residuals = std::make_unique<AssemblyResiduals>(*this);
}
AssemblyProblem::~AssemblyProblem() = default;

std::span<const Variable> AssemblyProblem::variables() const { return model_->spec.variables; }
std::span<const Topology> AssemblyProblem::topologies() const { return model_->topologies; }
std::span<const Objective> AssemblyProblem::objectives() const { return model_->spec.objectives; }
const AssemblySpec& AssemblyProblem::spec() const { return model_->spec; }

Score AssemblyProblem::score(const Candidate& candidate, Memory*) const {
  return score_of(model_->spec, judge(model_->spec, candidate.topology, all_values(*this, candidate), false),
                  objective);
}

const SmoothProblem* AssemblyProblem::smooth() const { return model_->residuals.get(); }

AssemblyEvaluation AssemblyProblem::evaluate(int topology, std::span<const double> values) const {
  return judge(model_->spec, topology, values, true).evaluation;
}

std::vector<Violation> AssemblyProblem::defects(int topology, std::span<const double> values) const {
  return assembly::defects(model_->spec, topology, values);
}

Joint AssemblyProblem::joint(int topology, std::span<const double> values) const {
  return joint_of(model_->spec, topology, values);
}

std::unique_ptr<Scene> AssemblyProblem::scene(int topology, std::span<const double> values, const std::string& aspect,
                                              double orientation_rad) const {
  if (!defects(topology, values).empty()) throw std::logic_error("a scene of shapes that are not valid");
  return scene_of(model_->spec, topology, values, aspect, orientation_rad);
}

DesignSpec AssemblyProblem::literal_design(int topology, std::span<const double> values) const {
  const DesignSpec& design = model_->spec.designs[topology];
  DesignSpec literal_one;
  for (const AffineLoop& loop : design.fixed_mm) literal_one.fixed_mm.push_back(literal_loop(loop, values));
  if (design.chamfer_mm) literal_one.chamfer_mm = Affine{(*design.chamfer_mm)(values), {}};
  return literal_one;
}

}  // namespace formotion::assembly
