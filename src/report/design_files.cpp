#include "report/design_files.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numbers>
#include <sstream>

#include "report/track_drawing.hpp"

namespace formotion {
namespace {

std::string fixed(double value, int digits) {
  std::ostringstream out;
  out << std::fixed << std::setprecision(digits) << value;
  return out.str();
}

TrackDrawing drawing_of(const std::string& name, const feeder::FeederProblem& problem, const JudgedDesign& judged) {
  const feeder::FeederEvaluation& evaluation = judged.evaluation;
  TrackDrawing drawing;
  drawing.title = name + (judged.design.number > 0 ? ", design " + design_id(judged.design) : "");
  drawing.track_width_mm = problem.spec().environment.track_width_mm;
  drawing.plate_mm = problem.spec().manufacture.plate_mm.value_or(drawing.plate_mm);
  drawing.obstacle_height_mm = 0;
  for (const feeder::AspectSpec& aspect : problem.spec().part.aspects)
    drawing.obstacle_height_mm = std::max(drawing.obstacle_height_mm, aspect.height_mm);
  drawing.features = problem.place(judged.design.candidate.topology, judged.values);
  if (evaluation.goal_pose >= 0) {
    const feeder::PoseResult& goal = evaluation.poses[static_cast<std::size_t>(evaluation.goal_pose)];
    drawing.notes.push_back("delivers " + goal.aspect + " " + fixed(goal.orientation_rad * 180 / std::numbers::pi, 2) +
                            " deg, efficiency " + fixed(evaluation.metrics.efficiency, 3));
  }
  if (evaluation.metrics.tolerance_mm)
    drawing.notes.push_back("every edge may be off by " + fixed(*evaluation.metrics.tolerance_mm, 3) + " mm");
  const double tilt = problem.spec().environment.tilt_rad;
  if (tilt != 0)
    drawing.notes.push_back("track tilted by " + fixed(tilt * 180 / std::numbers::pi, 1) + " deg towards the wall");
  if (!evaluation.feasible) drawing.notes.push_back("NOT FEASIBLE: " + evaluation.violations.front().what);
  return drawing;
}

}  // namespace

JudgedDesign judged(const feeder::FeederProblem& problem, const Evaluated& design) {
  std::vector<double> values = all_values(problem, design.candidate);
  feeder::FeederEvaluation evaluation = problem.evaluate(design.candidate.topology, values);
  return {design, std::move(values), std::move(evaluation)};
}

std::vector<JudgedDesign> judged(const feeder::FeederProblem& problem, const std::vector<Evaluated>& designs) {
  std::vector<JudgedDesign> all;
  for (const Evaluated& design : designs) all.push_back(judged(problem, design));
  return all;
}

OrderedJson design_json(const feeder::FeederProblem& problem, const JudgedDesign& judged) {
  const int topology = judged.design.candidate.topology;
  const OrderedJson evaluation = evaluation_json(problem, topology, judged.values, judged.evaluation);
  OrderedJson json{{"id", design_id(judged.design)}, {"topology", topology}};
  json["label"] = problem.topologies()[static_cast<std::size_t>(topology)].label;
  json["feasible"] = evaluation["feasible"];
  json["features"] = features_json(problem.literal_design(topology, judged.values));
  for (const char* key : {"values", "metrics", "worst_case", "violations"}) json[key] = evaluation[key];
  json["provenance"] = judged.design.provenance;
  return json;
}

std::string design_svg(const std::string& name, const feeder::FeederProblem& problem, const JudgedDesign& judged) {
  return track_svg(drawing_of(name, problem, judged));
}

std::string design_dxf(const std::string& name, const feeder::FeederProblem& problem, const JudgedDesign& judged) {
  return track_dxf(drawing_of(name, problem, judged));
}

std::string design_stl(const std::string& name, const feeder::FeederProblem& problem, const JudgedDesign& judged) {
  return track_stl(drawing_of(name, problem, judged));
}

}  // namespace formotion
