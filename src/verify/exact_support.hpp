// Support decided by exact arithmetic: is the supported point in the hull of part and metal? No tolerance but the grid
// that shapes are rounded to, so that what is meant to touch touches. CGAL stays behind this wall.
#pragma once

#include <memory>
#include <vector>

#include "analysis/geometry/polygon.hpp"

namespace formotion {

// Coordinates are rounded to multiples of this (6e-8 mm) before anything is decided: their sums are then exact, too.
inline constexpr double kExactGrid_mm = 0x1p-24;
double on_exact_grid(double value_mm);

enum class ExactSupport {
  Held,
  Lost,
  Marginal,  // within kExactMarginal_mm of the hull's boundary
};
inline constexpr double kExactMarginal_mm = 1e-6;

// The strip 0 <= y <= width_mm without the voids. Metal is closed, but has area everywhere: voids that share an edge
// leave nothing between them.
class ExactTrack {
 public:
  // voids: the void on the left; they may overlap.
  ExactTrack(double width_mm, const std::vector<Loop>& voids);
  ExactTrack(ExactTrack&&) noexcept;
  ~ExactTrack();

  // part and supported point as they are at x = 0, moved along by x_mm. Lost also where part and metal have no point
  // in common.
  ExactSupport support(const Polygon& part, const Point& supported, double x_mm) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace formotion
