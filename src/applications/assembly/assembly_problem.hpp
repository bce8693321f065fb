// The assembly application: a design of fixed shapes is scored by the insertions of a part from a box of start errors.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "analysis/contact/configuration.hpp"
#include "applications/assembly/evaluation.hpp"
#include "applications/assembly/spec.hpp"
#include "problem/problem.hpp"

namespace formotion::assembly {

// The shapes of a design with their expressions evaluated, in the frame of the problem file.
struct Joint {
  Polygon part;                // as drawn, aspect "up"
  std::vector<Loop> fixed_mm;  // as written
  Point centre_mm;             // compliance centre of the drawn part
  Point com_mm;                // its centre of mass
  std::vector<Loop> part_mm;   // as written: the outline, then the holes

  // A point of the drawn part as the part has it, relative to another one of it, in an aspect ("down" is mirrored).
  static Point held(const Point& p, const Point& about, const std::string& aspect) {
    return aspect == "down" ? Point(about.x() - p.x(), p.y() - about.y()) : Point(p - about);
  }
};

// Everything that insert() wants, owned; not to be moved or copied.
struct Scene {
  MovingShape part;  // relative to the compliance centre
  Obstacles obstacles;
  std::unique_ptr<ContactSpace> space;
  InsertionTask task;
};

class AssemblyProblem final : public Problem {
 public:
  // The specification must have passed io's validation.
  explicit AssemblyProblem(AssemblySpec spec);
  ~AssemblyProblem() override;

  std::span<const Variable> variables() const override;
  std::span<const Topology> topologies() const override;
  std::span<const Objective> objectives() const override;
  Score score(const Candidate& candidate, Memory* memory = nullptr) const override;
  const SmoothProblem* smooth() const override;  // springs, where forces or work matter

  const AssemblySpec& spec() const;

  // Below, values are of all the problem's variables, in order.
  AssemblyEvaluation evaluate(int topology, std::span<const double> values) const;
  // Why the shapes of a design cannot be used; empty if they can.
  std::vector<Violation> defects(int topology, std::span<const double> values) const;
  Joint joint(int topology, std::span<const double> values) const;
  // The scene with the part held in an aspect ("up", "down"), turned by orientation_rad. Throws std::logic_error for
  // shapes that are not valid (evaluate says so as a violation).
  std::unique_ptr<Scene> scene(int topology, std::span<const double> values, const std::string& aspect,
                               double orientation_rad) const;
  // The design with literal numbers.
  DesignSpec literal_design(int topology, std::span<const double> values) const;

 private:
  struct Model;
  std::unique_ptr<Model> model_;
};

}  // namespace formotion::assembly
