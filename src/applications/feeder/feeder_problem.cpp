#include "applications/feeder/feeder_problem.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "analysis/geometry/boolean.hpp"
#include "applications/feeder/configuration_support.hpp"
#include "applications/feeder/expressions.hpp"
#include "applications/feeder/judge.hpp"
#include "applications/feeder/pose_travel.hpp"
#include "applications/feeder/residuals.hpp"
#include "applications/feeder/stages.hpp"
#include "applications/feeder/world.hpp"

namespace formotion::feeder {
namespace {

// A literal feature's numbers with the contract's names, angles in degrees.
struct Dimensions {
  using List = std::vector<std::pair<std::string, double>>;
  static double v(const Affine& a) { return a({}); }
  List operator()(const Balcony& f) const { return {{"width_mm", v(f.width_mm)}, {"length_mm", v(f.length_mm)}}; }
  List operator()(const Gap& f) const { return {{"length_mm", v(f.length_mm)}}; }
  List operator()(const Canyon& f) const { return band(f); }
  List operator()(const Slot& f) const { return band(f); }
  List operator()(const Cutout& f) const { return corners(f.polygon_mm); }
  List operator()(const DishOut& f) const { return {{"depth_mm", v(f.depth_mm)}, {"length_mm", v(f.length_mm)}}; }
  List operator()(const Scallop& f) const {
    return {{"depth_mm", v(f.depth_mm)}, {"half_angle_deg", v(f.half_angle_rad) * 180 / std::numbers::pi}};
  }
  List operator()(const Drawing&) const { return {}; }
  List operator()(const Wiper& f) const { return {{"height_mm", v(f.height_mm)}}; }
  List operator()(const HoldDown& f) const { return {{"height_mm", v(f.height_mm)}, {"length_mm", v(f.length_mm)}}; }
  List operator()(const Fence& f) const { return corners(f.polygon_mm); }
  List operator()(const WallProfile& f) const { return corners(f.profile_mm); }
  List operator()(const Pin& f) const {
    return {{"x_mm", v(f.x_mm)}, {"y_mm", v(f.y_mm)}, {"diameter_mm", v(f.diameter_mm)}};
  }
  static List corners(const AffineLoop& loop) {
    List list;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      list.emplace_back("x" + std::to_string(i) + "_mm", v(loop[i][0]));
      list.emplace_back("y" + std::to_string(i) + "_mm", v(loop[i][1]));
    }
    return list;
  }
  template <class Band>
  static List band(const Band& f) {
    return {{"from_mm", v(f.from_mm)}, {"to_mm", v(f.to_mm)}, {"length_mm", v(f.length_mm)}};
  }
};

}  // namespace

const char* name(Outcome outcome) {
  switch (outcome) {
    case Outcome::Delivered:
      return "delivered";
    case Outcome::Rejected:
      return "rejected";
    case Outcome::Jammed:
      return "jammed";
    case Outcome::Ambiguous:
      return "ambiguous";
    case Outcome::Undecided:
      return "undecided";
  }
  return "undecided";
}

struct FeederProblem::Model {
  FeederSpec spec;
  std::vector<Topology> topologies;
  std::optional<PartModel> part;  // of a part whose shape does not depend on variables
  std::vector<Violation> part_defects;
  std::optional<Spreads> spreads;  // of that part, where something is uncertain
  std::unique_ptr<FeederResiduals> residuals;
  std::unique_ptr<FeederStages> stages;

  template <class Use>
  auto with_part(std::span<const double> values, const Use& use) const {
    return part ? use(*part) : use(part_model(spec.part, spec.environment, values));
  }
  Judged judge(int topology, std::span<const double> values, bool in_detail, Memory* memory) const {
    return with_part(values, [&](const PartModel& model) {
      const std::vector<Violation> defects = part ? part_defects : defects_of(model);
      Passages own(model);
      Passages& passages = memory ? static_cast<Passages&>(*memory) : own;
      std::optional<Spreads> own_spreads;
      if (!part && spec.uncertainty.any()) own_spreads = spreads_of(model, spec.environment, spec.uncertainty);
      const std::optional<Spreads>& uncertain = part ? spreads : own_spreads;
      return feeder::judge({spec, spec.designs[topology], model, defects, values, uncertain ? &*uncertain : nullptr},
                           in_detail, passages);
    });
  }
};

FeederProblem::FeederProblem(FeederSpec spec) : model_(std::make_unique<Model>()) {
  model_->topologies = topologies_of(spec);
  if (is_literal(spec.part)) {
    model_->part = part_model(spec.part, spec.environment, {});
    model_->part_defects = defects_of(*model_->part);
    if (spec.uncertainty.any()) model_->spreads = spreads_of(*model_->part, spec.environment, spec.uncertainty);
  }
  model_->spec = std::move(spec);
  model_->residuals = std::make_unique<FeederResiduals>(*this);
  if (model_->part && model_->part_defects.empty()) model_->stages = FeederStages::of(model_->spec, *model_->part);
}
FeederProblem::~FeederProblem() = default;

