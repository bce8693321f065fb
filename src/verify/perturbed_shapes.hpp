// Shapes made a little wrong: every corner somewhere else; what is then claimed of the design is asked again.
#pragma once

#include <functional>

#include "applications/shared/asked.hpp"
#include "verify/verification.hpp"

namespace formotion {

struct PerturbedMember {
  bool usable = true, feasible = false;
  std::optional<double> figure;   // the least of them is told
  std::string why;                // of what is not feasible
  nlohmann::ordered_json design;  // of what is not feasible: a design file
};

// The part's own errors count as the shapes', as in the worst case; 0.02 mm where the problem says nothing. stream: of
// random numbers, one a design. figure: what the least figure is.
Check check_perturbed_shapes(
    const std::vector<Loop>& shapes, const ShapeUncertainty& uncertainty, std::uint64_t stream,
    const std::string& figure, const VerifyOptions& options,
    const std::function<PerturbedMember(const std::vector<Loop>& shapes, double most_mm)>& judged);

}  // namespace formotion
