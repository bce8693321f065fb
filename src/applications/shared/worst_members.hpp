// The worst case over uncertain quantities, by the ends of their intervals: not proved for what lies between them.
#pragma once

#include <functional>

#include "applications/shared/asked.hpp"

namespace formotion {

// Judges every quantity at each end of its interval alone, then all of them at their worse ends at once. loss: larger
// is worse; it may gather what it likes. Returns the name of the quantity that is worst alone, none if nothing is
// uncertain. centre_name: what the uncertainty of the reference point is called.
std::optional<std::string> judge_ends(const ShapeUncertainty& uncertainty, const std::string& centre_name,
                                      double nominal_loss, const std::function<double(const Member&)>& loss);

}  // namespace formotion
