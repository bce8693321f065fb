// What search sees of an application: variables in, a score out. Types alone; no application is known here.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace formotion {

struct Variable {
  std::string name;
  double min = 0;
  double max = 0;
  std::optional<double> value;  // the user's guess

  double start() const { return value.value_or(0.5 * (min + max)); }
};

// One discrete choice of features; its candidates differ in the values of its variables alone.
struct Topology {
  std::string label;           // "balcony + cutout"
  std::vector<int> variables;  // indices of the problem's variables that it uses, ascending
};

struct Candidate {
  int topology = 0;
  std::vector<double> values;  // of the topology's variables, in their order
};

struct Objective {
  std::string name;  // as in problem files: "tolerance_mm"
  bool maximise = true;
  double resolution = 0;  // smaller differences do not matter to the user: fronts are thinned to it
  bool stepwise = false;  // takes few values: there is no slope that a local search could follow

  double loss(double value) const { return maximise ? -value : value; }  // to be minimised
};

// What one evaluation says. Values are finite always: a measure that does not exist counts as the worst one.
struct Score {
  bool feasible = false;
  double violation = 0;  // 0 iff feasible, else a positive distance-like amount that falls towards feasibility
  std::vector<double> objectives;    // nominal, in the order and sense of Problem::objectives
  std::vector<double> worst_case;    // the same at the worst of the uncertainties; empty while not computed
  std::optional<std::string> bites;  // the uncertain value that decides worst_case
  std::int64_t work = 0;             // pose-feature sweeps done
};

class Problem {
 public:
  virtual ~Problem() = default;
  virtual std::span<const Variable> variables() const = 0;
  virtual std::span<const Topology> topologies() const = 0;
  virtual std::span<const Objective> objectives() const = 0;
  // Pure: the same candidate gives the same bits on every thread. Throws only on bugs.
  virtual Score score(const Candidate& candidate) const = 0;
};

}  // namespace formotion
