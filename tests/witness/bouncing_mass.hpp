// A point mass that bounces on a table moving as A sin(w t), from impact to impact: ballistic flight against a
// sinusoid, no time steps. A slow and obviously right answer for what vibration throws.
#pragma once

#include "analysis/energy/vibrating_table.hpp"

namespace formotion::witness {

struct BouncingMass {
  VibratingTable table;
  double time_s = 0;
  double height_mm = 0, speed_mm_s = 0;  // over the mean level, upwards
  double before_mm_s = 0;                // speed before the latest impact
  bool lifts = false;                    // has just been left by a table that it rode on
  bool rides = false;                    // on a table that will never throw it again

  double phase() const;
  double table_mm() const;
  double table_mm_s() const;
  double energy_mm() const;  // over weight
  // To just after the next impact (true), or to the next lift-off after riding on the table (false).
  bool to_next_impact();
};

BouncingMass mass_on(const VibratingTable& table, double phase_rad, double over_table_mm, double speed_mm_s);

}  // namespace formotion::witness
