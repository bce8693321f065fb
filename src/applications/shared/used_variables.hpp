// Which variables expressions use, and shapes with their values in place.
#pragma once

#include <set>
#include <span>

#include "applications/shared/part_spec.hpp"

namespace formotion {

inline void collect(const Affine& a, std::set<int>& used) {
  for (const auto& term : a.terms) used.insert(term.first);
}

inline void collect(const AffineLoop& loop, std::set<int>& used) {
  for (const AffinePoint& p : loop) {
    collect(p[0], used);
    collect(p[1], used);
  }
}

inline void collect(const PartSpec& part, std::set<int>& used) {
  for (const AspectSpec& aspect : part.aspects) {
    collect(aspect.outline_mm, used);
    for (const AffineLoop& hole : aspect.holes_mm) collect(hole, used);
  }
}

inline AffineLoop literal_loop(const AffineLoop& loop, std::span<const double> values) {
  AffineLoop points;
  for (const AffinePoint& p : loop) points.push_back({Affine{p[0](values), {}}, Affine{p[1](values), {}}});
  return points;
}

}  // namespace formotion
