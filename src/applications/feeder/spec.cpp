#include "applications/feeder/spec.hpp"

namespace formotion::feeder {

std::string type_name(const FeatureSpec& feature) {
  static constexpr const char* kNames[] = {"balcony", "gap", "canyon", "slot", "cutout", "dish-out", "scallop", "drawing", "wiper", "hold-down"};
  static_assert(std::size(kNames) == std::variant_size_v<decltype(FeatureSpec::shape)>);
  return kNames[feature.shape.index()];
}

}  // namespace formotion::feeder