std::span<const Variable> FeederProblem::variables() const { return model_->spec.variables; }
std::span<const Topology> FeederProblem::topologies() const { return model_->topologies; }
std::span<const Objective> FeederProblem::objectives() const { return model_->spec.objectives; }
const StagedProblem* FeederProblem::staged() const { return model_->stages.get(); }
const SmoothProblem* FeederProblem::smooth() const { return model_->residuals.get(); }
const FeederSpec& FeederProblem::spec() const { return model_->spec; }

std::unique_ptr<Memory> FeederProblem::memory() const {
  return model_->part ? std::make_unique<Passages>(*model_->part) : nullptr;
}

Score FeederProblem::score(const Candidate& candidate, Memory* memory) const {
  const Judged judged = model_->judge(candidate.topology, all_values(*this, candidate), false, memory);
  Score score;
  score.feasible = judged.evaluation.feasible;
  score.violation = judged.violation;
  score.work = judged.work;
  const FeederEvaluation& evaluation = judged.evaluation;
  const std::optional<Metrics>& worst = evaluation.worst_case;
  for (const Objective& o : model_->spec.objectives) {
    score.objectives.push_back(objective(model_->spec.robust && worst ? *worst : evaluation.metrics, o.name));
    if (worst) score.worst_case.push_back(objective(*worst, o.name));
  }
  score.bites = evaluation.bites;
  if (!model_->spec.uncertainty.any()) score.worst_case = score.objectives;
  return score;
}

FeederEvaluation FeederProblem::evaluate(int topology, std::span<const double> values) const {
  return model_->judge(topology, values, true, nullptr).evaluation;
}

std::vector<PlacedFeature> FeederProblem::place(int topology, std::span<const double> values) const {
  const FeederSpec& spec = model_->spec;
  const double diameter = model_->with_part(values, [](const PartModel& part) { return part.diameter_mm; });
  const Layout layout = lay_out(spec.designs[topology], spec.environment, spec.manufacture, diameter, values);
  DesignSpec literal = literal_design(topology, values);
  std::vector<PlacedFeature> placed;
  for (std::size_t i = 0; i < layout.features.size(); ++i) {
    const LaidFeature& laid = layout.features[i];
    PlacedFeature feature{laid.type, laid.start_mm, laid.end_mm, {}, std::visit(Dimensions{}, literal[i].shape)};
    feature.obstacles = laid.obstacles;
    feature.wall_face_mm = laid.wall_face_mm;
    if (!laid.voids.empty()) {
      feature.voids_mm =
          intersection(laid.voids, {rectangle(laid.x_min - 1, 0, laid.x_max + 1, spec.environment.track_width_mm)});
    }
    placed.push_back(std::move(feature));
  }
  return placed;
}

std::vector<AspectShape> FeederProblem::shapes(std::span<const double> values) const {
  return model_->with_part(values, [](const PartModel& part) { return part.shapes; });
}

std::vector<StablePose> FeederProblem::stable_poses(std::span<const double> values) const {
  return model_->with_part(values, [](const PartModel& part) {
    std::vector<StablePose> poses;
    for (const PoseModel& pose : part.poses) poses.push_back(pose.stable);
    return poses;
  });
}

SupportAnswer FeederProblem::support(int topology, std::span<const double> values, const std::string& aspect,
                                     const Configuration& q) const {
  const FeederSpec& spec = model_->spec;
  return model_->with_part(values, [&](const PartModel& part) {
    const auto shape =
        std::find_if(part.shapes.begin(), part.shapes.end(), [&](const AspectShape& s) { return s.name == aspect; });
    if (shape == part.shapes.end()) throw std::logic_error("no aspect " + aspect);
    const Layout layout = lay_out(spec.designs[topology], spec.environment, spec.manufacture, part.diameter_mm, values);
    return support_at(*shape, track_of(layout, spec.environment), spec.environment, q);
  });
}

World FeederProblem::world(int topology, std::span<const double> values, const std::string& aspect) const {
  const FeederSpec& spec = model_->spec;
  return model_->with_part(values, [&](const PartModel& part) {
    const auto shape =
        std::find_if(part.shapes.begin(), part.shapes.end(), [&](const AspectShape& s) { return s.name == aspect; });
    if (shape == part.shapes.end()) throw std::logic_error("no aspect " + aspect);
    const Layout layout = lay_out(spec.designs[topology], spec.environment, spec.manufacture, part.diameter_mm, values);
    return *world_of(*shape, layout, spec.environment, part.diameter_mm);  // what is not shrunk does not vanish
  });
}

DesignSpec FeederProblem::literal_design(int topology, std::span<const double> values) const {
  DesignSpec design;
  for (const FeatureSpec& feature : model_->spec.designs[topology]) design.push_back(literal(feature, values));
  return design;
}

}  // namespace formotion::feeder
