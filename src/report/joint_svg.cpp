#include <algorithm>
#include <cmath>
#include <cstdio>

#include "report/joint_drawing.hpp"
#include "report/joint_outline.hpp"
#include "report/svg_canvas.hpp"
#include "report/svg_corners.hpp"
#include "report/svg_sheet.hpp"

namespace formotion {
namespace {

constexpr double kFrame_mm = 8;
constexpr double kLeastSheet_mm = 240;
constexpr double kText_mm = 2.8;
constexpr double kAround_mm = 30;      // on paper: for dimensions, the arrow and numbers
constexpr double kMostDrawn_mm = 170;  // on paper, either way
constexpr std::size_t kMostNumbered = 40;

std::string angle_text(double rad) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f\u00b0", rad * 180 / 3.14159265358979323846);
  return text;
}

std::string scale_text(double scale) {
  char text[32];
  std::snprintf(text, sizeof text, scale >= 1 ? "%.0f:1" : "1:%.0f", scale >= 1 ? scale : 1 / scale);
  return text;
}

class Sheet {
 public:
  explicit Sheet(const JointDrawing& drawing) : drawing_(drawing), frame_(drawing.approach_rad) {
    for (const Polygon& piece : fixed_pieces(drawing.fixed_mm)) {
      add_fixed(piece.outer);
      for (const Loop& hole : piece.holes) add_fixed(hole);
    }
    part_ = seen(drawing.part);
    if (drawing.words.has_goal()) goal_ = seen(at_goal(drawing));
    for (const std::vector<Loop>* loops : {&fixed_, &part_, &goal_}) {
      for (const Loop& loop : *loops) {
        for (const Point& p : loop) extent_.include(p);
      }
    }
    extent_.include(frame_.seen(drawing.centre_mm));
    const Point size = extent_.max - extent_.min;
    for (const double scale : {0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0}) {
      if (size.maxCoeff() * scale <= kMostDrawn_mm) scale_ = scale;
    }
    width_ = std::max(kLeastSheet_mm, scale_ * size.x() + 2 * (kFrame_mm + kAround_mm));
    left_ = (width_ - scale_ * size.x()) / 2;
    top_ = kFrame_mm + kAround_mm / 2;
  }

  std::string draw() {
    shapes();
    centre();
    approach();
    reserve_corners();
    part_dimensions();
    openings();
    corners();
    faces();
    bottom_ = page({0, extent_.max.y()}).y() + 10;
    tables();
    canvas_.path(
        {{kFrame_mm, kFrame_mm}, {width_ - kFrame_mm, kFrame_mm}, {width_ - kFrame_mm, bottom_}, {kFrame_mm, bottom_}},
        true, "box");
    return canvas_.sheet(width_, bottom_ + kFrame_mm, drawing_.title);
  }

 private:
  void add_fixed(const Loop& loop) {
    fixed_.push_back(frame_.seen(loop));
    fixed_in_file_.push_back(loop);
  }
  std::vector<Loop> seen(const Polygon& polygon) const {
    std::vector<Loop> loops{frame_.seen(polygon.outer)};
    for (const Loop& hole : polygon.holes) loops.push_back(frame_.seen(hole));
    return loops;
  }
  Point page(const Point& p) const { return Point(left_, top_) + scale_ * (p - extent_.min); }
  std::vector<Loop> page(const std::vector<Loop>& loops) const {
    std::vector<Loop> result;
    for (const Loop& loop : loops) {
      result.emplace_back();
      for (const Point& p : loop) result.back().push_back(page(p));
    }
    return result;
  }

  void shapes() {
    canvas_.area(page(fixed_), "metal");
    canvas_.area(page(part_), "feed");
    for (const Loop& loop : page(fixed_)) canvas_.path(loop, true, "cut");
    if (!goal_.empty()) canvas_.area(page(goal_), "rail");
  }

  void centre() {
    const Point c = page(frame_.seen(drawing_.centre_mm));
    canvas_.line(c - Point(4, 0), c + Point(4, 0), "axis");
    canvas_.line(c - Point(0, 4), c + Point(0, 4), "axis");
    canvas_.circle(c, 1.4, "mark");
    canvas_.text(c + Point(2, -1.6), "C", {kText_mm, Anchor::Start, true, false, true});
    canvas_.take(box_around(c + Point(1, -1), 9, 9));
  }

  void approach() {
    const double x = left_ - 18, y = page(bounding_box(part_[0]).min).y() + 2;
    canvas_.path({{x - 1.5, y},
                  {x + 1.5, y},
                  {x + 1.5, y + 12},
                  {x + 3, y + 12},
                  {x, y + 17},
                  {x - 3, y + 12},
                  {x - 1.5, y + 12}},
                 true, "feed");
    canvas_.text({x, y - 1.5}, drawing_.words.arrow, {2.6, Anchor::Middle, true, false, false});
    canvas_.take(box_around({x, y + 7}, 18, 24));
  }

