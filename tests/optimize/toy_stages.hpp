// A problem of stages with closed forms: things of a height and an extent travel past bars, bands and holes.
#pragma once

#include <algorithm>
#include <cmath>

#include "problem/staged_problem.hpp"

namespace formotion {

// Kinds, all passive but the last:
// "bar" (w): loses what is higher than w. Its edge off by e: w - e or w + e.
// "hole" (g): loses what is shorter than g; g long.
// "band" (from, wide): loses heights between from and from + wide; wide + 1 long.
// "turner" (x in [0, 1]): what travels as state 0 leaves as state 1 where x < 0.5, and the other way round above.
// A margin of m bears errors up to m / 2: one half goes with the edge, one half is left.
class ToyStages final : public Problem, public StagedProblem {
 public:
  struct Thing {
    double height, extent, prior;
  };

  ToyStages(std::vector<Thing> things, std::vector<std::vector<int>> topologies) : things_(std::move(things)) {
    for (std::size_t i = 0; i < things_.size(); ++i) {
      states_.push_back({"thing " + std::to_string(i), things_[i].prior});
      goals_.push_back({static_cast<int>(i)});
    }
    kinds_ = {{"bar", {{"w", 0, 20, std::nullopt}}, true},
              {"hole", {{"g", 0, 20, std::nullopt}}, true},
              {"band", {{"from", 0, 20, std::nullopt}, {"wide", 0, 20, std::nullopt}}, true},
              {"turner", {{"x", 0, 1, std::nullopt}}, false}};
    for (const std::vector<int>& kinds : topologies) {
      Topology topology;
      std::vector<StageUse> uses;
      int used = 0;
      for (std::size_t s = 0; s < kinds.size(); ++s) {
        StageUse use{kinds[s], {}};
        topology.label += (s ? " + " : "") + kinds_[static_cast<std::size_t>(kinds[s])].label;
        for (const Variable& variable : kinds_[static_cast<std::size_t>(kinds[s])].variables) {
          topology.variables.push_back(static_cast<int>(variables_.size()));
          variables_.push_back(variable);
          use.values.push_back(used++);
        }
        uses.push_back(use);
      }
      topologies_.push_back(topology);
      uses_.push_back(uses);
    }
    kinds_.erase(std::find_if(kinds_.begin(), kinds_.end(), [&](const StageKind& kind) { return !used(kind.label); }),
                 kinds_.end());
  }

  std::span<const Variable> variables() const override { return variables_; }
  std::span<const Topology> topologies() const override { return topologies_; }
  std::span<const Objective> objectives() const override { return objectives_; }
  const StagedProblem* staged() const override { return this; }

  Score score(const Candidate& candidate, Memory* = nullptr) const override {
    Score score;
    std::vector<int> at;
    std::vector<double> width(states_.size(), 1e9);  // of what is still there
    std::vector<double> lost(states_.size(), -1e9);  // how widely the others are lost
    for (std::size_t i = 0; i < states_.size(); ++i) at.push_back(static_cast<int>(i));
    double length = 0;
    for (const StageUse& use : uses_[static_cast<std::size_t>(candidate.topology)]) {
      std::vector<double> values;
      for (const int v : use.values) values.push_back(candidate.values[static_cast<std::size_t>(v)]);
      const StageResult result = pass(use.kind, values);
      length += result.length_mm;
      score.work += result.work;
      for (std::size_t i = 0; i < at.size(); ++i) {
        const StageEnd& end = result.ends[static_cast<std::size_t>(at[i])];
        if (end.to == kLostState)
          lost[i] = std::max(lost[i], end.nominal_mm);
        else if (lost[i] < 0) {
          width[i] = std::min(width[i], end.nominal_mm);
          at[i] = end.to;
        }
      }
    }
    Composition composition{candidate.topology, {}, 1e9, length};
    for (std::size_t i = 0; i < at.size(); ++i) {
      composition.ends.push_back(lost[i] >= 0 ? kLostState : at[i]);
      composition.tolerance_mm = std::min(composition.tolerance_mm, 0.5 * (lost[i] >= 0 ? lost[i] : width[i]));
    }
    std::vector<double> margins;
    std::vector<int> leaving;
    for (std::size_t i = 0; i < at.size(); ++i) {
      if (lost[i] >= 0) continue;
      leaving.push_back(at[i]);
      margins.push_back(width[i]);
    }
    std::sort(margins.begin(), margins.end());
    const bool one = !leaving.empty() && std::count(leaving.begin(), leaving.end(), leaving[0]) ==
                                             static_cast<std::ptrdiff_t>(leaving.size());
    score.feasible = one && composition.tolerance_mm > 0;
    if (!score.feasible) {
      score.violation = leaving.empty() ? 1 - *std::max_element(lost.begin(), lost.end()) / 100 : 1e-6;
      for (std::size_t i = 0; i + 1 < margins.size(); ++i) score.violation += margins[i];
    }
    score.objectives = objectives(composition);
    if (!score.feasible) score.objectives[0] = 0;
    return score;
  }

