#include "optimize/hypervolume.hpp"

#include <algorithm>
#include <pagmo/utils/hypervolume.hpp>

namespace formotion {
namespace {

bool better_everywhere(const LossPoint& point, std::span<const double> reference) {
  for (std::size_t k = 0; k < reference.size(); ++k) {
    if (!(point[k] < reference[k])) return false;
  }
  return true;
}

}  // namespace

double hypervolume(const std::vector<LossPoint>& points, std::span<const double> reference) {
  std::vector<LossPoint> better;
  for (const LossPoint& point : points) {
    if (better_everywhere(point, reference)) better.push_back(point);
  }
  if (better.empty()) return 0;
  std::sort(better.begin(), better.end());
  better.erase(std::unique(better.begin(), better.end()), better.end());
  LossPoint corner(reference.begin(), reference.end());
  if (corner.size() == 1) {  // pagmo begins at two objectives: a second one of extent 1 changes no volume
    for (LossPoint& point : better) point.push_back(0);
    corner.push_back(1);
  }
  return pagmo::hypervolume(better).compute(corner);
}

LossRange loss_range(const std::vector<LossPoint>& points) {
  LossRange range{points.front(), points.front()};
  for (const LossPoint& point : points) {
    for (std::size_t k = 0; k < point.size(); ++k) {
      range.best[k] = std::min(range.best[k], point[k]);
      range.worst[k] = std::max(range.worst[k], point[k]);
    }
  }
  return range;
}

double normalised_hypervolume(const std::vector<LossPoint>& points, const LossRange& range) {
  std::vector<LossPoint> units;
  for (const LossPoint& point : points) {
    LossPoint unit;
    for (std::size_t k = 0; k < point.size(); ++k) {
      const double extent = range.worst[k] - range.best[k];
      const double beyond = point[k] - range.best[k];
      unit.push_back(extent > 0 ? std::max(0.0, beyond / extent) : beyond > 0 ? 1.0 : 0.0);
    }
    units.push_back(std::move(unit));
  }
  return std::min(1.0, hypervolume(units, std::vector<double>(range.best.size(), 1.0)));
}

}  // namespace formotion