  void reserve_corners() {
    for (const std::vector<Loop>* loops : {&fixed_, &part_}) {
      for (const Loop& loop : *loops) {
        for (const Point& p : loop) canvas_.take(box_around(page(p), 1.2, 1.2));
      }
    }
  }

  // The part's size and its way to the goal, outside of it.
  void part_dimensions() {
    const Box box = bounding_box(part_[0]);
    const Point least = page(box.min), most = page(box.max);
    const double y = least.y() - 5;
    for (const double x : {least.x(), most.x()}) canvas_.line({x, least.y() - 0.8}, {x, y - 1.2}, "dim");
    canvas_.horizontal_dimension(least.x(), most.x(), y, length_text(box.max.x() - box.min.x()));
    canvas_.take(box_around({(least.x() + most.x()) / 2, y - 2}, std::max(16.0, most.x() - least.x()), 5));
    beside(most.x(), page(extent_.max).x() + 8, least.y(), most.y(), length_text(box.max.y() - box.min.y()));
    if (drawing_.depth_mm <= 0) return;
    const double deep = most.y() + scale_ * drawing_.depth_mm;
    beside(most.x(), page(extent_.max).x() + 16, most.y(), deep, "depth " + length_text(drawing_.depth_mm));
    for (const Width& width : widths(part_, Between::Material)) {
      if (width.to - width.from < box.max.x() - box.min.x() - 1e-6) across(width);
    }
  }

  void beside(double edge, double x, double y_from, double y_to, const std::string& text) {
    for (const double y : {y_from, y_to}) canvas_.line({edge + 0.8, y}, {x + 1.2, y}, "dim");
    canvas_.vertical_dimension(x, y_from, y_to, text);
    canvas_.take(SvgCanvas::vertical_dimension_box(x, y_from, y_to, text));
  }

  // A dimension between two faces, within their depth, where there is room.
  void across(const Width& width) {
    const std::string text = length_text(width.to - width.from);
    const double from = page({width.from, 0}).x(), to = page({width.to, 0}).x();
    const double top = page({0, width.y_from}).y(), deep = page({0, width.y_to}).y();
    if (deep - top < 1) return;  // the tables of corners have it
    double y = top;
    for (const double share : {0.85, 0.92, 0.7, 0.5, 0.3, 0.15}) {
      y = top + share * (deep - top);
      const Box box = box_around({(from + to) / 2, y - 1.5}, std::max(text_width(text, kText_mm), to - from), 4);
      if (!canvas_.is_free(box)) continue;
      canvas_.take(box);
      canvas_.horizontal_dimension(from, to, y, text);
      return;
    }
  }

  void openings() {
    for (const Width& width : widths(fixed_, Between::Opening)) {
      if (width.constant) {
        across(width);
        continue;
      }
      const double from = page({width.from, 0}).x(), to = page({width.to, 0}).x(), mouth = page({0, width.y_from}).y();
      for (const double x : {from, to}) canvas_.line({x, mouth - 0.8}, {x, mouth - 7.2}, "dim");
      canvas_.horizontal_dimension(from, to, mouth - 6, length_text(width.to - width.from));
      canvas_.take(box_around({(from + to) / 2, mouth - 7.5}, to - from, 4));
    }
  }

  void contour(Table& table, const std::string& name, const Loop& loop, std::size_t& count) {
    const std::vector<Corner> found = loop.size() > kMostNumbered ? corners_of(loop) : sharp(loop);
    if (count + found.size() > kMostNumbered) {
      table.rows.push_back({"", "", "", std::to_string(loop.size()) + " points: see the DXF file"});
      return;
    }
    for (std::size_t k = 0; k < found.size(); ++k) {
      const std::string label = name + "." + std::to_string(++count);
      const Point out = outwards_on_paper(found, k);  // y of the file upwards
      const Point on_paper = frame_.seen(Point(out.x(), -out.y()));
      number_corner(canvas_, label, page(frame_.seen(found[k].at)), on_paper);
      table.rows.push_back({label, length_text(found[k].at.x()), length_text(found[k].at.y()),
                            found[k].radius_mm > 0 ? "R" + length_text(found[k].radius_mm) : ""});
    }
  }

  static std::vector<Corner> sharp(const Loop& loop) {
    std::vector<Corner> corners;
    for (const Point& p : loop) corners.push_back({p, 0});
    return corners;
  }

