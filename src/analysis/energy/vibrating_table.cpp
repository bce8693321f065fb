// Derived step by step in docs/nests.md, "Vibrating table". With K = (1 + e) / (1 - e) and k^2 = (K w)^2 / g the bound
// is k^2 A^2 / 2 + 1 / (2 k^2), or A where k^2 A < 1; both and their slopes agree at k^2 A = 1.
#include "analysis/energy/vibrating_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace formotion {
namespace {

bool moves(const VibratingTable& table) { return table.amplitude_mm > 0 && table.frequency_hz > 0; }

// k, in 1 / sqrt(mm).
double throwing(double frequency_hz, double restitution) {
  const double omega = 2 * std::numbers::pi * frequency_hz;
  return (1 + restitution) / (1 - restitution) * omega / std::sqrt(kGravity_mm_s2);
}

}  // namespace

double greatest_height_mm(const VibratingTable& table, double start_mm) {
  const double amplitude = std::max(table.amplitude_mm, 0.0);
  if (!moves(table)) return std::max(start_mm, amplitude);
  if (table.restitution >= 1) return std::numeric_limits<double>::infinity();
  const double k = throwing(table.frequency_hz, table.restitution);
  if (k * k * amplitude < 1) return std::max(start_mm, amplitude);
  const double thrown = k * amplitude;
  return std::max(start_mm, (thrown * thrown + 1 / (k * k)) / 2);
}

double amplitude_for_mm(double height_mm, double frequency_hz, double restitution) {
  if (!(height_mm > 0)) return 0;
  if (!(frequency_hz > 0)) return height_mm;
  if (restitution >= 1) return 0;
  const double k = throwing(frequency_hz, restitution);
  if (k * k * height_mm < 1) return height_mm;
  return std::sqrt(2 * height_mm - 1 / (k * k)) / k;
}

double greatest_rise_mm(const VibratingTable& table, double start_mm) {
  return greatest_height_mm(table, start_mm) + std::max(table.amplitude_mm, 0.0);
}

// k^2 A^2 / 2 + A + 1 / (2 k^2) = (k A + 1 / k)^2 / 2.
double amplitude_for_rise_mm(double rise_mm, double frequency_hz, double restitution) {
  if (!(rise_mm > 0)) return 0;
  if (!(frequency_hz > 0)) return rise_mm / 2;
  if (restitution >= 1) return 0;
  const double k = throwing(frequency_hz, restitution);
  if (k * k * rise_mm < 2) return rise_mm / 2;
  return (std::sqrt(2 * rise_mm) - 1 / k) / k;
}

}  // namespace formotion
