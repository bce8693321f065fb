#include "applications/assembly/spec.hpp"

namespace formotion::assembly {

std::span<const Objective> known_objectives() {
  static const std::vector<Objective> known{{"success_fraction", true, 1e-3}, {"capture_mm", true, 1e-3},
                                            {"chamfer_mm", false, 1e-3},      {"capture_deg", true, 1e-3},
                                            {"depth_margin_mm", true, 1e-3},  {"peak_force_n", false, 1e-4},
                                            {"work_nmm", false, 1e-4},        {"peak_lateral_force_n", false, 1e-4}};
  return known;
}

}  // namespace formotion::assembly
