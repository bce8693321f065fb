// R12 text: the oldest dialect that every program reads, in which polylines and texts need no tables of objects.
// $INSUNITS is younger than R12; programs that do not know it take the numbers as they are, which are mm.
#include <cstdio>

#include "report/track_drawing.hpp"
#include "report/track_outline.hpp"

namespace formotion {
namespace {

constexpr double kTextHeight_mm = 2.5;
constexpr double kOverhang_mm = 5;

class Writer {
 public:
  void group(int code, const std::string& value) { text_ += std::to_string(code) + "\n" + value + "\n"; }
  void group(int code, int value) { group(code, std::to_string(value)); }
  void number(int code, double value) {
    char text[400];
    std::snprintf(text, sizeof text, "%.12f", value + 0.0);
    group(code, text);
  }
  void point(int x_code, const Point& p) {
    number(x_code, p.x());
    number(x_code + 10, p.y());
    number(x_code + 20, 0);
  }
  void section(const char* name) {
    group(0, "SECTION");
    group(2, name);
  }
  void end_section() { group(0, "ENDSEC"); }

  void layer(const char* name, int colour, const char* line_type) {
    group(0, "LAYER");
    group(2, name);
    group(70, 0);
    group(62, colour);
    group(6, line_type);
  }

  void contour(const char* layer, const Loop& loop) { polyline(layer, loop, true); }

  void open_line(const char* layer, const Loop& points) { polyline(layer, points, false); }

  void circle(const char* layer, const Disc& disc) {
    group(0, "CIRCLE");
    group(8, layer);
    point(10, disc.centre);
    number(40, disc.radius_mm);
  }

  void line(const char* layer, const Point& from, const Point& to) {
    group(0, "LINE");
    group(8, layer);
    point(10, from);
    point(11, to);
  }

  void note(const Point& at, const std::string& text) {
    group(0, "TEXT");
    group(8, "NOTE");
    point(10, at);
    number(40, kTextHeight_mm);
    group(1, ascii(text));
  }

  const std::string& text() const { return text_; }

 private:
  // R12 has no Unicode: other characters than ASCII by their number, as CAD programs write them.
  static std::string ascii(const std::string& text) {
    std::string result;
    const std::string clean = printable(text);
    for (std::size_t i = 0; i < clean.size();) {
      const auto c = static_cast<unsigned char>(clean[i]);
      const int length = c < 0x80 ? 1 : c < 0xE0 ? 2 : c < 0xF0 ? 3 : 4;
      unsigned code = length == 1 ? c : c & (0xFFu >> (length + 1));
      for (int k = 1; k < length; ++k) code = code << 6 | (static_cast<unsigned char>(clean[i + k]) & 0x3Fu);
      i += static_cast<std::size_t>(length);
      if (code < 0x80) {
        result += static_cast<char>(code);
      } else if (code < 0x10000) {
        char escape[16];
        std::snprintf(escape, sizeof escape, "\\U+%04X", code);
        result += escape;
      } else {
        result += '?';
      }
    }
    constexpr std::size_t kLongest = 250;  // R12 reads lines of up to 255 characters
    return result.substr(0, kLongest);
  }

  void polyline(const char* layer, const Loop& points, bool closed) {
    group(0, "POLYLINE");
    group(8, layer);
    group(66, 1);
    point(10, Point::Zero());
    group(70, closed ? 1 : 0);
    for (const Point& p : points) {
      group(0, "VERTEX");
      group(8, layer);
      point(10, p);
    }
    group(0, "SEQEND");
    group(8, layer);
  }

  std::string text_;
};

void write_tables(Writer& out) {
  out.section("TABLES");
  out.group(0, "TABLE");
  out.group(2, "LTYPE");
  out.group(70, 3);
  out.group(0, "LTYPE");
  out.group(2, "CONTINUOUS");
  out.group(70, 0);
  out.group(3, "Solid line");
  out.group(72, 65);
  out.group(73, 0);
  out.number(40, 0);
  out.group(0, "LTYPE");
  out.group(2, "DASHED");
  out.group(70, 0);
  out.group(3, "__ __ __");
  out.group(72, 65);
  out.group(73, 2);
  out.number(40, 4);
  out.number(49, 2.5);
  out.number(49, -1.5);
  out.group(0, "LTYPE");
  out.group(2, "CENTER");
  out.group(70, 0);
  out.group(3, "____ _ ____");
  out.group(72, 65);
  out.group(73, 4);
  out.number(40, 6);
  out.number(49, 3.5);
  out.number(49, -0.75);
  out.number(49, 1);
  out.number(49, -0.75);
  out.group(0, "ENDTAB");
  out.group(0, "TABLE");
  out.group(2, "LAYER");
  out.group(70, 9);
  out.layer("0", 7, "CONTINUOUS");
  out.layer("TRACK", 7, "CONTINUOUS");
  out.layer("VOID", 1, "CONTINUOUS");
  out.layer("DATUM", 5, "CONTINUOUS");
  out.layer("NOTE", 3, "CONTINUOUS");
  out.layer("BLADE", 6, "DASHED");
  out.layer("WALL", 2, "CONTINUOUS");
  out.layer("FACE", 4, "CONTINUOUS");
  out.layer("CENTER", 8, "CENTER");
  out.group(0, "ENDTAB");
  out.end_section();
}

void write_notes(Writer& out, const TrackDrawing& drawing, const TrackOutline& outline) {
  double y = outline.y_min - kOverhang_mm - kTextHeight_mm;
  const auto note = [&](const std::string& text) {
    out.note({outline.x_min, y}, text);
    y -= 1.6 * kTextHeight_mm;
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
    out.note({feature.start_mm, outline.y_max + kTextHeight_mm * (1 + 1.6 * static_cast<double>(i % 3))}, text);
  }
}

}  // namespace

std::string track_dxf(const TrackDrawing& drawing) {
  const TrackOutline outline = track_outline(drawing);
  Writer out;
  out.section("HEADER");
  out.group(9, "$ACADVER");
  out.group(1, "AC1009");
  out.group(9, "$INSUNITS");
  out.group(70, 4);
  out.group(9, "$EXTMIN");
  out.point(10, {outline.x_min, outline.y_min});
  out.group(9, "$EXTMAX");
  out.point(10, {outline.x_max, outline.y_max});
  out.end_section();
  write_tables(out);
  out.section("ENTITIES");
  for (const Polygon& piece : outline.metal) {
    out.contour("TRACK", piece.outer);
    for (const Loop& hole : piece.holes) out.contour("TRACK", hole);
  }
  for (const Loop& loop : outline.voids) out.contour("VOID", loop);
  for (const Loop& loop : outline.fences) out.contour("WALL", loop);
  for (const Disc& pin : outline.pins) {
    out.circle("WALL", pin);
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
  out.end_section();
  out.group(0, "EOF");
  return out.text();
}

}  // namespace formotion
