#include "applications/nest/nest_problem.hpp"

#include <algorithm>
#include <stdexcept>

#include "applications/nest/judge.hpp"
#include "applications/nest/scene.hpp"
#include "applications/shared/judging.hpp"
#include "applications/shared/used_variables.hpp"

namespace formotion::nest {
namespace {

std::vector<Topology> topologies_of(const NestSpec& spec) {
  std::vector<Topology> topologies;
  for (const DesignSpec& design : spec.designs) {
    std::set<int> used;
    collect(spec.part, used);
    for (const AffineLoop& loop : design.nest_mm) collect(loop, used);
    for (const Affine& a : spec.goal.seat.at_mm) collect(a, used);
    for (const Number* number : {&spec.environment.gravity_deg, &spec.environment.friction, &spec.environment.tilt_deg})
      collect(number->value, used);
    const std::size_t shapes = design.nest_mm.size();
    topologies.push_back({std::to_string(shapes) + (shapes == 1 ? " shape" : " shapes"), {used.begin(), used.end()}});
  }
  return topologies;
}

}  // namespace

const char* name(NestOutcome outcome) {
  switch (outcome) {
    case NestOutcome::Seated:
      return "seated";
    case NestOutcome::Misseated:
      return "misseated";
    case NestOutcome::Escaped:
      return "escaped";
    case NestOutcome::Blocked:
      return "blocked";
    case NestOutcome::Ambiguous:
      return "ambiguous";
    case NestOutcome::Undecided:
      return "undecided";
  }
  return "undecided";
}

struct NestProblem::Model {
  NestSpec spec;
  std::vector<Topology> topologies;
};

NestProblem::NestProblem(NestSpec spec) : model_(std::make_unique<Model>()) {
  model_->topologies = topologies_of(spec);
  model_->spec = std::move(spec);
}
NestProblem::~NestProblem() = default;

std::span<const Variable> NestProblem::variables() const { return model_->spec.variables; }
std::span<const Topology> NestProblem::topologies() const { return model_->topologies; }
std::span<const Objective> NestProblem::objectives() const { return model_->spec.objectives; }
const NestSpec& NestProblem::spec() const { return model_->spec; }

Score NestProblem::score(const Candidate& candidate, Memory*) const {
  return score_of(model_->spec, judge(model_->spec, candidate.topology, all_values(*this, candidate), false),
                  objective);
}

NestEvaluation NestProblem::evaluate(int topology, std::span<const double> values) const {
  return judge(model_->spec, topology, values, true).evaluation;
}

std::vector<Loop> NestProblem::nest_mm(int topology, std::span<const double> values) const {
  std::vector<Loop> loops;
  for (const AffineLoop& loop : model_->spec.designs[static_cast<std::size_t>(topology)].nest_mm)
    loops.push_back(evaluated(loop, values));
  return loops;
}

std::vector<Violation> NestProblem::defects(int topology, std::span<const double> values) const {
  return defects_of(model_->spec, topology, values);
}

std::unique_ptr<Scene> NestProblem::scene(int topology, std::span<const double> values,
                                          const std::string& aspect) const {
  if (!defects(topology, values).empty()) throw std::logic_error("a scene of shapes that are not valid");
  for (const AspectShape& shape : aspect_shapes(model_->spec.part, values)) {
    if (shape.name == aspect) return scene_of(model_->spec, topology, values, shape);
  }
  throw std::logic_error("a scene of an unknown aspect");
}

Configuration NestProblem::seat(std::span<const double> values) const { return seat_of(model_->spec, values); }

DesignSpec NestProblem::literal_design(int topology, std::span<const double> values) const {
  DesignSpec literal;
  for (const AffineLoop& loop : model_->spec.designs[static_cast<std::size_t>(topology)].nest_mm)
    literal.nest_mm.push_back(literal_loop(loop, values));
  return literal;
}

}  // namespace formotion::nest
