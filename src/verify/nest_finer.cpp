// A nest's rests and ways out, found again with finer steps.
#include <algorithm>
#include <cmath>

#include "analysis/energy/rests.hpp"
#include "verify/checks.hpp"

namespace formotion {

using namespace nest;

Check check_finer(const TestedNest& tested) {
  constexpr double kGrid_rad = 0.25 * 1.7453292519943295e-2, kGap_mm = 0.02, kApart_mm = 1e-3;
  Check check{"finer"};
  check.unit = "rests";
  double widest = 0;
  for (const AspectShape& shape : aspect_shapes(tested.spec().part, tested.values)) {
    const auto scene = tested.problem.scene(tested.topology, tested.values, shape.name);
    RestOptions finer;
    finer.grid_rad = kGrid_rad;
    for (const Rest& rest : rests(*scene->space, scene->gravity, finer)) {
      ++check.count;
      const bool known = std::any_of(
          tested.evaluation.rests.begin(), tested.evaluation.rests.end(),
          [&](const NestRest& one) { return one.aspect == shape.name && apart_mm(*scene, rest.at, one) < kApart_mm; });
      if (!known) check.fail("a rest of the part (" + shape.name + ") that was not listed");
    }
    if (tested.spec().purpose != Purpose::Pallet) continue;
    EscapeOptions options;
    options.gap_mm = kGap_mm;
    for (const NestRest& rest : tested.evaluation.rests) {
      if (rest.aspect != shape.name) continue;
      const EscapeBracket bracket = escape(*scene->space, scene->gravity, rest.at, scene->outside, options);
      if (bracket.upper_mm && *bracket.upper_mm < rest.escape_low_mm - 1e-9)
        check.fail("a way out that is lower than the bound");
      if (rest.escape_high_mm && bracket.lower_mm > *rest.escape_high_mm + 1e-9)
        check.fail("a bound that is higher than the way out");
      if (bracket.upper_mm) widest = std::max(widest, *bracket.upper_mm - bracket.lower_mm);
    }
  }
  if (tested.spec().purpose == Purpose::Pallet) {
    check.worst = widest;
    check.worst_of = "mm between bound and way out at most";
  }
  return check;
}

}  // namespace formotion
