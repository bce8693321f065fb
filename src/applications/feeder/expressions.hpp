// The expressions of a feeder's features and part: which variables they use, what they are worth.
#pragma once

#include <span>
#include <variant>
#include <vector>

#include "applications/feeder/spec.hpp"

namespace formotion::feeder {

// Calls visit on every expression of a feature.
struct Expressions {
  template <class Visit>
  static void each(FeatureSpec& f, const Visit& visit) {
    if (f.at_mm) visit(*f.at_mm);
    std::visit([&](auto& shape) { of(shape, visit); }, f.shape);
  }
  template <class V>
  static void of(Balcony& s, const V& v) {
    v(s.width_mm);
    v(s.length_mm);
  }
  template <class V>
  static void of(Gap& s, const V& v) {
    v(s.length_mm);
  }
  template <class V>
  static void of(Canyon& s, const V& v) {
    v(s.from_mm);
    v(s.to_mm);
    v(s.length_mm);
  }
  template <class V>
  static void of(Slot& s, const V& v) {
    v(s.from_mm);
    v(s.to_mm);
    v(s.length_mm);
  }
  template <class V>
  static void of(Cutout& s, const V& v) {
    loop(s.polygon_mm, v);
  }
  template <class V>
  static void of(DishOut& s, const V& v) {
    v(s.depth_mm);
    v(s.length_mm);
  }
  template <class V>
  static void of(Scallop& s, const V& v) {
    v(s.depth_mm);
    v(s.half_angle_rad);
  }
  template <class V>
  static void of(Drawing&, const V&) {}
  template <class V>
  static void of(Wiper& s, const V& v) {
    v(s.height_mm);
  }
  template <class V>
  static void of(HoldDown& s, const V& v) {
    v(s.height_mm);
    v(s.length_mm);
  }
  template <class V>
  static void of(Fence& s, const V& v) {
    loop(s.polygon_mm, v);
  }
  template <class V>
  static void of(WallProfile& s, const V& v) {
    loop(s.profile_mm, v);
  }
  template <class V>
  static void of(Pin& s, const V& v) {
    v(s.x_mm);
    v(s.y_mm);
    v(s.diameter_mm);
  }
  template <class V>
  static void loop(AffineLoop& points, const V& v) {
    for (AffinePoint& p : points) {
      v(p[0]);
      v(p[1]);
    }
  }
};

// Ascending indices of the problem's variables, each once.
std::vector<int> variables_of(const PartSpec& part);
std::vector<int> variables_of(const FeatureSpec& feature);
// "balcony + cutout", with the variables of the part, too; "cutout(4)" where cut-outs differ in their corners.
std::vector<Topology> topologies_of(const FeederSpec& spec);
FeatureSpec literal(FeatureSpec feature, std::span<const double> values);

}  // namespace formotion::feeder
