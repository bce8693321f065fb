#include "applications/nest/spec.hpp"

namespace formotion::nest {

std::span<const Objective> known_objectives(Purpose purpose) {
  static const std::vector<Objective> fixture{{"seated_fraction", true, 1e-3},
                                              {"repeatability_mm", false, 1e-3},
                                              {"wrong_equilibria", false, 0.5, true},
                                              {"resisted_weights", true, 1e-3}};
  static const std::vector<Objective> pallet{{"selectivity_mm", true, 1e-2},
                                             {"capture_fraction", true, 1e-3},
                                             {"goal_escape_height_mm", true, 1e-2},
                                             {"worst_wrong_escape_height_mm", false, 1e-2}};
  return purpose == Purpose::Fixture ? fixture : pallet;
}

}  // namespace formotion::nest
