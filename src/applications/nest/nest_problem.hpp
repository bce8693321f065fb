// The nest application: a design of fixed shapes is scored by where parts come to rest in it, and how hard they are to
// get out.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "analysis/energy/escape.hpp"
#include "analysis/energy/gravity.hpp"
#include "analysis/motion/contact_space.hpp"
#include "applications/nest/evaluation.hpp"
#include "applications/nest/spec.hpp"
#include "applications/shared/part_shapes.hpp"

namespace formotion::nest {

// One aspect of the part in the nest, owned; not to be moved or copied.
struct Scene {
  AspectShape shape;
  int symmetry = 1;  // rotational order
  MovingShape part;  // about the centre of mass
  Obstacles obstacles;
  std::unique_ptr<ContactSpace> space;
  Gravity gravity;
  double friction = 0;
  EscapeGoal outside;
};

// A member of a rest's orientations that are the same under the part's symmetry: theta in [0, 2 pi / order).
Configuration reduced(const Configuration& q, int symmetry);
// The farthest that a point of the part is apart in two configurations, over orientations that are the same.
double apart_mm(const Scene& scene, const Configuration& a, const Configuration& b);
// The member of a rest's set whose position is nearest; and how far from it.
Configuration member_near(const NestRest& rest, const Configuration& q);
double apart_mm(const Scene& scene, const Configuration& q, const NestRest& rest);

class NestProblem final : public Problem {
 public:
  // The specification must have passed io's validation.
  explicit NestProblem(NestSpec spec);
  ~NestProblem() override;

  std::span<const Variable> variables() const override;
  std::span<const Topology> topologies() const override;
  std::span<const Objective> objectives() const override;
  Score score(const Candidate& candidate, Memory* memory = nullptr) const override;

  const NestSpec& spec() const;

  // Below, values are of all the problem's variables, in order.
  NestEvaluation evaluate(int topology, std::span<const double> values) const;
  std::vector<Loop> nest_mm(int topology, std::span<const double> values) const;  // as written
  // Empty if the shapes can be used.
  std::vector<Violation> defects(int topology, std::span<const double> values) const;
  // Throws std::logic_error for shapes that are not valid (evaluate says so as a violation).
  std::unique_ptr<Scene> scene(int topology, std::span<const double> values, const std::string& aspect) const;
  Configuration seat(std::span<const double> values) const;
  // The design with literal numbers.
  DesignSpec literal_design(int topology, std::span<const double> values) const;

 private:
  struct Model;
  std::unique_ptr<Model> model_;
};

}  // namespace formotion::nest
