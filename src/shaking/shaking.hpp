// A nest shaken with a part in it, simulated in an independent rigid-body engine (Box2D): whether the part leaves.
// A witness by samples: nothing is proved, and roundings decide after a few impacts, as dust would. The corners of a
// side that lands flat meet its floor at once, so symmetric parts may bounce upright for seconds; shake long, and with
// several seeds.
#pragma once

#include <cstdint>
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
};

struct Shaken {
  std::optional<double> left_after_s;  // its centre of mass was beyond the nest across gravity
  double highest_mm = 0;               // rise of the centre of mass over its start, relative to the nest
  Configuration last;                  // relative to the nest
};
Shaken shake(const ShakenScene& scene, const Configuration& start, const ShakeOptions& options = {});

// runs different seeds; the share that left, with its 95 % interval (Wilson 1927).
struct ShakenShare {
  int runs = 0, left = 0;
  double share = 0, low = 0, high = 1;
  double mean_seconds = 0;  // until leaving, of those that left
  double highest_mm = 0;    // of all runs
};
ShakenShare share_that_leaves(const ShakenScene& scene, const Configuration& start, int runs,
                              const ShakeOptions& options = {});

}  // namespace formotion
