#include "witness/bouncing_mass.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace formotion::witness {
namespace {

double omega(const VibratingTable& table) { return 2 * std::numbers::pi * table.frequency_hz; }

}  // namespace

double BouncingMass::phase() const { return omega(table) * time_s; }
double BouncingMass::table_mm() const { return table.amplitude_mm * std::sin(phase()); }
double BouncingMass::table_mm_s() const { return table.amplitude_mm * omega(table) * std::cos(phase()); }
double BouncingMass::energy_mm() const { return height_mm + speed_mm_s * speed_mm_s / (2 * kGravity_mm_s2); }

bool BouncingMass::to_next_impact() {
  const double w = omega(table), a = table.amplitude_mm, most = kGravity_mm_s2 + a * w * w;
  const double lift = kGravity_mm_s2 / (a * w * w);  // the mass leaves a table that it rides on at this sine
  double flown = 0;
  const double above = height_mm - table_mm(), away = speed_mm_s - table_mm_s();
  if (!lifts && above < 1e-9 && std::abs(away) < 1e-6 && std::sin(phase()) < lift) {
    if (lift >= 1) {
      rides = true;
      return false;
    }
    const double turn = 2 * std::numbers::pi, at = std::asin(lift);
    const double wait = std::fmod(std::fmod(at - phase(), turn) + turn, turn);
    time_s = std::fmod(time_s + wait / w, turn / w);
    height_mm = table_mm();
    speed_mm_s = before_mm_s = table_mm_s();
    lifts = true;
    return false;
  }
  lifts = false;
  // The gap's second derivative is never below -most, so a step to the root of gap + rate t - most t^2 / 2 cannot jump
  // over an impact. From a lift-off, where gap and rate are 0 and the gap grows, a first short step is safe.
  if (above < 1e-9 && std::abs(away) < 1e-6) flown = 1e-3 / w;
  for (int i = 0; i < 200000; ++i) {
    const double t = time_s + flown;
    const double gap = height_mm + flown * (speed_mm_s - kGravity_mm_s2 * flown / 2) - a * std::sin(w * t);
    const double rate = speed_mm_s - kGravity_mm_s2 * flown - a * w * std::cos(w * t);
    if (gap < 1e-11 && rate <= 0) break;
    const double step = (rate + std::sqrt(rate * rate + 2 * most * std::max(gap, 0.0))) / most;
    flown += std::max(step, 1e-14);
  }
  time_s += flown;
  before_mm_s = speed_mm_s - kGravity_mm_s2 * flown;
  height_mm = table_mm();
  speed_mm_s = table_mm_s() + table.restitution * (table_mm_s() - before_mm_s);
  time_s = std::fmod(time_s, 1 / table.frequency_hz);  // phases alone matter, and stay exact
  return true;
}

BouncingMass mass_on(const VibratingTable& table, double phase_rad, double over_table_mm, double speed_mm_s) {
  BouncingMass mass;
  mass.table = table;
  mass.time_s = phase_rad / omega(table);
  mass.height_mm = mass.table_mm() + over_table_mm;
  mass.speed_mm_s = mass.before_mm_s = speed_mm_s;
  return mass;
}

}  // namespace formotion::witness
