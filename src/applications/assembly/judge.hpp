// One design of an assembly judged: all its insertions, projected from the whole box of starts.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "applications/assembly/assembly_problem.hpp"

namespace formotion::assembly {

// Why the shapes of a design cannot be used; empty if they can.
std::vector<Violation> defects(const AssemblySpec& spec, int topology, std::span<const double> values);

Joint joint_of(const AssemblySpec& spec, int topology, std::span<const double> values);
// Null where shapes vanish when they are grown.
std::unique_ptr<Scene> scene_of(const AssemblySpec& spec, int topology, std::span<const double> values,
                                const std::string& aspect, double orientation_rad, const Member& member = {});

struct Judged {
  AssemblyEvaluation evaluation;
  double violation = 0;
  std::int64_t work = 0;  // starts projected
};
// A start of the goal's box that was projected, and what it took.
struct ProjectedStart {
  Member member;  // of the uncertain values it was projected with
  double x_mm = 0, y_mm = 0, theta_rad = 0;
  InsertionOutcome outcome = InsertionOutcome::Undecided;
  std::uint64_t history = 0;
  double peak_force_n = 0, peak_lateral_force_n = 0, work_nmm = 0;
};

// Projected again, in another scene.
ProjectedStart projected_start(const InsertionTask& task, const ProjectedStart& start);

// in_detail: finer regions, proofs and limits, as people want them; else what a search needs. starts: gets those whose
// worst are the objectives that search sees, in the order of their projection.
Judged judge(const AssemblySpec& spec, int topology, std::span<const double> values, bool in_detail,
             std::vector<ProjectedStart>* starts = nullptr);

// The value of an objective; what does not exist counts as the worst one.
double objective(const Metrics& metrics, const std::string& name);

// Of the design: its own expression, else measured on its shapes.
double chamfer_mm(const AssemblySpec& spec, int topology, std::span<const double> values);

// The largest extent across the approach of a run of slanted faces of the fixed shapes and the part: more than 3
// degrees from the approach and from its perpendicular.
double measured_chamfer_mm(const Joint& joint, double approach_rad);

}  // namespace formotion::assembly
