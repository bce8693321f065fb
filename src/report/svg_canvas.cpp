#include "report/svg_canvas.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "report/track_outline.hpp"

namespace formotion {
namespace {

constexpr double kArrow_mm = 2.2;
constexpr double kDimensionText_mm = 2.8;
constexpr double kOutside_mm = 5;  // length of an arrow that points from outside

constexpr const char* kStyle =
    "text{font-family:Arial,Helvetica,'Liberation Sans','DejaVu Sans',sans-serif;fill:#111}"
    ".halo{paint-order:stroke;stroke:#fff;stroke-width:.9px;stroke-linejoin:round}"
    ".metal{fill:#d9dde2;stroke:none}.wall{fill:#fff;stroke:none}"
    ".cut{fill:none;stroke:#000;stroke-width:.5px;stroke-linejoin:round;stroke-linecap:round}"
    ".face{fill:none;stroke:#000;stroke-width:.7px}"
    ".fixed{fill:url(#hatch);stroke:none}.centre{fill:none;stroke:#000;stroke-width:.18px;stroke-dasharray:3 .6 .6 .6}"
    ".break{fill:none;stroke:#000;stroke-width:.25px}"
    ".dim{fill:none;stroke:#1f3f77;stroke-width:.18px}.arrow{fill:#1f3f77;stroke:none}"
    ".axis{fill:none;stroke:#b00020;stroke-width:.25px;stroke-dasharray:6 1.2 .8 1.2}"
    ".datum{fill:#b00020;stroke:none}"
    ".blade{fill:none;stroke:#7a1fa2;stroke-width:.5px;stroke-dasharray:3 1.5}"
    ".rail{fill:#7a1fa2;fill-opacity:.08;stroke:#7a1fa2;stroke-width:.4px;stroke-dasharray:3 1.5}"
    ".mark{fill:#fff;stroke:#b00020;stroke-width:.25px}.leader{fill:none;stroke:#b00020;stroke-width:.15px}"
    ".box{fill:none;stroke:#000;stroke-width:.35px}.rule{fill:none;stroke:#777;stroke-width:.15px}"
    ".feed{fill:#fff;stroke:#000;stroke-width:.3px}.solid{fill:#000;stroke:#000;stroke-width:.25px}"
    ".empty{fill:#fff;stroke:#000;stroke-width:.25px}";

// Lines at 45 degrees on white: cut material.
constexpr const char* kHatch =
    "<defs><pattern id=\"hatch\" width=\"1.8\" height=\"1.8\" patternUnits=\"userSpaceOnUse\" "
    "patternTransform=\"rotate(45)\"><rect width=\"1.8\" height=\"1.8\" fill=\"#fff\"/>"
    "<path d=\"M.9 0V1.8\" stroke=\"#444\" stroke-width=\".18\"/></pattern></defs>";

std::string number(double value) {
  char text[48];
  std::snprintf(text, sizeof text, "%.4f", value);
  std::string result = text;
  result.erase(result.find_last_not_of('0') + 1);
  if (result.back() == '.') result.pop_back();
  return result == "-0" ? "0" : result;
}

std::string pair(const Point& p) { return number(p.x()) + " " + number(p.y()); }

std::string path_data(const Loop& points, bool closed) {
  std::string data;
  for (std::size_t i = 0; i < points.size(); ++i) data += (i == 0 ? "M" : "L") + pair(points[i]);
  return closed ? data + "Z" : data;
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : printable(text)) {
    result += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : c == '"' ? "&quot;" : std::string(1, c);
  }
  return result;
}

bool fits_along(double length, const std::string& text) { return length >= text_width(text, kDimensionText_mm) + 2; }

}  // namespace

void SvgCanvas::line(const Point& a, const Point& b, const char* style) { path({a, b}, false, style); }

void SvgCanvas::path(const Loop& points, bool closed, const char* style) {
  body_ << "<path class=\"" << style << "\" d=\"" << path_data(points, closed) << "\"/>\n";
}

void SvgCanvas::area(const std::vector<Loop>& loops, const char* style) {
  body_ << "<path class=\"" << style << "\" fill-rule=\"evenodd\" d=\"";
  for (const Loop& loop : loops) body_ << path_data(loop, true);
  body_ << "\"/>\n";
}

void SvgCanvas::circle(const Point& centre, double radius, const char* style) {
  body_ << "<circle class=\"" << style << "\" cx=\"" << number(centre.x()) << "\" cy=\"" << number(centre.y())
        << "\" r=\"" << number(radius) << "\"/>\n";
}

