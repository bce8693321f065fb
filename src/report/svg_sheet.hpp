// What stands around a drawing on its sheet: tables, legend, title block.
#pragma once

#include <string>
#include <vector>

#include "report/svg_canvas.hpp"

namespace formotion {

// Rows of a table; the first one is its head.
struct Table {
  std::string title;
  std::vector<std::vector<std::string>> rows;
};

struct LegendEntry {
  const char* style;  // of SvgCanvas
  const char* text;
};

// Tables side by side from a corner on, in the next row where they do not fit. Returns where they end below.
double draw_tables(SvgCanvas& canvas, const std::vector<Table>& tables, const Point& top_left, double right);
// A bar of 50 mm to check the print with, and what the styles mean. Returns where it ends below.
double draw_legend(SvgCanvas& canvas, const std::vector<LegendEntry>& entries, const Point& top_left);
// Returns where it ends, at least at foot.
double draw_title_block(SvgCanvas& canvas, const std::string& title, const std::vector<std::string>& notes,
                        const Point& top_right, double foot);

}  // namespace formotion
