#include "applications/nest/drops.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/contact/clearance.hpp"

namespace formotion::nest {
namespace {

NestOutcome outcome_of(const Scene& scene, const Configuration& seat, double within_mm, const Projection& way) {
  switch (way.end) {
    case ProjectionEnd::AtRest:
      return apart_mm(scene, way.last, seat) <= within_mm ? NestOutcome::Seated : NestOutcome::Misseated;
    case ProjectionEnd::Steady:
      return NestOutcome::Escaped;
    case ProjectionEnd::Ambiguous: {
      std::optional<NestOutcome> one;
      if (way.may_rest)
        one = apart_mm(scene, way.last, seat) <= within_mm ? NestOutcome::Seated : NestOutcome::Misseated;
      for (const Projection& branch : way.branches) {
        const NestOutcome outcome = outcome_of(scene, seat, within_mm, branch);
        if (one && *one != outcome) return NestOutcome::Ambiguous;
        one = outcome;
      }
      return one.value_or(NestOutcome::Ambiguous);
    }
    case ProjectionEnd::Undecided:
    case ProjectionEnd::Stopped:
      break;
  }
  return NestOutcome::Undecided;
}

Projection sunk(const Scene& scene, double friction, const Configuration& start, Funnels* funnels) {
  ProjectionOptions options;
  options.keep_path = false;
  options.funnels = funnels;
  return project(*scene.space, {scene.gravity.down, friction}, start, options);
}

}  // namespace

DropEnd dropped(const Scene& scene, const Configuration& seat, double within_mm, const Configuration& start,
                Funnels* funnels) {
  if (!is_free(scene.part, scene.obstacles, start)) return {NestOutcome::Blocked, start, 0};
  const Projection way = sunk(scene, scene.friction, start, funnels);
  return {outcome_of(scene, seat, within_mm, way), way.last, way.history};
}

std::vector<double> drop_shares(const Scene& scene, const std::vector<NestRest>& rests, double within_mm, int across,
                                int turns) {
  double top = -std::numeric_limits<double>::infinity();
  for (const Polygon& area : scene.obstacles.areas) {
    for (const Point& p : area.outer) top = std::max(top, scene.gravity.height_mm(p));
  }
  top += scene.part.reach_mm * 1.01;
  const Point aside = turned_left(scene.gravity.down);
  std::vector<double> shares(rests.size() + 1, 0);
  Funnels funnels;
  const double each = 1.0 / (across * turns);
  for (int i = 0; i < across; ++i) {
    const double place = std::lerp(scene.outside.from_mm, scene.outside.to_mm, (i + 0.5) / across);
    for (int k = 0; k < turns; ++k) {
      const Point from = place * aside - top * scene.gravity.down;
      const Projection way = sunk(scene, 0, {from.x(), from.y(), 2 * std::numbers::pi * (k + 0.5) / turns}, &funnels);
      std::size_t nearest = rests.size();
      double least = within_mm;
      if (way.end == ProjectionEnd::AtRest) {
        for (std::size_t r = 0; r < rests.size(); ++r) {
          const double apart = apart_mm(scene, way.last, rests[r]);
          if (apart <= least) {
            least = apart;
            nearest = r;
          }
        }
      }
      shares[nearest] += each;
    }
  }
  return shares;
}

Filling filling(const std::vector<RestFate>& fates) {
  // Right ones absorb, wrong ones that stay too; all others are dropped again.
  double right = 0, trapped = 0;
  for (const RestFate& fate : fates) {
    if (fate.leaves) continue;
    (fate.is_right ? right : trapped) += fate.share;
  }
  Filling result;
  if (!(right > 0)) return result;
  result.right_share = right / (right + trapped);
  if (trapped == 0) result.drops_per_part = 1 / right;
  return result;
}

}  // namespace formotion::nest
