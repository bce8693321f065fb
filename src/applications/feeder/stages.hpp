// The feeder as a problem of stages: every feature by itself acts on the stable poses of the part.
#pragma once

#include <memory>

#include "applications/feeder/stage_kinds.hpp"
#include "applications/feeder/track_layout.hpp"

namespace formotion::feeder {

class FeederStages final : public StagedProblem {
 public:
  // Null where no topology composes, and where goals ask for more than what becomes of poses. What is given must
  // outlive it; the part is the specification's, without defects.
  static std::unique_ptr<FeederStages> of(const FeederSpec& spec, const PartModel& part);

  std::span<const StageState> states() const override { return states_; }
  std::span<const StageKind> kinds() const override { return kinds_; }
  std::span<const StageUse> stages(int topology) const override { return catalogue_.stages[topology]; }
  const std::vector<std::vector<int>>& goals() const override { return goals_; }

  std::vector<std::vector<double>> starts(int kind) const override;
  StageResult pass(int kind, std::span<const double> values) const override;
  StageTolerance tolerance(int kind, std::span<const double> values, const StageResult& result,
                           const StageDemand& demanded, double at_most_mm) const override;
  std::vector<double> objectives(const Composition& composition) const override;
  std::optional<std::size_t> tolerance_objective() const override;
  std::optional<double> displacement_mm(int kind, std::span<const double> half_widths) const override;
  bool bears(int kind, std::span<const double> values, int state, bool kept, double error_mm,
             std::int64_t& work) const override;

 private:
  FeederStages(const FeederSpec& spec, const PartModel& part, StageCatalogue catalogue);
  Layout alone(int kind, std::span<const double> values) const;

  const FeederSpec& spec_;
  const PartModel& part_;
  StageCatalogue catalogue_;
  std::vector<StageKind> kinds_;
  std::vector<StageState> states_;
  std::vector<std::vector<int>> goals_;
};

}  // namespace formotion::feeder
