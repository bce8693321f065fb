#include "applications/feeder/travel_picture.hpp"

#include "applications/feeder/part_model.hpp"
#include "applications/feeder/tolerance.hpp"
#include "applications/feeder/track_layout.hpp"

namespace formotion::feeder {

std::vector<PosePicture> travel_pictures(const FeederProblem& problem, int topology, std::span<const double> values) {
  const FeederSpec& spec = problem.spec();
  const PartModel part = part_model(spec.part, spec.environment, values);
  const Layout layout = lay_out(spec.designs[static_cast<std::size_t>(topology)], spec.environment, spec.manufacture,
                                part.diameter_mm, values);
  std::vector<VoidOutline> outlines;
  for (const VoidGroup& group : grouped(layout, part.longest_mm)) outlines.push_back(VoidOutline::of(group.loops));

  std::vector<PosePicture> pictures;
  for (const PoseModel& pose : part.poses) {
    PosePicture picture;
    picture.stable = pose.stable;
    picture.footprint = pose.footprint;
    picture.bodies = pose.bodies;
    picture.x_min_mm = pose.x_min;
    picture.x_max_mm = pose.x_max;
    picture.supported_y_mm = pose.travelling.supported_y_mm;
    picture.plain_hull = convex_hull(pose.travelling.corners);
    picture.plain_margin_mm = pose.travelling.plain_margin_mm;
    picture.held = held_intervals(pose, layout);
    for (const VoidOutline& outline : outlines) {
      GeneratorSet set;
      collect_generators({pose.travelling, outline, picture.held}, set);
      picture.groups.push_back({set.events.front(), set.events.back(), std::move(set.generators)});
    }
    pictures.push_back(std::move(picture));
  }
  return pictures;
}

}  // namespace formotion::feeder
