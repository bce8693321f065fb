// A drawing sheet as SVG: lines, texts, dimensions with arrows, in mm on paper, y downwards.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "analysis/geometry/polygon.hpp"

namespace formotion {

enum class Anchor { Start, Middle, End };

struct TextStyle {
  double size_mm = 2.8;
  Anchor anchor = Anchor::Start;
  bool bold = false;
  bool upwards = false;  // read from below to above
  bool halo = true;      // white around the letters, so that they can be read on lines
};

// Classes of lines and areas are those of the sheet's style: "metal", "cut", "thin", "dim", "axis", "blade", ...
class SvgCanvas {
 public:
  void line(const Point& a, const Point& b, const char* style);
  void path(const Loop& points, bool closed, const char* style);
  void area(const std::vector<Loop>& loops, const char* style);  // even-odd
  void circle(const Point& centre, double radius, const char* style);
  void text(const Point& at, const std::string& text, const TextStyle& style = {});
  void arrow(const Point& tip, const Point& direction);  // direction: unit, towards the tip

  // Dimension lines with their number (text beside the line; arrows outside where there is no room).
  void horizontal_dimension(double x_from, double x_to, double y, const std::string& text);
  void vertical_dimension(double x, double y_from, double y_to, const std::string& text);
  // What vertical_dimension would cover.
  static Box vertical_dimension_box(double x, double y_from, double y_to, const std::string& text);

  // Room that is taken: labels look for free places.
  void take(const Box& box) { taken_.push_back(box); }
  bool is_free(const Box& box) const;

  std::string sheet(double width_mm, double height_mm, const std::string& title) const;

 private:
  std::ostringstream body_;
  std::vector<Box> taken_;
};

Box box_around(const Point& centre, double width, double height);
// An estimate from above for the usual sans-serif fonts.
double text_width(const std::string& text, double size_mm);
// Lines of at most this width, broken at blanks (words that are too long are broken anywhere).
std::vector<std::string> wrapped(const std::string& text, double size_mm, double width_mm);

}  // namespace formotion