  void corners() {
    for (std::size_t i = 0; i < fixed_in_file_.size(); ++i) {
      std::size_t count = 0;
      const std::string name = std::to_string(i + 1);
      tables_.push_back({std::string(drawing_.words.shape) + " " + name, {{"corner", "x", "y", ""}}});
      contour(tables_.back(), name, fixed_in_file_[i], count);
    }
    std::size_t count = 0;
    tables_.push_back({drawing_.words.part, {{"corner", "x", "y", ""}}});
    contour(tables_.back(), "P", drawing_.part.outer, count);
    for (const Loop& hole : drawing_.part.holes) contour(tables_.back(), "P", hole, count);
    const Point& c = drawing_.centre_mm;
    tables_.back().rows.push_back({"C", length_text(c.x()), length_text(c.y()), drawing_.words.centre});
  }

  // Slanted faces in a table, and beside them, on their shape, where there is room.
  void faces() {
    Table table{"slanted faces", {{"from", "to", "width", "depth", drawing_.words.to_direction}}};
    for (const SlantedFace& face : slanted_faces(fixed_)) {
      if (fixed_[face.loop].size() > kMostNumbered) continue;
      const std::string shape = std::to_string(face.loop + 1) + ".";
      const std::string width = length_text(face.width_mm), depth = length_text(face.depth_mm);
      const auto corner = [&](std::size_t i) { return shape + std::to_string(i % fixed_[face.loop].size() + 1); };
      table.rows.push_back({corner(face.edge), corner(face.edge + 1), width, depth, angle_text(face.angle_rad)});
      const Point a = page(face.from), b = page(face.to), middle = (a + b) / 2, along = (b - a).normalized();
      // Loops run counter-clockwise in the file and on paper with y upwards: material is on their left.
      const Point inwards = Point(along.y(), -along.x());
      const std::string text = width + " x " + depth + ", " + angle_text(face.angle_rad);
      const double half = text_width(text, kText_mm) / 2;
      for (const double away : {4.0, 7.0, 11.0, 15.0}) {
        const Point place = middle + Point(inwards.x() * (half + away - 2), inwards.y() * away);
        const Box box = box_around(place, 2 * half, 3.6);
        if (!canvas_.is_free(box)) continue;
        canvas_.take(box);
        canvas_.line(middle, place - Point(inwards.x() > 0 ? half : -half, 0), "dim");
        canvas_.text(place + Point(0, 1), text, {kText_mm, Anchor::Middle, false, false, true});
        break;
      }
    }
    if (table.rows.size() > 1) tables_.push_back(std::move(table));
  }

  void tables() {
    bottom_ = draw_tables(canvas_, tables_, {kFrame_mm + 4, bottom_ + 4}, width_ - kFrame_mm - 4) + 4;
    std::vector<std::string> notes = drawing_.notes;
    notes.push_back(std::string("All lengths in mm, coordinates as in the problem file. ") + drawing_.words.direction +
                    " (" + angle_text(drawing_.approach_rad) + " from +x) points down. Scale " + scale_text(scale_) +
                    "; the bar is 50 mm on paper.");
    const JointWords& words = drawing_.words;
    std::vector<LegendEntry> legend{{"metal", words.shapes}, {"feed", words.part}};
    if (words.has_goal()) legend.push_back({"rail", words.goal});
    const std::string centre = std::string("C: ") + words.centre;
    legend.push_back({"axis", centre.c_str()});
    const double foot = draw_legend(canvas_, legend, {kFrame_mm + 5, bottom_ + 2});
    bottom_ = draw_title_block(canvas_, drawing_.title, notes, {width_ - kFrame_mm, bottom_ + 2}, foot);
  }

  const JointDrawing& drawing_;
  ApproachFrame frame_;
  std::vector<Loop> fixed_in_file_;
  std::vector<Loop> fixed_, part_, goal_;  // seen along the approach
  Box extent_;
  double scale_ = 0.01;
  double width_ = 0, left_ = 0, top_ = 0, bottom_ = 0;  // of the sheet; bottom_: how far down it is drawn
  SvgCanvas canvas_;
  std::vector<Table> tables_;
};

}  // namespace

JointWords nest_words() {
  JointWords words;
  words.arrow = "GRAVITY";
  words.direction = "Gravity";
  words.to_direction = "to gravity";
  words.shape = words.shapes = "nest";
  words.part = "part in its seat";
  words.part_layer = "the part in its seat";
  words.goal = "";
  words.centre = "centre of mass";
  return words;
}

std::string joint_svg(const JointDrawing& drawing) { return Sheet(drawing).draw(); }

}  // namespace formotion
