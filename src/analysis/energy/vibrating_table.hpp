// How high a vibrating table can throw what lies on it (derived in docs/nests.md): a bound for point masses on level
// floors, a rule of thumb for bodies that turn, floors that slope and walls with friction.
#pragma once

namespace formotion {

inline constexpr double kGravity_mm_s2 = 9806.65;

// Moves as A sin(2 pi f t) along gravity. A frequency of 0 is the limit of slow motion.
struct VibratingTable {
  double amplitude_mm = 0, frequency_hz = 0;
  double restitution = 0;  // of impacts, [0, 1]
};

// The greatest height over the table's mean level that a point mass can reach which starts on it with no more than
// start_mm of energy over weight. Infinite for restitution 1 on a table that moves.
double greatest_height_mm(const VibratingTable& table, double start_mm = 0);

// The largest amplitude at this frequency and restitution whose greatest height is at most height_mm; 0 if none.
double amplitude_for_mm(double height_mm, double frequency_hz, double restitution);

// The same over the table itself, which may be at its lowest when the mass is at its highest: what compares with the
// escape height of a nest that moves with the table.
double greatest_rise_mm(const VibratingTable& table, double start_mm = 0);
double amplitude_for_rise_mm(double rise_mm, double frequency_hz, double restitution);

}  // namespace formotion
