// Support of one configuration on a laid-out track.
#pragma once

#include "analysis/constraints/planar_support.hpp"
#include "applications/feeder/part_model.hpp"
#include "applications/feeder/track_layout.hpp"

namespace formotion::feeder {

// The strip with all voids of the layout, united where they overlap.
Track track_of(const Layout& layout, const Environment& environment);
SupportAnswer support_at(const AspectShape& shape, const Track& track, const Environment& environment,
                         const Configuration& q);

}  // namespace formotion::feeder
