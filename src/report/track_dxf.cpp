#include "report/dxf_writer.hpp"
#include "report/track_drawing.hpp"
#include "report/track_outline.hpp"

namespace formotion {
namespace {

constexpr double kOverhang_mm = 5;

const std::vector<DxfLayer> kLayers{{"TRACK", 7, "CONTINUOUS"}, {"VOID", 1, "CONTINUOUS"}, {"DATUM", 5, "CONTINUOUS"},
                                    {"NOTE", 3, "CONTINUOUS"},  {"BLADE", 6, "DASHED"},    {"WALL", 2, "CONTINUOUS"},
                                    {"FACE", 4, "CONTINUOUS"},  {"CENTER", 8, "CENTER"}};

void write_notes(DxfWriter& out, const TrackDrawing& drawing, const TrackOutline& outline) {
  double y = outline.y_min - kOverhang_mm - kDxfText_mm;
  const auto note = [&](const std::string& text) {
    out.note({outline.x_min, y}, text);
    y -= 1.6 * kDxfText_mm;
  };
  note(drawing.title);
  note("lengths in mm; x along the feed from the datum, y from the wall's face");
  note("cut the contours of layer TRACK; layer VOID shows what is removed");
  if (!outline.fences.empty() || !outline.pins.empty()) note("layer WALL shows what stands on the track");
  if (outline.has_profile) note("layer FACE is the wall's face");
  for (const std::string& line : drawing.notes) note(line);
  for (std::size_t i = 0; i < drawing.features.size(); ++i) {
    const feeder::PlacedFeature& feature = drawing.features[i];
    std::string text = "F" + std::to_string(i + 1) + " " + feature.type;
    for (const auto& [name, value] : feature.dimensions) {
      if (feature.type == "wiper" || feature.type == "hold-down") text += ", " + name + " " + length_text(value);
    }
    out.note({feature.start_mm, outline.y_max + kDxfText_mm * (1 + 1.6 * static_cast<double>(i % 3))}, text);
  }
}

}  // namespace

std::string track_dxf(const TrackDrawing& drawing) {
  const TrackOutline outline = track_outline(drawing);
  DxfWriter out({{outline.x_min, outline.y_min}, {outline.x_max, outline.y_max}}, kLayers);
  for (const Polygon& piece : outline.metal) {
    out.contour("TRACK", piece.outer);
    for (const Loop& hole : piece.holes) out.contour("TRACK", hole);
  }
  for (const Loop& loop : outline.voids) out.contour("VOID", loop);
  for (const Loop& loop : outline.fences) out.contour("WALL", loop);
  for (const Disc& pin : outline.pins) {
    out.circle("WALL", pin.centre, pin.radius_mm);
    const double reach = pin.radius_mm + 1;
    out.line("CENTER", pin.centre - Point(reach, 0), pin.centre + Point(reach, 0));
    out.line("CENTER", pin.centre - Point(0, reach), pin.centre + Point(0, reach));
  }
  if (outline.has_profile) out.open_line("FACE", outline.face);
  out.line("DATUM", {outline.x_min - kOverhang_mm, 0}, {outline.x_max + kOverhang_mm, 0});
  out.line("DATUM", {0, -kOverhang_mm}, {0, outline.width_mm + kOverhang_mm});
  for (const feeder::PlacedFeature& feature : drawing.features) {
    if (feature.type == "wiper") out.line("BLADE", {feature.start_mm, 0}, {feature.start_mm, outline.width_mm});
    if (feature.type != "hold-down" || feature.end_mm <= feature.start_mm) continue;
    out.contour("BLADE", {{feature.start_mm, 0},
                          {feature.end_mm, 0},
                          {feature.end_mm, outline.width_mm},
                          {feature.start_mm, outline.width_mm}});
  }
  write_notes(out, drawing, outline);
  return out.finish();
}

}  // namespace formotion
