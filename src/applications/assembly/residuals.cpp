#include "applications/assembly/residuals.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "applications/assembly/assembly_problem.hpp"
#include "applications/assembly/judge.hpp"

namespace formotion::assembly {
namespace {

constexpr double kStep = 2e-4;      // of differences, as a share of the variable's range
constexpr double kStraight = 0.05;  // of two steps' change: what the value between them may lie off the straight line
constexpr double kRounding = 1e-6;  // of values, in the objective's unit
constexpr std::size_t kMostStarts = 3;  // of one objective
constexpr int kSteps = 3;               // of Ceres, between two looks
constexpr double kLimitWeight = 1e3;    // of what must not be more, beside what shall become less
constexpr double kSpareOfLimit = 1e-4;  // in the objective's unit: limits are asked for by this much more

enum class Quantity { PeakForce, PeakLateral, Work, Chamfer };

std::optional<Quantity> quantity_of(const std::string& objective) {
  if (objective == "peak_force_n") return Quantity::PeakForce;
  if (objective == "peak_lateral_force_n") return Quantity::PeakLateral;
  if (objective == "work_nmm") return Quantity::Work;
  if (objective == "chamfer_mm") return Quantity::Chamfer;
  return std::nullopt;
}

// weight * max(0, sign * (quantity - wanted)); of a chamfer the start means nothing.
struct Lack {
  Quantity quantity = Quantity::Work;
  std::size_t start = 0;
  double wanted = 0, weight = 1, sign = 1;
};

struct Measured {
  std::vector<ProjectedStart> starts;
  double chamfer_mm = 0;
};

double value_of(const ProjectedStart& start, Quantity quantity) {
  return quantity == Quantity::Work        ? start.work_nmm
         : quantity == Quantity::PeakForce ? start.peak_force_n
                                           : start.peak_lateral_force_n;
}

bool same_member(const Member& a, const Member& b) {
  return a.values == b.values && a.grow_mm == b.grow_mm && a.centre_off_mm == b.centre_off_mm;
}

class Pieces final : public SmoothPieces {
 public:
  Pieces(const AssemblyProblem& problem, int topology, std::vector<double> values, std::vector<ProjectedStart> starts,
         std::vector<Lack> lacks)
      : problem_(problem),
        topology_(topology),
        values_(std::move(values)),
        starts_(std::move(starts)),
        lacks_(std::move(lacks)) {}

  int residuals() const override { return static_cast<int>(lacks_.size()); }
  int steps() const override { return kSteps; }
  // Of all that are near, every look takes the worst again.
  bool lasts(int) const override { return false; }

  bool evaluate(std::span<const double> values, double* residuals, double* jacobian) const override {
    const auto here = measured(values);
    if (!here) return false;
    if (jacobian) std::fill_n(jacobian, lacks_.size() * values.size(), 0.0);
    for (std::size_t i = 0; i < starts_.size(); ++i) {
      if (here->starts[i].outcome != starts_[i].outcome) return false;
    }
    for (std::size_t k = 0; k < lacks_.size(); ++k) {
      residuals[k] = std::max(0.0, lacking(lacks_[k], *here));
      if (!std::isfinite(residuals[k])) return false;
    }
    if (!jacobian) return true;
    bool any_slope = std::none_of(residuals, residuals + lacks_.size(), [](double r) { return r > 0; });
    for (std::size_t i = 0; i < values.size(); ++i) {
      const Beside low(*this, values, i, -1), high(*this, values, i, 1);
      for (std::size_t k = 0; k < lacks_.size(); ++k) {
        if (!(residuals[k] > 0)) continue;
        const auto slope = slope_of(lacks_[k], *here, low, high);
        jacobian[k * values.size() + i] = slope.value_or(0);
        any_slope = any_slope || slope;
      }
    }
    return any_slope;
  }

 private:
  const std::vector<int>& used() const { return problem_.topologies()[static_cast<std::size_t>(topology_)].variables; }