  std::span<const StageState> states() const override { return states_; }
  std::span<const StageKind> kinds() const override { return kinds_; }
  std::span<const StageUse> stages(int topology) const override { return uses_[static_cast<std::size_t>(topology)]; }
  const std::vector<std::vector<int>>& goals() const override { return goals_; }
  std::vector<std::vector<double>> starts(int) const override { return {}; }

  StageResult pass(int kind, std::span<const double> v) const override {
    StageResult result;
    result.valid = true;
    result.work = static_cast<std::int64_t>(things_.size());
    result.length_mm = kind == 0 ? 10 : kind == 1 ? v[0] : kind == 2 ? v[1] + 1 : 5;
    for (int i = 0; i < static_cast<int>(things_.size()); ++i) {
      if (kind == 3) {
        int to = i;
        if (v[0] < 0.5 && i == 0) to = 1;
        if (v[0] >= 0.5 && i == 1) to = 0;
        result.ends.push_back({to, std::abs(v[0] - 0.5), 0});
        continue;
      }
      const double lost = loss(kind, v, i, 0);
      result.ends.push_back({lost > 0 ? kLostState : i, std::abs(lost), 0});
    }
    return result;
  }
  StageTolerance tolerance(int, std::span<const double>, const StageResult& result, const StageDemand& demanded,
                           double at_most_mm) const override {
    StageTolerance found{at_most_mm, 1};
    for (std::size_t i = 0; i < demanded.size(); ++i) {
      if (demanded[i]) found.tolerance_mm = std::min(found.tolerance_mm, 0.5 * result.ends[i].nominal_mm);
    }
    return found;
  }
  std::optional<std::size_t> tolerance_objective() const override { return 0; }
  std::vector<double> objectives(const Composition& composition) const override {
    return {composition.tolerance_mm, composition.length_mm};
  }
  std::optional<double> displacement_mm(int kind, std::span<const double> half_widths) const override {
    if (kind == 3) return std::nullopt;
    return kind == 2 ? half_widths[0] + half_widths[1] : half_widths[0];
  }
  bool bears(int kind, std::span<const double> v, int state, bool kept, double e, std::int64_t& work) const override {
    ++work;
    return kept ? -loss(kind, v, state, e) >= e : loss(kind, v, state, -e) >= e;
  }

 private:
  // How widely a state is lost when what removes it is larger by e.
  double loss(int kind, std::span<const double> v, int state, double e) const {
    const Thing& thing = things_[static_cast<std::size_t>(state)];
    if (kind == 0) return thing.height - (v[0] - e);
    if (kind == 1) return v[0] + e - thing.extent;
    return std::min(thing.height - (v[0] - e), v[0] + v[1] + e - thing.height);
  }
  bool used(const std::string& label) const {
    return label != "turner" || std::any_of(topologies_.begin(), topologies_.end(), [](const Topology& topology) {
             return topology.label.find("turner") != std::string::npos;
           });
  }

  std::vector<Thing> things_;
  std::vector<StageState> states_;
  std::vector<StageKind> kinds_;
  std::vector<std::vector<int>> goals_;
  std::vector<Variable> variables_;
  std::vector<Topology> topologies_;
  std::vector<std::vector<StageUse>> uses_;
  std::vector<Objective> objectives_{{"tolerance", true, 1e-3, false}, {"length", false, 1e-3, false}};
};

}  // namespace formotion
