#include "report/dxf_writer.hpp"

#include <cstdio>
#include <utility>

#include "report/track_outline.hpp"

namespace formotion {
namespace {

// R12 has no Unicode: other characters than ASCII by their number, as CAD programs write them.
std::string ascii(const std::string& text) {
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

}  // namespace

DxfWriter::DxfWriter(const Box& extent, const std::vector<DxfLayer>& layers) {
  section("HEADER");
  group(9, "$ACADVER");
  group(1, "AC1009");
  group(9, "$INSUNITS");
  group(70, 4);
  group(9, "$EXTMIN");
  point(10, extent.min);
  group(9, "$EXTMAX");
  point(10, extent.max);
  group(0, "ENDSEC");
  tables(layers);
  section("ENTITIES");
}

void DxfWriter::contour(const char* layer, const Loop& loop) { polyline(layer, loop, true); }

void DxfWriter::open_line(const char* layer, const Loop& points) { polyline(layer, points, false); }

void DxfWriter::line(const char* layer, const Point& from, const Point& to) {
  group(0, "LINE");
  group(8, layer);
  point(10, from);
  point(11, to);
}

void DxfWriter::circle(const char* layer, const Point& centre, double radius_mm) {
  group(0, "CIRCLE");
  group(8, layer);
  point(10, centre);
  number(40, radius_mm);
}

void DxfWriter::note(const Point& at, const std::string& text) {
  group(0, "TEXT");
  group(8, "NOTE");
  point(10, at);
  number(40, kDxfText_mm);
  group(1, ascii(text));
}

std::string DxfWriter::finish() {
  group(0, "ENDSEC");
  group(0, "EOF");
  return std::move(text_);
}

void DxfWriter::group(int code, const std::string& value) { text_ += std::to_string(code) + "\n" + value + "\n"; }

void DxfWriter::group(int code, int value) { group(code, std::to_string(value)); }

void DxfWriter::number(int code, double value) {
  char text[400];
  std::snprintf(text, sizeof text, "%.12f", value + 0.0);
  group(code, text);
}

void DxfWriter::point(int x_code, const Point& p) {
  number(x_code, p.x());
  number(x_code + 10, p.y());
  number(x_code + 20, 0);
}

void DxfWriter::section(const char* name) {
  group(0, "SECTION");
  group(2, name);
}

void DxfWriter::line_type(const char* name, const char* picture, double length, const std::vector<double>& dashes) {
  group(0, "LTYPE");
  group(2, name);
  group(70, 0);
  group(3, picture);
  group(72, 65);
  group(73, static_cast<int>(dashes.size()));
  number(40, length);
  for (const double dash : dashes) number(49, dash);
}

void DxfWriter::tables(const std::vector<DxfLayer>& layers) {
  section("TABLES");
  group(0, "TABLE");
  group(2, "LTYPE");
  group(70, 3);
  line_type("CONTINUOUS", "Solid line", 0, {});
  line_type("DASHED", "__ __ __", 4, {2.5, -1.5});
  line_type("CENTER", "____ _ ____", 6, {3.5, -0.75, 1, -0.75});
  group(0, "ENDTAB");
  group(0, "TABLE");
  group(2, "LAYER");
  group(70, static_cast<int>(layers.size()) + 1);
  const auto write = [this](const DxfLayer& layer) {
    group(0, "LAYER");
    group(2, layer.name);
    group(70, 0);
    group(62, layer.colour);
    group(6, layer.line_type);
  };
  write({"0", 7, "CONTINUOUS"});
  for (const DxfLayer& layer : layers) write(layer);
  group(0, "ENDTAB");
  group(0, "ENDSEC");
}

void DxfWriter::polyline(const char* layer, const Loop& points, bool closed) {
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

}  // namespace formotion