  static double lacking(const Lack& lack, const Measured& at) {
    const double value =
        lack.quantity == Quantity::Chamfer ? at.chamfer_mm : value_of(at.starts[lack.start], lack.quantity);
    return lack.weight * lack.sign * (value - lack.wanted);
  }
  // A step and two steps off in one variable, within its bounds; the second one only where it is asked for.
  class Beside {
   public:
    Beside(const Pieces& pieces, std::span<const double> values, std::size_t i, int way)
        : pieces_(pieces), values_(values.begin(), values.end()), i_(i), from_(values[i]) {
      const Variable& variable = pieces.problem_.variables()[static_cast<std::size_t>(pieces.used()[i])];
      const double room = way < 0 ? from_ - variable.min : variable.max - from_;
      step_ = way * std::min(kStep * (variable.max - variable.min), room / 2);
      if (step_ != 0) one_ = at(1);
    }
    double step() const { return step_; }
    const std::optional<Measured>& one() const { return one_; }
    const std::optional<Measured>& two() const {
      if (!is_looked_ && one_) two_ = at(2);
      is_looked_ = true;
      return two_;
    }

   private:
    std::optional<Measured> at(int steps) const {
      std::vector<double> values = values_;
      values[i_] = from_ + steps * step_;
      return pieces_.measured(values);
    }
    const Pieces& pieces_;
    std::vector<double> values_;
    std::size_t i_;
    double from_, step_ = 0;
    std::optional<Measured> one_;
    mutable std::optional<Measured> two_;
    mutable bool is_looked_ = false;
  };

  static bool continues(const Lack& lack, const Measured& a, const std::optional<Measured>& b) {
    return b && (lack.quantity == Quantity::Chamfer || a.starts[lack.start].history == b->starts[lack.start].history);
  }
  static bool ends_alike(const Lack& lack, const Measured& a, const std::optional<Measured>& b) {
    return b && a.starts[lack.start].outcome == b->starts[lack.start].outcome;
  }

  std::optional<double> slope_of(const Lack& lack, const Measured& here, const Beside& low, const Beside& high) const {
    const double value = lacking(lack, here);
    const bool is_low = continues(lack, here, low.one()), is_high = continues(lack, here, high.one());
    if (is_low || is_high) {
      const double before = is_low ? lacking(lack, *low.one()) : value;
      const double after = is_high ? lacking(lack, *high.one()) : value;
      const double slope = (after - before) / ((is_high ? high.step() : 0) - (is_low ? low.step() : 0));
      // Less lies behind a wall alone: the part ends otherwise there. What other variables gain is left.
      const bool is_walled =
          slope > 0 ? !is_low && !ends_alike(lack, here, low.one()) : !is_high && !ends_alike(lack, here, high.one());
      return is_walled ? 0 : slope;
    }
    // Of other histories: sides on which values go on straight, mean over both.
    double sum = 0;
    int sides = 0;
    for (const Beside* side : {&low, &high}) {
      if (!ends_alike(lack, here, side->one()) || !ends_alike(lack, here, side->two())) continue;
      const double one = lacking(lack, *side->one()), two = lacking(lack, *side->two());
      if (std::abs(2 * one - two - value) > kStraight * std::abs(two - value) + kRounding * lack.weight) continue;
      sum += (two - value) / (2 * side->step());
      ++sides;
    }
    return sides > 0 ? std::optional(sum / sides) : std::nullopt;
  }

  std::optional<Measured> measured(std::span<const double> of_candidate) const {
    std::vector<double> values = values_;
    for (std::size_t i = 0; i < of_candidate.size(); ++i) values[static_cast<std::size_t>(used()[i])] = of_candidate[i];
    const AssemblySpec& spec = problem_.spec();
    if (!defects(spec, topology_, values).empty()) return std::nullopt;
    Measured found{starts_, chamfer_mm(spec, topology_, values)};
    std::unique_ptr<Scene> scene;
    for (std::size_t i = 0; i < starts_.size(); ++i) {
      if (i == 0 || !same_member(starts_[i].member, starts_[i - 1].member))
        scene = scene_of(spec, topology_, values, "up", 0, starts_[i].member);
      if (!scene) return std::nullopt;
      found.starts[i] = projected_start(scene->task, starts_[i]);
    }
    return found;
  }

