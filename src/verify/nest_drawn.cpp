// A nest's drawing read back, as somebody would who has it alone.
#include "io/input_error.hpp"
#include "report/joint_drawing.hpp"
#include "report/joint_outline.hpp"
#include "verify/checks.hpp"
#include "verify/drawn_shapes.hpp"

namespace formotion {

Check check_drawn(const TestedNest& tested) {
  constexpr double kShapesAgree_mm = 1e-6;
  Check check{"drawn"};
  check.unit = "contours";
  JointDrawing drawing;
  drawing.fixed_mm = tested.problem.nest_mm(tested.topology, tested.values);
  const Configuration seat = tested.problem.seat(tested.values);
  for (const AspectShape& shape : aspect_shapes(tested.spec().part, tested.values)) {
    if (shape.name == tested.spec().goal.seat.aspect)
      drawing.part = placed(shape.footprint, seat.theta_rad, seat.position());
  }
  std::vector<Loop> nest;
  for (const Polygon& piece : fixed_pieces(drawing.fixed_mm)) {
    nest.push_back(piece.outer);
    nest.insert(nest.end(), piece.holes.begin(), piece.holes.end());
  }
  try {
    const DrawnShapes read = read_back(joint_dxf(drawing));
    check.count = static_cast<std::int64_t>(read.fixed.size() + read.part.size());
    check.worst = apart_mm(read.fixed, nest);
    check.worst_of = "mm between the nest as scored and as drawn";
    if (*check.worst > kShapesAgree_mm || read.fixed.size() != nest.size())
      check.fail("the nest as drawn differs from the one scored");
  } catch (const InputError& error) { check.fail("the drawing cannot be read back: " + std::string(error.what())); }
  return check;
}

}  // namespace formotion
