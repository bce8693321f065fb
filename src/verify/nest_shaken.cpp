// A pallet shaken in simulation, in a rigid-body engine that shares no code with the analysis.
#include <iomanip>
#include <sstream>

#include "shaking/shaking.hpp"
#include "verify/checks.hpp"

namespace formotion {

using namespace nest;

Check check_shaken(const TestedNest& tested, const VerifyOptions& options) {
  constexpr int kRuns = 8;
  constexpr double kSeconds = 5;
  Check check{"shaken"};
  check.unit = "simulated runs";
  const TableSpec& table = *tested.spec().environment.table;
  std::ostringstream note;
  note << std::fixed << std::setprecision(2) << "in " << kSeconds << " s";
  int number = 0;
  for (const NestRest& rest : tested.evaluation.rests) {
    const auto scene = tested.problem.scene(tested.topology, tested.values, rest.aspect);
    ShakenScene shaken{scene->shape.footprint,
                       {},
                       scene->gravity,
                       scene->friction,
                       {table.amplitude_mm, table.frequency_hz, table.restitution.value(tested.values)}};
    for (const Loop& loop : tested.problem.nest_mm(tested.topology, tested.values))
      shaken.nest.push_back(normalised({loop, {}}));
    ShakeOptions how;
    how.seconds = kSeconds;
    how.seed = options.seed + 1000 * static_cast<std::uint64_t>(++number);
    const ShakenShare share = share_that_leaves(shaken, rest.at, kRuns, how);
    check.count += share.runs;
    note << "; " << (rest.is_seat ? "the seat" : "rest " + std::to_string(number)) << " is left by " << share.left
         << " of " << share.runs << " (95 %: " << share.low << " to " << share.high << ")";
    if (rest.is_seat && share.left > 0)
      check.fail("the part leaves the seat in " + std::to_string(share.left) + " of " + std::to_string(share.runs) +
                 " simulated runs of " + std::to_string(static_cast<int>(kSeconds)) + " s");
  }
  check.note = note.str();
  return check;
}

}  // namespace formotion
