// What search sees of an application: variables in, a score out. Types alone; no application is known here.
#pragma once

#include <cstdint>
#include <memory>
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

// Why a candidate has no score. Infeasible ones have one; what is undecided within its limit of work is infeasible.
enum class Failure {
  None,
  Error,    // scoring threw: a bug that one candidate meets
  Crash,    // it ended the process or the worker that scored it, twice
  TimeOut,  // a worker gave it up after the wall time that it was allowed
  Lost,     // its worker vanished; to be tried again
};

inline const char* name(Failure failure) {
  switch (failure) {
    case Failure::None:
      return "none";
    case Failure::Error:
      return "error";
    case Failure::Crash:
      return "crash";
    case Failure::TimeOut:
      return "time-out";
    case Failure::Lost:
      return "lost";
  }
  return "none";
}

// What one evaluation says. Values are finite always: a measure that does not exist counts as the worst one.
struct Score {
  bool feasible = false;
  double violation = 0;  // 0 iff feasible, else a positive distance-like amount that falls towards feasibility
  std::vector<double> objectives;    // nominal, in the order and sense of Problem::objectives
  std::vector<double> worst_case;    // the same at the worst of the uncertainties; empty while not computed
  std::optional<std::string> bites;  // the uncertain value that decides worst_case
  std::int64_t work = 0;             // pose-feature sweeps done, or starts projected
  Failure failure = Failure::None;   // else the rest says: infeasible, by kFailedViolation
  std::string failure_text = {};
};
inline constexpr double kFailedViolation = 1e9;
inline Score failed_score(Failure failure, std::string text, std::size_t objectives) {
  Score score;
  score.violation = kFailedViolation;
  score.objectives.assign(objectives, 0);
  score.failure = failure;
  score.failure_text = std::move(text);
  return score;
}

// What a problem remembers from candidate to candidate, for one driver on one thread. It saves work and never changes
// anything else of a score.
class Memory {
 public:
  virtual ~Memory() = default;
};

class StagedProblem;  // problem/staged_problem.hpp
class SmoothProblem;  // problem/smooth_problem.hpp

class Problem {
 public:
  virtual ~Problem() = default;
  virtual std::span<const Variable> variables() const = 0;
  virtual std::span<const Topology> topologies() const = 0;
  virtual std::span<const Objective> objectives() const = 0;
  // Pure: the same candidate gives the same bits on every thread, but for the work that a memory saves. Throws only on
  // bugs.
  virtual Score score(const Candidate& candidate, Memory* memory = nullptr) const = 0;
  virtual std::unique_ptr<Memory> memory() const { return nullptr; }
  // The same problem as one of stages, or as one of residuals with derivatives; null where it is none.
  virtual const StagedProblem* staged() const { return nullptr; }
  virtual const SmoothProblem* smooth() const { return nullptr; }
};

// Values of all the problem's variables, in order: the candidate's, and the starting values of the others.
inline std::vector<double> all_values(const Problem& problem, const Candidate& candidate) {
  std::vector<double> values;
  for (const Variable& variable : problem.variables()) values.push_back(variable.start());
  const std::vector<int>& used = problem.topologies()[candidate.topology].variables;
  for (std::size_t i = 0; i < used.size(); ++i) values[used[i]] = candidate.values[i];
  return values;
}

}  // namespace formotion
