// An assembly problem as asked for: the part, the fixed shapes with expressions in the variables, the support, the
// approach, the goal. Filled by io, read by the assembly application. mm, N, rad.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/geometry/polygon.hpp"
#include "applications/shared/asked.hpp"
#include "problem/problem.hpp"

namespace formotion::assembly {

// One way to hold the part: "up" as drawn; "down" mirrored x -> -x about the compliance centre.
struct PartSpec {
  AffineLoop outline_mm;
  std::vector<AffineLoop> holes_mm;
  bool flips = false;
  std::optional<Point> com_mm = {};  // default: the outline's centroid; what configurations of queries are given for
  std::optional<double> thickness_mm = {};  // of what is printed, too; no motion depends on it
};

// A spring, or a damper: forces per speed in place of forces per displacement.
struct SupportSpec {
  bool damper = false;
  Number kx, ky, ktheta;  // N/mm and N mm/rad; damper: N s/mm and N mm s/rad
  AffinePoint centre_mm;  // of compliance, in the outline's coordinates; default: the outline's centroid
  bool centre_is_centroid = true;
};

struct ApproachSpec {
  double direction_rad = -1.5707963267948966;
  double distance_mm = 0;
  std::optional<double> max_force_n;
  double speed_mm_s = 1;  // matters with a damper
};

struct NeverSpec {
  std::string aspect;  // "up", "down" or "any"
  double orientation_rad = 0;
  std::optional<StartsSpec> starts;  // default: the goal's
};

struct GoalSpec {
  double depth_mm = 0;
  double lateral_mm = 0, tilt_rad = 0;
  StartsSpec starts;
  std::vector<NeverSpec> never;
};

struct DesignSpec {
  std::vector<AffineLoop> fixed_mm;
  std::optional<Affine> chamfer_mm;  // else measured (docs/assembly.md)
};

struct AssemblySpec {
  PartSpec part;
  Number friction;
  SupportSpec support;
  ApproachSpec approach;
  GoalSpec goal;
  std::vector<Bound> bounds;
  ShapeUncertainty uncertainty;  // centre: of compliance
  std::vector<Variable> variables;
  std::vector<DesignSpec> designs;  // one per topology
  std::vector<Objective> objectives;
  bool robust = false;
};

// What assemblies can be searched for; the first three unless the problem says otherwise.
std::span<const Objective> known_objectives();

}  // namespace formotion::assembly
