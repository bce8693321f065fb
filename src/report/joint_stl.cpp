#include "report/joint_drawing.hpp"
#include "report/joint_outline.hpp"
#include "solid/stl.hpp"

namespace formotion {

std::string joint_stl(const JointDrawing& drawing) {
  return stl(stacked({{fixed_pieces(drawing.fixed_mm), drawing.thickness_mm}}), drawing.title);
}

}  // namespace formotion
