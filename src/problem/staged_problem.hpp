// A problem whose candidates are sequences of stages that act one by one on a finite set of states (features.md calls
// it composition: features act on poses). Types alone; no application is known here.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "problem/problem.hpp"

namespace formotion {

struct StageState {
  std::string name;  // "up 90.00 deg"
  double prior = 0;  // probability that it arrives at the first stage
};

// One kind of stage; stages of one kind differ in the values of its variables alone.
struct StageKind {
  std::string label;  // "balcony"
  std::vector<Variable> variables;
  // States leave as they came or not at all, and how far they are lost can only grow with every stage that loses them:
  // a state that one stage loses narrowly may be lost safely by a later one.
  bool passive = false;
};

// A stage of a topology.
struct StageUse {
  int kind = 0;
  std::vector<int> values;  // for every variable of the kind: its place in Candidate::values
};

inline constexpr int kLostState = -1;   // rejected: good where the state is not wanted
inline constexpr int kStuckState = -2;  // jams, or has no single end: never good

// What one stage does to one state.
struct StageEnd {
  int to = kStuckState;
  double nominal_mm = 0;  // kept: its margin; lost: the depth of its loss. No tolerance can exceed it.
  double lacking_mm = 0;  // stuck: about how far from an end
};

struct StageResult {
  bool valid = false;
  double violation = 0;        // of an invalid one, positive
  std::vector<StageEnd> ends;  // of every state
  double length_mm = 0;
  std::int64_t work = 0;  // in the unit of Score::work
};

// States whose ends somebody relies on.
using StageDemand = std::vector<bool>;

struct StageTolerance {
  double tolerance_mm = 0;
  std::int64_t work = 0;
};

// A whole track as its stages make it.
struct Composition {
  int topology = 0;
  std::vector<int> ends;    // of every state: the state in which it leaves the last stage, or kLostState
  double tolerance_mm = 0;  // the least over stages; an upper bound of the track's
  double length_mm = 0;     // the sum over stages: what stands between them comes on top
};

class StagedProblem {
 public:
  virtual ~StagedProblem() = default;
  virtual std::span<const StageState> states() const = 0;
  virtual std::span<const StageKind> kinds() const = 0;
  // In the order of travel; empty where the topology's stages depend on one another.
  virtual std::span<const StageUse> stages(int topology) const = 0;
  // Every alternative: the states that may leave the last stage. All others must be lost.
  virtual const std::vector<std::vector<int>>& goals() const = 0;

  // Values worth beginning with, within the kind's bounds: shapes carved or swept from the part. May be empty.
  virtual std::vector<std::vector<double>> starts(int kind) const = 0;

  // Pure, as Problem::score.
  virtual StageResult pass(int kind, std::span<const double> values) const = 0;
  // The largest error of every edge up to which all demanded states end as `result` says; at most at_most_mm.
  virtual StageTolerance tolerance(int kind, std::span<const double> values, const StageResult& result,
                                   const StageDemand& demanded, double at_most_mm) const = 0;
  // In the order and sense of Problem::objectives. An estimate that is exact where stages stand far enough apart.
  virtual std::vector<double> objectives(const Composition& composition) const = 0;
  // Which of them is the tolerance; none where nobody asks for it, so that stages are not worth a search of their own.
  virtual std::optional<std::size_t> tolerance_objective() const = 0;

  // For proofs. How far any edge of a stage may move when every variable moves by up to its half width; none where that
  // is not known. Tolerances change by no more than that (docs/search.md).
  virtual std::optional<double> displacement_mm(int kind, std::span<const double> half_widths) const = 0;
  // Whether the state is kept with a margin of error_mm or more when edges are off by error_mm (kept), or lost
  // likewise. Monotone: false for one error is false for every larger one. True for errors of 0 and less, and where the
  // values are invalid: nothing is known there. Of passive kinds only.
  virtual bool bears(int kind, std::span<const double> values, int state, bool kept, double error_mm,
                     std::int64_t& work) const = 0;
};

}  // namespace formotion
