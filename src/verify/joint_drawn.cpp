// An assembly's drawing read back, as somebody would who has it alone.
#include <algorithm>
#include <cmath>

#include "analysis/geometry/boolean.hpp"
#include "applications/assembly/judge.hpp"
#include "io/problem_reader.hpp"
#include "report/joint_drawing.hpp"
#include "report/joint_outline.hpp"
#include "verify/checks.hpp"
#include "verify/drawn_shapes.hpp"

namespace formotion {
namespace {

using namespace assembly;

constexpr double kShapesAgree_mm = 1e-6;
constexpr double kScoresAgree = 1e-3;  // of the larger of 1 and the value: what a start decides may turn with a bit

}  // namespace

Check check_drawn(const TestedJoint& tested) {
  Check check{"drawn"};
  check.unit = "contours";
  const AssemblySpec& asked = tested.spec();
  const Joint joint = tested.problem.joint(tested.topology, tested.values);
  const std::vector<Polygon> pieces = fixed_pieces(joint.fixed_mm);
  if (std::any_of(pieces.begin(), pieces.end(), [](const Polygon& piece) { return !piece.holes.empty(); })) {
    check.note = "fixed shapes that together close a hole are drawn as nested contours, which are not read back";
    return check;
  }
  JointDrawing drawing;
  drawing.fixed_mm = joint.fixed_mm;
  drawing.part = joint.part;
  drawing.centre_mm = joint.centre_mm;
  drawing.approach_rad = asked.approach.direction_rad;
  drawing.depth_mm = asked.goal.depth_mm;
  try {
    const DrawnShapes read = read_back(joint_dxf(drawing));
    check.count = static_cast<std::int64_t>(read.fixed.size() + read.part.size());
    if (read.fixed.size() != pieces.size() || read.part.size() != 1 + joint.part.holes.size()) {
      check.fail("the drawing has " + std::to_string(check.count) + " contours");
      return check;
    }
    check.worst = std::max(apart_mm(read.fixed, loops_of(pieces)), apart_mm(read.part, loops_of(joint.part)));
    check.worst_of = "mm between the shapes as scored and as drawn";
    if (*check.worst > kShapesAgree_mm) check.fail("shapes as drawn differ from the ones scored");

    AssemblySpec spec = asked;
    const DesignSpec design = tested.problem.literal_design(tested.topology, tested.values);
    spec.designs = {{{}, design.chamfer_mm}};
    for (const Loop& loop : read.fixed) spec.designs.front().fixed_mm.push_back(literal_loop(loop));
    spec.part.outline_mm = literal_loop(read.part.front());
    spec.part.holes_mm.clear();
    for (std::size_t i = 1; i < read.part.size(); ++i) spec.part.holes_mm.push_back(literal_loop(read.part[i]));
    spec.support.centre_is_centroid = false;
    spec.support.centre_mm = {Affine{joint.centre_mm.x(), {}}, Affine{joint.centre_mm.y(), {}}};
    const AssemblyEvaluation as_drawn = judge(spec, 0, tested.values, false).evaluation;
    const Metrics scored = judge(asked, tested.topology, tested.values, false).evaluation.metrics;
    for (const Objective& o : asked.objectives) {
      const double before = objective(scored, o.name), now = objective(as_drawn.metrics, o.name);
      if (std::abs(now - before) > kScoresAgree * std::max(1.0, std::abs(before)))
        check.fail(o.name + " as drawn is " + number_text(now) + " in place of " + number_text(before));
    }
  } catch (const InputError& error) { check.fail("the drawing cannot be read back: " + std::string(error.what())); }
  return check;
}

}  // namespace formotion
