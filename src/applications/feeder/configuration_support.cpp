#include "applications/feeder/configuration_support.hpp"

#include "applications/feeder/pose_travel.hpp"

namespace formotion::feeder {

Track track_of(const Layout& layout, const Environment& environment) {
  Track track{environment.track_width_mm, {}};
  for (const VoidGroup& group : grouped(layout, 0)) {
    for (const Loop& loop : group.loops) {
      if (signed_area(loop) > 0) {
        track.voids.push_back({loop, {}});
      } else {  // a hole lies in the void that contains it
        for (Polygon& polygon : track.voids) {
          if (locate(polygon.outer, loop.front(), 0) == Side::Inside) polygon.holes.push_back(loop);
        }
      }
    }
  }
  return track;
}

SupportAnswer support_at(const AspectShape& shape, const Track& track, const Environment& environment,
                         const Configuration& q) {
  const Polygon placed_part = placed(shape.footprint, q.theta_rad, {q.x_mm, q.y_mm});
  const Point supported(q.x_mm, q.y_mm - wall_shift(shape.com_height_mm, environment));
  const std::optional<double> margin = support_margin(placed_part, track, supported);
  return {margin && *margin >= kLost_mm, margin};
}

}  // namespace formotion::feeder
