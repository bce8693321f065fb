// How uncertain may the values be until a design is not feasible for all of them?
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "applications/feeder/spec.hpp"

namespace formotion::feeder {

class FeederProblem;

// A value's half-width, or its interval. None where nothing up to kMostScale times what is given makes a difference.
struct AloneLimit {
  std::string name;
  std::optional<double> half_width;
  std::optional<std::pair<double, double>> interval;
};

struct UncertaintyLimits {
  std::optional<double> scale;  // of all together; none as above
  std::vector<AloneLimit> alone;
};

inline constexpr double kMostScale = 16;

// All half-widths times this, and intervals stretched by it about the environment's values, within what they may be.
Uncertainty scaled(const Uncertainty& uncertainty, const Environment& environment, double factor);

// is_feasible: whether a design is, at the worst of these; true without any. monotone: if it is not for some, it is not
// for larger ones: then limits are found by halving, to a thousandth. Otherwise at the rungs of a ladder (an eighth,
// times 2 each) up to the first that fails, and between the last two by halving, to a twentieth.
UncertaintyLimits uncertainty_limits(const Uncertainty& uncertainty, const Environment& environment, bool monotone,
                                     const std::function<bool(const Uncertainty&)>& is_feasible);

// Of one design of the problem; none if it is not feasible as drawn, or if nothing is uncertain. values: of all the
// problem's variables.
std::optional<UncertaintyLimits> uncertainty_limits(const FeederProblem& problem, int topology,
                                                    std::span<const double> values);

}  // namespace formotion::feeder
