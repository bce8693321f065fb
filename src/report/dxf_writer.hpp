// DXF text in the R12 dialect: the oldest that every program reads, in which polylines and texts need no tables of
// objects. $INSUNITS is younger than R12; programs that do not know it take the numbers as they are, which are mm.
#pragma once

#include <string>
#include <vector>

#include "analysis/geometry/polygon.hpp"

namespace formotion {

struct DxfLayer {
  const char* name;
  int colour;             // of the ACI palette
  const char* line_type;  // "CONTINUOUS", "DASHED" or "CENTER"
};

constexpr double kDxfText_mm = 2.5;  // height of notes

class DxfWriter {
 public:
  // Header, tables and the beginning of the entities. Layer "0" is always there.
  DxfWriter(const Box& extent, const std::vector<DxfLayer>& layers);

  void contour(const char* layer, const Loop& loop);  // closed
  void open_line(const char* layer, const Loop& points);
  void line(const char* layer, const Point& from, const Point& to);
  void circle(const char* layer, const Point& centre, double radius_mm);
  void note(const Point& at, const std::string& text);  // on layer NOTE

  // The whole file; nothing may be written after it.
  std::string finish();

 private:
  void group(int code, const std::string& value);
  void group(int code, int value);
  void number(int code, double value);
  void point(int x_code, const Point& p);
  void section(const char* name);
  void line_type(const char* name, const char* picture, double length, const std::vector<double>& dashes);
  void tables(const std::vector<DxfLayer>& layers);
  void polyline(const char* layer, const Loop& points, bool closed);

  std::string text_;
};

}  // namespace formotion
