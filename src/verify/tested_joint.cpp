#include "verify/tested_joint.hpp"

#include <cmath>
#include <numbers>
#include <sstream>

namespace formotion {
namespace {

double degrees(double rad) { return std::round(rad * 180 / std::numbers::pi * 1e9) / 1e9; }

}  // namespace

std::unique_ptr<assembly::Scene> TestedJoint::scene(const assembly::NeverResult& wrong) const {
  constexpr double kAnywhere = 1e9;
  std::unique_ptr<assembly::Scene> held = problem.scene(topology, values, wrong.aspect, wrong.orientation_rad);
  held->task.goal = {spec().goal.depth_mm, kAnywhere, kAnywhere};
  return held;
}

TestedJoint tested_joint(const assembly::AssemblyProblem& problem, const Evaluated& stored) {
  TestedJoint joint{problem, stored, stored.candidate.topology, all_values(problem, stored.candidate), {}};
  joint.evaluation = problem.evaluate(joint.topology, joint.values);
  return joint;
}

std::string number_text(double value) {
  std::ostringstream out;
  out.precision(6);
  out << value + 0.0;
  return out.str();
}

std::string start_text(double x_mm, double y_mm, double theta_rad) {
  return "the start x " + number_text(x_mm) + " mm, y " + number_text(y_mm) + " mm, theta " +
         number_text(degrees(theta_rad)) + " deg";
}

std::string never_text(const assembly::NeverResult& wrong) {
  return "the part held " + wrong.aspect + " at " + number_text(degrees(wrong.orientation_rad)) + " deg";
}

}  // namespace formotion
