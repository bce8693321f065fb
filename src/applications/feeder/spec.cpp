#include "applications/feeder/spec.hpp"

namespace formotion::feeder {

std::string type_name(const FeatureSpec& feature) {
  static constexpr const char* kNames[] = {"balcony", "gap",   "canyon",    "slot",  "cutout", "dish-out", "scallop",
                                           "drawing", "wiper", "hold-down", "fence", "wall",   "pin"};
  static_assert(std::size(kNames) == std::variant_size_v<decltype(FeatureSpec::shape)>);
  return kNames[feature.shape.index()];
}

const char* name(Must must) {
  switch (must) {
    case Must::Free:
      return "free";
    case Must::Blocked:
      return "blocked";
    case Must::Supported:
      return "supported";
    case Must::Unsupported:
      return "unsupported";
  }
  return "free";
}

std::span<const Objective> known_objectives() {
  static const std::vector<Objective> kObjectives{
      {"efficiency", true, 1e-9, true}, {"tolerance_mm", true, 0.01, false},    {"length_mm", false, 0.5, false},
      {"margin_mm", true, 0.01, false}, {"feed_rate_per_min", true, 0.1, true}, {"feature_count", false, 0, true},
  };
  return kObjectives;
}

}  // namespace formotion::feeder
