#include "analysis/motion/path_step.hpp"

#include <cmath>

namespace formotion {

double chord(const Configuration& a, const Configuration& b, double reach) {
  return std::hypot(a.x_mm - b.x_mm, a.y_mm - b.y_mm, reach * (a.theta_rad - b.theta_rad));
}

bool step_to(const GuidedPath& path, FlowStep& step, double h, const Configuration& end, double reach_mm) {
  step.h = h;
  step.end = end;
  step.rate_end = path.rate(h, step.end);
  if (!std::isfinite(step.end.x_mm) || !std::isfinite(step.end.y_mm) || !std::isfinite(step.rate_end.angular))
    return false;
  const Configuration middle = path.at(h / 2);
  const auto cubic = [h](double a, double da, double b, double db) { return (a + b) / 2 + h * (da - db) / 8; };
  const Configuration guess{cubic(step.start.x_mm, step.rate.linear.x(), step.end.x_mm, step.rate_end.linear.x()),
                            cubic(step.start.y_mm, step.rate.linear.y(), step.end.y_mm, step.rate_end.linear.y()),
                            cubic(step.start.theta_rad, step.rate.angular, step.end.theta_rad, step.rate_end.angular)};
  step.chord_mm = chord(middle, guess, reach_mm);
  return step.chord_mm <= kLongestChord_mm;
}

}  // namespace formotion
