// Assemblies looked at more closely: never-goals proved with smaller cells, the region of success by more rows.
#include <algorithm>
#include <cmath>

#include "analysis/insertion/exclusion.hpp"
#include "verify/checks.hpp"

namespace formotion {
namespace {

using namespace assembly;

constexpr double kCells_mm[] = {0.125, 0.0625};  // scoring's are 0.25
constexpr double kSharesAgree = 0.01;            // of the box

void add_note(Check& check, const std::string& text) { check.note += (check.note.empty() ? "" : "; ") + text; }

// With smaller cells than scoring's; smaller ones still only where those prove nothing.
void prove(const TestedJoint& joint, const NeverResult& wrong, Check& check) {
  const StartsSpec& starts = wrong.box;
  const StartBox box{starts.x_mm.min, starts.x_mm.max,      starts.y_mm.min,
                     starts.y_mm.max, starts.theta_rad.min, starts.theta_rad.max};
  const std::unique_ptr<Scene> held = joint.scene(wrong);
  ++check.count;
  std::string why;
  for (const double cell_mm : kCells_mm) {
    ExclusionOptions options;
    options.cell_mm = cell_mm;
    const Exclusion found = deepest_reachable(held->task, box, joint.spec().goal.depth_mm, options);
    why = found.why;
    if (!found.proved) continue;
    // What a start was projected to reach cannot be out of reach.
    if (wrong.deepest.insertion.deepest_mm > found.bound_mm)
      check.fail(never_text(wrong) + " is said to get " + number_text(wrong.deepest.insertion.deepest_mm) +
                 " mm deep, and proved not to get deeper than " + number_text(found.bound_mm) + " mm");
    add_note(check, never_text(wrong) + " is proved with cells of " + number_text(cell_mm) + " mm: at most " +
                        number_text(found.bound_mm) + " mm deep");
    return;
  }
  add_note(check, never_text(wrong) + " is NOT proved by free space (" + why + "): friction or forces hold it");
}

// By more rows and starts, without what scoring found.
double finer_share(const InsertionTask& task, const ErrorBox& box, double y_mm) {
  RegionOptions options;
  options.starts_a_row = 17;
  options.rows = 14;  // not those of scoring
  options.most_rows = 65;
  options.boundary = 1e-8;
  options.row_error = 1e-3;
  const auto at = [&](double x, double theta) {
    const Insertion found = insert(task, start_with_errors(task, x, y_mm, theta));
    return StartOutcome{static_cast<int>(found.outcome), found.history};
  };
  return share_of(outcome_region(box, at, options), static_cast<int>(InsertionOutcome::Assembled));
}

}  // namespace

Check check_finer(const TestedJoint& joint) {
  Check check{"finer"};
  check.unit = "regions and wrong ways";
  const AssemblyEvaluation& evaluation = joint.evaluation;
  if (joint.stored.score.feasible && !evaluation.feasible)
    check.fail("searched as feasible, but in detail: " + evaluation.violations.front().what);
  const std::unique_ptr<Scene> scene = joint.scene();
  double apart = 0;
  for (std::size_t i = 0; i < evaluation.regions.size(); ++i) {
    const OutcomeRegion& region = evaluation.regions[i];
    ++check.count;
    const double claimed = share_of(region, static_cast<int>(InsertionOutcome::Assembled));
    const double finer = finer_share(scene->task, region.box, evaluation.region_y_mm[i]);
    apart = std::max(apart, std::abs(finer - claimed));
    if (std::abs(finer - claimed) > kSharesAgree)
      check.fail("by more rows " + number_text(100 * finer) + " % of the starts assemble in place of " +
                 number_text(100 * claimed) + " %");
  }
  check.worst = apart;
  check.worst_of = "of the box, between the shares that assemble";
  for (const NeverResult& wrong : evaluation.never) {
    if (wrong.holds) {
      prove(joint, wrong, check);
    } else {
      add_note(check, never_text(wrong) + " reaches the depth");
    }
  }
  return check;
}

}  // namespace formotion
