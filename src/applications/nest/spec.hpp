// A nest as asked for: the part, the fixed shapes that are to seat it (fixture) or to keep it while they are shaken
// (pallet), gravity or a push, the seat. Filled by io, read by the nest application. mm, rad, s.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "applications/shared/asked.hpp"
#include "applications/shared/part_spec.hpp"
#include "problem/problem.hpp"

namespace formotion::nest {

enum class Purpose { Fixture, Pallet };

struct TableSpec {
  double amplitude_mm = 0, frequency_hz = 0;
  Number restitution;
};

struct Environment {
  Number gravity_deg{{-90, {}}, {}};  // direction of gravity, or of the push
  Number friction{{0.2, {}}, {}};
  Number tilt_deg;                  // pallets: added to gravity's direction
  Number restitution{{1, {}}, {}};  // fixtures; pallets: the table's
  std::optional<TableSpec> table;
};

struct SeatSpec {
  std::string aspect;
  AffinePoint at_mm;  // of the centre of mass
  double orientation_rad = 0;
  // A part is seated if none of its points is farther than this from where it is in the seat.
  double within_mm = 1;
  double near_mm = 0.05;  // a rest this near to the seat as written is the seat's
};

struct GoalSpec {
  SeatSpec seat;
  StartsSpec starts;  // from the seat, along the world's axes; turned about the centre of mass
};

struct DesignSpec {
  std::vector<AffineLoop> nest_mm;
};

struct NestSpec {
  Purpose purpose = Purpose::Fixture;
  PartSpec part;
  Environment environment;
  GoalSpec goal;
  std::vector<Bound> bounds;
  ShapeUncertainty uncertainty;  // centre: of mass
  std::vector<Variable> variables;
  std::vector<DesignSpec> designs;  // one per topology
  std::vector<Objective> objectives;
  bool robust = false;
};

// What nests can be searched for; the first two unless the problem says otherwise.
std::span<const Objective> known_objectives(Purpose purpose);

}  // namespace formotion::nest
