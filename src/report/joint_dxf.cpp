#include "report/dxf_writer.hpp"
#include "report/joint_drawing.hpp"
#include "report/joint_outline.hpp"
#include "report/track_outline.hpp"

namespace formotion {
namespace {

constexpr double kOverhang_mm = 5;
constexpr double kDirection_mm = 20;  // drawn of a direction that leads nowhere

const std::vector<DxfLayer> kLayers{{"FIXED", 7, "CONTINUOUS"}, {"PART", 4, "CONTINUOUS"}, {"GOAL", 6, "DASHED"},
                                    {"DATUM", 5, "CONTINUOUS"}, {"CENTER", 8, "CENTER"},   {"NOTE", 3, "CONTINUOUS"}};

void contours(DxfWriter& out, const char* layer, const Polygon& polygon) {
  out.contour(layer, polygon.outer);
  for (const Loop& hole : polygon.holes) out.contour(layer, hole);
}

}  // namespace

std::string joint_dxf(const JointDrawing& drawing) {
  const std::vector<Polygon> fixed = fixed_pieces(drawing.fixed_mm);
  const bool has_goal = drawing.words.has_goal();
  const Polygon goal = has_goal ? at_goal(drawing) : drawing.part;
  Box extent;
  for (const Polygon& piece : fixed) {
    for (const Point& p : piece.outer) extent.include(p);
  }
  for (const Polygon* polygon : {&drawing.part, &goal}) {
    for (const Point& p : polygon->outer) extent.include(p);
  }
  DxfWriter out(extent, kLayers);
  for (const Polygon& piece : fixed) contours(out, "FIXED", piece);
  contours(out, "PART", drawing.part);
  if (has_goal) contours(out, "GOAL", goal);
  const Point c = drawing.centre_mm, along = ApproachFrame(drawing.approach_rad).along;
  out.line("DATUM", c, c + (has_goal ? drawing.depth_mm : kDirection_mm) * along);
  out.line("CENTER", c - Point(kOverhang_mm, 0), c + Point(kOverhang_mm, 0));
  out.line("CENTER", c - Point(0, kOverhang_mm), c + Point(0, kOverhang_mm));
  double y = extent.min.y() - kOverhang_mm - kDxfText_mm;
  const auto note = [&](const std::string& text) {
    out.note({extent.min.x(), y}, text);
    y -= 1.6 * kDxfText_mm;
  };
  note(drawing.title);
  note(std::string("lengths in mm; cut the contours of layer FIXED; layer PART is ") + drawing.words.part_layer);
  if (has_goal) {
    note(std::string("layer GOAL is the ") + drawing.words.goal + " of " + length_text(drawing.depth_mm) +
         ", layer DATUM its way from the " + drawing.words.centre + " (layer CENTER)");
  } else {
    note(std::string("layer DATUM is the direction of gravity, from the ") + drawing.words.centre + " (layer CENTER)");
  }
  for (const std::string& line : drawing.notes) note(line);
  return out.finish();
}

}  // namespace formotion
