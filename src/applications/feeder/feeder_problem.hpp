// The feeder application: a design of track features is scored by the travel of every pose past them.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "analysis/contact/configuration.hpp"
#include "applications/feeder/evaluation.hpp"
#include "applications/feeder/spec.hpp"
#include "applications/shared/part_shapes.hpp"
#include "problem/problem.hpp"

namespace formotion::feeder {

// One aspect of the part with its expressions evaluated, moved so that its centre of mass is the origin.
// One way to rest against the wall.
struct StablePose {
  int aspect = 0;
  double orientation_rad = 0;  // from the outline as written, [0, 2 pi)
  double com_wall_mm = 0;      // distance of the centre of mass from the wall
  double prior = 0;
  double basin_from_rad = 0, basin_rad = 0;  // orientations that settle into it; of all its symmetric copies together
};

struct World;  // applications/feeder/world.hpp

struct SupportAnswer {
  bool supported = false;
  std::optional<double> margin_mm;  // signed; none where nothing supports the part
};

// Why the goal names no stable pose, with the list of those that there are; none if it names one, or if the part's
// shape depends on variables.
std::optional<std::string> goal_defect(const FeederSpec& spec);

class FeederProblem final : public Problem {
 public:
  // The specification must have passed io's validation.
  explicit FeederProblem(FeederSpec spec);
  ~FeederProblem() override;

  std::span<const Variable> variables() const override;
  std::span<const Topology> topologies() const override;
  std::span<const Objective> objectives() const override;
  Score score(const Candidate& candidate, Memory* memory = nullptr) const override;
  std::unique_ptr<Memory> memory() const override;
  const StagedProblem* staged() const override;
  const SmoothProblem* smooth() const override;

  const FeederSpec& spec() const;

  // Below, values are of all the problem's variables, in order.
  FeederEvaluation evaluate(int topology, std::span<const double> values) const;
  std::vector<PlacedFeature> place(int topology, std::span<const double> values) const;
  std::vector<AspectShape> shapes(std::span<const double> values) const;
  std::vector<StablePose> stable_poses(std::span<const double> values) const;  // in the order of evaluation.poses
  SupportAnswer support(int topology, std::span<const double> values, const std::string& aspect,
                        const Configuration& q) const;
  // An aspect among the design's obstacles.
  World world(int topology, std::span<const double> values, const std::string& aspect) const;
  // The specification's features with literal numbers.
  DesignSpec literal_design(int topology, std::span<const double> values) const;

 private:
  struct Model;
  std::unique_ptr<Model> model_;
};

}  // namespace formotion::feeder
