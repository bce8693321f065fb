// A pallet shaken in simulation, in a rigid-body engine that shares no code with the analysis.
#include <algorithm>
#include <iomanip>
#include <sstream>

#include "analysis/energy/vibrating_table.hpp"
#include "shaking/shaking.hpp"
#include "verify/checks.hpp"

namespace formotion {
namespace {

using namespace nest;

constexpr int kRuns = 8;
constexpr double kSeconds = 30;
constexpr double kStep_s = 2e-4;  // half of it gave the same in one nest that was tried, and costs twice as much

ShakenScene shaken_scene(const TestedNest& tested, const Scene& scene) {
  const TableSpec& table = *tested.spec().environment.table;
  ShakenScene shaken{scene.shape.footprint,
                     {},
                     scene.gravity,
                     scene.friction,
                     {table.amplitude_mm, table.frequency_hz, table.restitution.value(tested.values)}};
  for (const Loop& loop : tested.problem.nest_mm(tested.topology, tested.values))
    shaken.nest.push_back(normalised({loop, {}}));
  return shaken;
}

std::string out_of(int count, int runs) {
  const ShareInterval interval = wilson_95(count, runs);
  std::ostringstream words;
  words << std::fixed << std::setprecision(2) << count << " of " << runs << " (95 %: " << interval.low << " to "
        << interval.high << ")";
  return words.str();
}

}  // namespace

Check check_shaken(const TestedNest& tested, const VerifyOptions& options) {
  Check check{"shaken"};
  check.unit = "simulated runs";
  const std::vector<NestRest>& rests = tested.evaluation.rests;
  const auto seat = std::find_if(rests.begin(), rests.end(), [](const NestRest& rest) { return rest.is_seat; });
  const std::string within = " in " + std::to_string(static_cast<int>(kSeconds)) + " s";
  ShakenShare wrong;
  double slowest = 0;
  std::ostringstream each;
  std::string kept = "there is no seat";
  int number = 0;
  for (const NestRest& rest : rests) {
    const auto scene = tested.problem.scene(tested.topology, tested.values, rest.aspect);
    const ShakenScene shaken = shaken_scene(tested, *scene);
    ShakeOptions how;
    how.seconds = kSeconds;
    how.step_s = kStep_s;
    how.seed = options.seed + 1000 * static_cast<std::uint64_t>(++number);
    if (!rest.is_seat && seat != rests.end() && rest.aspect == seat->aspect) {
      how.is_right = [&](const Configuration& q) {
        return apart_mm(*scene, q, *seat) <= tested.spec().goal.seat.within_mm;
      };
    }
    const ShakenShare share = share_that_leaves(shaken, rest.at, kRuns, how);
    check.count += share.runs;
    if (rest.is_seat) {
      kept = "the seat is left by " + out_of(share.left, share.runs);
      if (share.left > 0)
        check.fail("the part leaves the seat in " + std::to_string(share.left) + " of " + std::to_string(share.runs) +
                   " simulated runs" + within);
      continue;
    }
    wrong.runs += share.runs;
    wrong.left += share.left;
    wrong.right += share.right;
    slowest = std::max(slowest, share.last_seconds);
    const int gone = share.left + share.right;
    if (gone < share.runs) each << "; of rest " << number << " " << out_of(gone, share.runs);
    // What the table could throw out by the point mass's bound, but never does, is a trap.
    const bool could = rest.escape_high_mm && *rest.escape_high_mm <= greatest_rise_mm(shaken.table);
    if (gone == 0 && could)
      check.fail("rest " + std::to_string(number) + " keeps its wrong part in all of " + std::to_string(share.runs) +
                 " simulated runs" + within);
  }
  std::ostringstream note;
  note << kept << within;
  if (wrong.runs > 0) {
    note << "; wrong parts are gone in " << out_of(wrong.left + wrong.right, wrong.runs) << ": " << wrong.left
         << " out of the nest and " << wrong.right << " into the seat";
    if (wrong.left + wrong.right > 0)
      note << std::fixed << std::setprecision(1) << ", the last of them after " << slowest << " s";
    note << each.str();
  }
  check.note = note.str();
  return check;
}

}  // namespace formotion
