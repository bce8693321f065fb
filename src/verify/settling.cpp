#include "verify/settling.hpp"

#include <cmath>
#include <numbers>

#include "analysis/contact/configuration.hpp"

namespace formotion {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

double heading(const Point& along) { return std::atan2(along.y(), along.x()); }

}  // namespace

std::optional<double> settled(const Loop& hull, double friction, double start_rad) {
  const std::size_t n = hull.size();
  std::size_t corner = 0;
  for (std::size_t i = 1; i < n; ++i) {
    if (rotated(hull[i], start_rad).y() < rotated(hull[corner], start_rad).y()) corner = i;
  }
  // The wall's force on a corner leans back by atan friction; its moment about the centre of mass turns the part.
  const auto moment = [&](std::size_t i, double theta) {
    const Point at = rotated(hull[i], theta);
    return at.x() + friction * at.y();
  };
  double theta = start_rad;
  const bool left = moment(corner, theta) > 0;
  for (std::size_t steps = 0; steps < 4 * n; ++steps) {
    // Turns about the corner until its edge on that side lies on the wall; then the edge's other corner carries.
    const std::size_t other = left ? (corner + n - 1) % n : (corner + 1) % n;
    const Point along = left ? Point(hull[corner] - hull[other]) : Point(hull[other] - hull[corner]);
    theta = -heading(along);
    const double beyond = moment(other, theta);
    if (left ? beyond <= 0 : beyond >= 0) {
      const double rest = std::fmod(theta, kTurn);
      return rest < 0 ? rest + kTurn : rest;
    }
    corner = other;
  }
  return std::nullopt;
}

}  // namespace formotion
