#include "verify/drawn_shapes.hpp"

#include <algorithm>
#include <cmath>

#include "io/dxf_import.hpp"

namespace formotion {
namespace {

// How far corners of the one are from the other's edges.
double away_mm(const std::vector<Loop>& corners_of, const std::vector<Loop>& edges_of) {
  double away = 0;
  for (const Loop& loop : corners_of) {
    for (const Point& p : loop) {
      double nearest = 1e300;
      for (const Loop& other : edges_of) {
        for (std::size_t i = 0; i < other.size(); ++i)
          nearest = std::min(nearest, distance_to_segment(p, other[i], other[(i + 1) % other.size()]));
      }
      away = std::max(away, nearest);
    }
  }
  return away;
}

}  // namespace

double apart_mm(const std::vector<Loop>& a, const std::vector<Loop>& b) {
  return std::max(away_mm(a, b), away_mm(b, a));
}

DrawnShapes read_back(const std::string& dxf) {
  DxfOptions options;
  options.layers = {"FIXED", "PART"};
  DrawnShapes read;
  for (DxfContour& contour : parse_dxf(dxf, "the drawing", options))
    (contour.layer == "FIXED" ? read.fixed : read.part).push_back(std::move(contour.points_mm));
  std::stable_sort(read.part.begin(), read.part.end(),
                   [](const Loop& a, const Loop& b) { return std::abs(signed_area(a)) > std::abs(signed_area(b)); });
  return read;
}

}  // namespace formotion
