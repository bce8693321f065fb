// The part when its numbers are uncertain: every pose that some member rests in, how probable it is at least and at
// most, the material that all members have there and the one that some have.
#pragma once

#include "applications/feeder/part_model.hpp"

namespace formotion::feeder {

struct PartSpread {
  Uncertainty uncertainty;
  std::pair<double, double> speed_mm_s;  // least and most
  struct Pose {
    int nominal = -1;     // its index in the part model; -1: the part as drawn does not rest in it
    double away_mm = 0;   // how far the supported point may be from the one of `least` and `most`
    bool remains = true;  // some material is in all members
    double least_prior = 0, most_prior = 0;
  };
  std::vector<Pose> poses;  // the part model's first, in its order
  // Of all these poses: the footprint that every member has, and the one that holds every member's. Their extents along
  // the track are the adverse ones for rails: of `least` the longest, of `most` the shortest.
  PartModel least, most;
};

PartSpread part_spread(const PartModel& part, const Environment& environment, const Uncertainty& uncertainty);

// All that is uncertain together, and every value alone.
struct Spreads {
  PartSpread all;
  std::vector<std::pair<std::string, PartSpread>> alone;
};
Spreads spreads_of(const PartModel& part, const Environment& environment, const Uncertainty& uncertainty);

// The keys of what is uncertain, as in a problem file: "outline_mm", "com_mm", "feature_mm", then intervals.
std::vector<std::string> uncertain_values(const Uncertainty& uncertainty);
Uncertainty only(const Uncertainty& uncertainty, const std::string& name);

// The poses with these numbers alone.
PartModel chosen_poses(const PartModel& part, const std::vector<int>& poses);

// A member: the outline's edges moved out by outline_mm, the centre of mass by com_mm. Poses keep their orientations.
PartModel member_of(const PartModel& part, const Environment& environment, double outline_mm, const Point& com_mm);

// The environment with one uncertain value ("wall_friction", "drive_deg", ...) in place of its own.
void set_value(Environment& environment, const std::string& name, double value);
double value_of(const Environment& environment, const std::string& name);

}  // namespace formotion::feeder