void SvgCanvas::text(const Point& at, const std::string& text, const TextStyle& style) {
  constexpr const char* kAnchors[] = {"start", "middle", "end"};
  body_ << "<text x=\"" << number(at.x()) << "\" y=\"" << number(at.y()) << "\" font-size=\"" << number(style.size_mm)
        << "\" text-anchor=\"" << kAnchors[static_cast<int>(style.anchor)] << "\"";
  if (style.bold) body_ << " font-weight=\"bold\"";
  if (style.halo) body_ << " class=\"halo\"";
  if (style.upwards) body_ << " transform=\"rotate(-90 " << pair(at) << ")\"";
  body_ << ">" << escaped(text) << "</text>\n";
}

void SvgCanvas::arrow(const Point& tip, const Point& direction) {
  const Point back = tip - kArrow_mm * direction, across = 0.35 * Point(-direction.y(), direction.x());
  path({tip, back + across, back - across}, true, "arrow");
}

void SvgCanvas::horizontal_dimension(double x_from, double x_to, double y, const std::string& text) {
  const bool inside = x_to - x_from >= 2 * kArrow_mm + 1;
  const double out = inside ? 0 : kOutside_mm;
  line({x_from - out, y}, {x_to + out, y}, "dim");
  arrow({x_from, y}, {inside ? -1.0 : 1.0, 0});
  arrow({x_to, y}, {inside ? 1.0 : -1.0, 0});
  this->text({(x_from + x_to) / 2, y - 0.9}, text, {kDimensionText_mm, Anchor::Middle, false, false, true});
}

void SvgCanvas::vertical_dimension(double x, double y_from, double y_to, const std::string& text) {
  const double top = std::min(y_from, y_to), bottom = std::max(y_from, y_to);
  const bool inside = bottom - top >= 2 * kArrow_mm + 1;
  const double out = inside ? 0 : kOutside_mm;
  line({x, top - out}, {x, bottom + out}, "dim");
  arrow({x, top}, {0, inside ? -1.0 : 1.0});
  arrow({x, bottom}, {0, inside ? 1.0 : -1.0});
  if (fits_along(bottom - top, text)) {
    this->text({x - 0.9, (top + bottom) / 2}, text, {kDimensionText_mm, Anchor::Middle, false, true, true});
  } else {
    this->text({x + 1, (top + bottom) / 2 + 1}, text, {kDimensionText_mm, Anchor::Start, false, false, true});
  }
}

Box SvgCanvas::vertical_dimension_box(double x, double y_from, double y_to, const std::string& text) {
  const double top = std::min(y_from, y_to), bottom = std::max(y_from, y_to);
  Box box;
  if (fits_along(bottom - top, text)) {
    box.include({x - 4, top + 0.3});
    box.include({x + 1, bottom - 0.3});
  } else {
    const double half = std::max((bottom - top) / 2, 1.6);
    box.include({x - 1, (top + bottom) / 2 - half});
    box.include({x + 1 + text_width(text, kDimensionText_mm), (top + bottom) / 2 + half});
  }
  return box;
}

bool SvgCanvas::is_free(const Box& box) const {
  return std::none_of(taken_.begin(), taken_.end(), [&](const Box& other) {
    return (box.min.array() < other.max.array()).all() && (other.min.array() < box.max.array()).all();
  });
}

std::string SvgCanvas::sheet(double width_mm, double height_mm, const std::string& title) const {
  const std::string w = number(width_mm), h = number(height_mm);
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + w +
         "mm\" height=\"" + h + "mm\" viewBox=\"0 0 " + w + " " + h + "\">\n<title>" + escaped(title) +
         "</title>\n<style>" + kStyle + "</style>\n" + kHatch + "\n<rect width=\"" + w + "\" height=\"" + h +
         "\" fill=\"#fff\"/>\n" + body_.str() + "</svg>\n";
}

Box box_around(const Point& centre, double width, double height) {
  const Point half(width / 2, height / 2);
  return {centre - half, centre + half};
}

double text_width(const std::string& text, double size_mm) {
  const auto letters = std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; });
  return 0.6 * size_mm * static_cast<double>(letters);
}

std::vector<std::string> wrapped(const std::string& text, double size_mm, double width_mm) {
  const auto most = static_cast<std::size_t>(std::max(8.0, width_mm / (0.6 * size_mm)));
  std::vector<std::string> lines{""};
  std::istringstream words(printable(text));
  for (std::string word; words >> word;) {
    while (word.size() > most) {  // never within a character
      std::size_t cut = most;
      while (cut > 1 && (word[cut] & 0xC0) == 0x80) --cut;
      lines.push_back(word.substr(0, cut));
      word = word.substr(cut);
    }
    if (!lines.back().empty() && lines.back().size() + 1 + word.size() > most) lines.emplace_back();
    lines.back() += (lines.back().empty() ? "" : " ") + word;
  }
  if (lines.size() > 1 && lines.front().empty()) lines.erase(lines.begin());
  return lines;
}

}  // namespace formotion
