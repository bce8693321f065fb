#include "report/svg_sheet.hpp"

#include <algorithm>
#include <numeric>

namespace formotion {
namespace {

constexpr double kText_mm = 2.8;
constexpr double kLine_mm = 4.4;
constexpr double kTitleBlock_mm = 120;

// Numbers end at their column's right: those under x, y, "start x", ...
bool is_number(const Table& table, std::size_t row, std::size_t column) {
  const std::string& head = table.rows[0][column];
  return !table.rows[row][column].empty() && (head == "x" || head == "y" || head.ends_with(" x"));
}

void draw_table(SvgCanvas& canvas, const Table& table, const std::vector<double>& columns, const Point& at) {
  const double wide = std::accumulate(columns.begin(), columns.end(), 0.0);
  double y = at.y() + 3;
  canvas.text({at.x(), y}, table.title, {kText_mm, Anchor::Start, true, false, false});
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    y += kLine_mm;
    double x = at.x();
    for (std::size_t c = 0; c < table.rows[r].size(); ++c) {
      const bool number = is_number(table, r, c);
      const TextStyle style{kText_mm, number ? Anchor::End : Anchor::Start, r == 0, false, false};
      canvas.text({number ? x + columns[c] - 3 : x, y}, table.rows[r][c], style);
      x += columns[c];
    }
    canvas.line({at.x(), y + 1.3}, {at.x() + wide - 2, y + 1.3}, "rule");
  }
}

}  // namespace

double draw_tables(SvgCanvas& canvas, const std::vector<Table>& tables, const Point& top_left, double right) {
  double x = top_left.x(), y = top_left.y(), row_height = 0;
  for (const Table& table : tables) {
    std::vector<double> columns(table.rows[0].size(), 0.0);
    for (const auto& row : table.rows) {
      for (std::size_t c = 0; c < row.size(); ++c) columns[c] = std::max(columns[c], text_width(row[c], kText_mm) + 3);
    }
    const double wide = std::accumulate(columns.begin(), columns.end(), 0.0);
    if (x > top_left.x() && x + wide > right) {
      x = top_left.x();
      y += row_height + 4;
      row_height = 0;
    }
    draw_table(canvas, table, columns, {x, y});
    row_height = std::max(row_height, kLine_mm * static_cast<double>(table.rows.size() + 1));
    x += wide + 6;
  }
  return y + row_height;
}

double draw_legend(SvgCanvas& canvas, const std::vector<LegendEntry>& entries, const Point& top_left) {
  const double x = top_left.x();
  double y = top_left.y() + 8;
  for (int i = 0; i < 5; ++i) {
    const double from = x + 10 * i;
    canvas.path({{from, y - 1.5}, {from + 10, y - 1.5}, {from + 10, y}, {from, y}}, true,
                i % 2 == 0 ? "solid" : "empty");
  }
  for (const int mark : {0, 10, 50}) {
    canvas.text({x + mark, y - 2.5}, std::to_string(mark), {2.5, Anchor::Middle, false, false, false});
  }
  canvas.text({x + 53, y}, "mm", {2.5, Anchor::Start, false, false, false});
  for (const auto& [style, text] : entries) {
    y += 6;
    if (std::string(style) == "axis") {
      canvas.line({x, y - 1}, {x + 10, y - 1}, style);
    } else {
      canvas.path({{x, y - 2.4}, {x + 10, y - 2.4}, {x + 10, y + 0.4}, {x, y + 0.4}}, true, style);
    }
    canvas.text({x + 12, y}, text, {2.5, Anchor::Start, false, false, false});
  }
  return y + 4;
}

double draw_title_block(SvgCanvas& canvas, const std::string& title, const std::vector<std::string>& notes,
                        const Point& top_right, double foot) {
  const double left = top_right.x() - kTitleBlock_mm;
  double y = top_right.y();
  const auto write = [&](const std::string& text, double size, bool bold) {
    for (const std::string& line : wrapped(text, size, kTitleBlock_mm - 6)) {
      y += 1.5 * size;
      canvas.text({left + 3, y}, line, {size, Anchor::Start, bold, false, false});
    }
  };
  write(title, 4, true);
  for (const std::string& note : notes) write(note, kText_mm, false);
  const double bottom = std::max(y + 3, foot);
  canvas.path({{left, top_right.y()}, top_right, {top_right.x(), bottom}, {left, bottom}}, true, "box");
  return bottom;
}

}  // namespace formotion