  const AssemblyProblem& problem_;
  int topology_;
  std::vector<double> values_;  // of all the problem's variables
  std::vector<ProjectedStart> starts_;
  std::vector<Lack> lacks_;
};

// The worst starts by a quantity, of every history and member one, as long as they are above a value.
std::vector<ProjectedStart> worst_starts(const std::vector<ProjectedStart>& starts, Quantity quantity, double above) {
  std::vector<const ProjectedStart*> sorted;
  for (const ProjectedStart& start : starts) {
    if (value_of(start, quantity) > above) sorted.push_back(&start);
  }
  std::stable_sort(sorted.begin(), sorted.end(), [&](const ProjectedStart* a, const ProjectedStart* b) {
    return value_of(*a, quantity) > value_of(*b, quantity);
  });
  std::vector<ProjectedStart> worst;
  for (const ProjectedStart* start : sorted) {
    const bool is_known = std::any_of(worst.begin(), worst.end(), [&](const ProjectedStart& w) {
      return w.history == start->history && same_member(w.member, start->member);
    });
    if (!is_known) worst.push_back(*start);
    if (worst.size() == kMostStarts) break;
  }
  return worst;
}

}  // namespace

bool AssemblyResiduals::has(const std::string& objective) { return quantity_of(objective).has_value(); }

std::unique_ptr<SmoothPieces> AssemblyResiduals::pieces(const Candidate& candidate, const SmoothAim& aim) const {
  const AssemblySpec& spec = problem_.spec();
  const std::vector<double> values = all_values(problem_, candidate);
  std::vector<ProjectedStart> projected, starts;
  const AssemblyEvaluation evaluation = judge(spec, candidate.topology, values, false, &projected).evaluation;
  if (projected.empty() || !(evaluation.metrics.success_fraction > 0)) return nullptr;
  const Metrics& metrics = spec.robust && evaluation.worst_case ? *evaluation.worst_case : evaluation.metrics;
  std::vector<Lack> lacks;
  // Whether it is lacking.
  const auto want = [&](const std::string& name, double wanted, double weight, double sign) {
    const auto quantity = quantity_of(name);
    if (!quantity) return false;
    const double by = sign * (objective(metrics, name) - wanted);
    if (*quantity == Quantity::Chamfer) {
      lacks.push_back({*quantity, 0, wanted, weight, sign});
    } else if (sign > 0) {  // nobody asks for peaks that are at least so high
      // Those below what is wanted by no more than the worst is above it may come to decide.
      for (const ProjectedStart& start : worst_starts(projected, *quantity, wanted - std::abs(by))) {
        lacks.push_back({*quantity, starts.size(), wanted, weight, sign});
        starts.push_back(start);
      }
    }
    return by > 0;
  };
  bool is_lacking = aim.objective && want(spec.objectives[*aim.objective].name, aim.value, 1, 1);
  for (std::size_t k = 0; k < aim.at_most.size(); ++k) {
    if (aim.at_most[k] && k != aim.objective)
      is_lacking |= want(spec.objectives[k].name, *aim.at_most[k] - kSpareOfLimit, kLimitWeight, 1);
  }
  bool is_out_of_bounds = false;
  for (const Bound& bound : spec.bounds) {
    if (bound.max) is_out_of_bounds |= want(bound.metric, *bound.max - kSpareOfLimit, kLimitWeight, 1);
    if (bound.min) is_out_of_bounds |= want(bound.metric, *bound.min + kSpareOfLimit, kLimitWeight, -1);
  }
  // Of a design that is infeasible for what has no residuals, less work is no gain.
  if (evaluation.feasible ? !is_lacking && !is_out_of_bounds : !is_out_of_bounds) return nullptr;
  return std::make_unique<Pieces>(problem_, candidate.topology, values, std::move(starts), std::move(lacks));
}

}  // namespace formotion::assembly
