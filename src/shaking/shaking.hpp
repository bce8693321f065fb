// A nest shaken with a part in it, simulated in an independent rigid-body engine (Box2D): whether the part leaves.
// A witness by samples: nothing is proved, and roundings decide after a few impacts, as dust would. The corners of a
// side that lands flat meet its floor at once, so symmetric parts may bounce upright for seconds; shake long, and with
// several seeds.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "analysis/contact/configuration.hpp"
#include "analysis/energy/gravity.hpp"
#include "analysis/energy/vibrating_table.hpp"
#include "analysis/geometry/polygon.hpp"

namespace formotion {

struct ShakenScene {
  Polygon part;               // relative to its centre of mass
  std::vector<Polygon> nest;  // may overlap
  Gravity gravity;
  double friction = 0.2;
  VibratingTable table;
};

struct ShakeOptions {
  double seconds = 10;
  double step_s = 1e-4;
  std::uint64_t seed = 1;  // of the start's small disturbance and the table's phase
  // Once in each look_every_s it is asked of the rest that the part would sink to, were the table stopped (settled). A
  // run ends at two yeses in turn. Empty: not asked.
  std::function<bool(const Configuration&)> is_right;
  double look_every_s = 1;
};

// At most one of both times: a run ends with either.
struct Shaken {
  std::optional<double> left_after_s;   // its centre of mass was beyond the nest across gravity
  std::optional<double> right_after_s;  // it had come to where is_right says yes
  double highest_mm = 0;                // rise of the centre of mass over its start, relative to the nest
  Configuration last;                   // relative to the nest
};
Shaken shake(const ShakenScene& scene, const Configuration& start, const ShakeOptions& options = {});

// Where a part let go at rest sinks to in a nest that does not move, without friction and restitution; where it has got
// to after two seconds if it does not rest by then.
Configuration settled(const ShakenScene& scene, const Configuration& from, double step_s = 1e-4);

// The 95 % interval of a share that was seen `count` times in `runs` (Wilson 1927).
struct ShareInterval {
  double low = 0, high = 1;
};
ShareInterval wilson_95(int count, int runs);

// runs different seeds; the share that left, or came to where is_right says yes.
struct ShakenShare {
  int runs = 0, left = 0, right = 0;
  double share = 0, low = 0, high = 1;  // of left and right together
  double mean_seconds = 0;              // until then, of those
  double last_seconds = 0;              // the longest of them
  double highest_mm = 0;                // of all runs
};
ShakenShare share_that_leaves(const ShakenScene& scene, const Configuration& start, int runs,
                              const ShakeOptions& options = {});

}  // namespace formotion
