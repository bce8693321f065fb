#include <algorithm>
#include <cmath>
#include <numeric>

#include "report/svg_canvas.hpp"
#include "report/svg_corners.hpp"
#include "report/svg_sheet.hpp"
#include "report/track_drawing.hpp"
#include "report/track_outline.hpp"

namespace formotion {
namespace {

constexpr double kFrame_mm = 8;
constexpr double kSide_mm = 26;  // beside the strip: the width's dimension, names of the edges
constexpr double kRow_mm = 8;    // of feature labels above the strip
constexpr double kWall_mm = 5;   // of hatching
constexpr double kOrdinates_mm = 30;
constexpr double kLeastSheet_mm = 210;
constexpr double kText_mm = 2.8;
constexpr std::size_t kMostNumbered = 40;

using feeder::PlacedFeature;

std::optional<double> dimension(const PlacedFeature& feature, const std::string& name) {
  for (const auto& [key, value] : feature.dimensions) {
    if (key == name) return value;
  }
  return std::nullopt;
}

// Shapes that a table of corners (and centres) says.
bool by_corners(const PlacedFeature& feature) {
  for (const char* type : {"cutout", "drawing", "fence", "wall", "pin"}) {
    if (feature.type == type) return true;
  }
  return false;
}

// The radius of the feature's rounded corners, if it has such.
double corner_radius(const PlacedFeature& feature) {
  double radius = 0;
  for (const Polygon& polygon : feature.voids_mm) {
    for (const Corner& corner : corners_of(polygon.outer)) radius = std::max(radius, corner.radius_mm);
  }
  return radius;
}

// What dimension lines do not show.
std::string remarks(const PlacedFeature& feature) {
  std::string text;
  if (const auto height = dimension(feature, "height_mm")) text += ", height " + length_text(*height);
  if (const auto angle = dimension(feature, "half_angle_deg")) text += ", half angle " + length_text(*angle) + "\u00b0";
  if (const double radius = corner_radius(feature); radius > 0 && !by_corners(feature)) {
    text += (feature.type == "dish-out" ? ", R" : ", corners R") + length_text(radius);
  }
  return text;
}

std::string parameters(const PlacedFeature& feature, const std::string& name) {
  if (by_corners(feature)) return (feature.type == "pin" ? "centre: table " : "corners: table ") + name;
  std::string text;
  for (const auto& [key, value] : feature.dimensions) {
    std::string word = key.substr(0, key.rfind('_'));
    std::replace(word.begin(), word.end(), '_', ' ');
    const bool degrees = key.size() > 4 && key.substr(key.size() - 4) == "_deg";
    text += (text.empty() ? "" : ", ") + word + " " + length_text(value) + (degrees ? "\u00b0" : "");
  }
  if (const double radius = corner_radius(feature); radius > 0) text += ", R " + length_text(radius);
  return text;
}

class Sheet {
 public:
  explicit Sheet(const TrackDrawing& drawing) : drawing_(drawing), outline_(track_outline(drawing)) {
    const double strip = outline_.x_max - outline_.x_min;
    width_ = std::max(kLeastSheet_mm, strip + 2 * (kFrame_mm + kSide_mm));
    left_ = (width_ - strip) / 2;
    pack_labels();
    above_ = outline_.y_max - outline_.width_mm;
    wall_ = kWall_mm - std::min(outline_.y_min, 0.0);
    top_ = kFrame_mm + 6 + kRow_mm * (label_rows_ + 0.5) + above_;
  }

  std::string draw() {
    strip();
    wall();
    obstacles();
    blades();
    labels();
    datum();
    reserve_corners();
    heights();
    corners();
    ordinates();
    tables();
    const double height = bottom_ + kFrame_mm;
    canvas_.path(
        {{kFrame_mm, kFrame_mm}, {width_ - kFrame_mm, kFrame_mm}, {width_ - kFrame_mm, bottom_}, {kFrame_mm, bottom_}},
        true, "box");
    return canvas_.sheet(width_, height, drawing_.title);
  }

 private:
  struct Label {
    std::string text;
    double from = 0, to = 0;  // on paper
    double row = 0;
  };

  Point on_paper(const Point& p) const { return {page_x(p.x()), page_y(p.y())}; }
  double page_x(double x) const { return left_ + x - outline_.x_min; }
  double page_y(double y) const { return top_ + outline_.width_mm - y; }
  Loop on_paper(const Loop& loop) const {
    Loop result;
    for (const Point& p : loop) result.push_back(on_paper(p));
    return result;
  }
  static std::string name(std::size_t i) { return "F" + std::to_string(i + 1); }

  void pack_labels() {
    std::vector<double> row_end;
    labels_.resize(drawing_.features.size());
    std::vector<std::size_t> order(labels_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto& features = drawing_.features;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return features[a].start_mm < features[b].start_mm; });
    for (const std::size_t i : order) {
      const PlacedFeature& feature = features[i];
      Label& label = labels_[i];
      const double length = feature.end_mm - feature.start_mm;
      label.text = name(i) + " " + feature.type + (length > 0 ? " " + length_text(length) : "") + remarks(feature);
      const double centre = page_x((feature.start_mm + feature.end_mm) / 2);
      const double half =
          std::max(text_width(label.text, kText_mm), std::abs(length) + (length < 6 ? 12 : 0)) / 2 + 1.5;
      label.from = centre - half;
      label.to = centre + half;
      std::size_t row = 0;
      while (row < row_end.size() && row_end[row] > label.from) ++row;
      if (row == row_end.size()) row_end.push_back(0);
      row_end[row] = label.to;
      label.row = static_cast<double>(row);
    }
    label_rows_ = static_cast<double>(row_end.size());
  }

  // Metal filled; its edges drawn but where the track goes on beyond the drawing.
  void strip() {
    std::vector<Loop> fill;
    for (const Polygon& piece : outline_.metal) {
      fill.push_back(on_paper(piece.outer));
      for (const Loop& hole : piece.holes) fill.push_back(on_paper(hole));
    }
    canvas_.area(fill, "metal");
    for (const Polygon& piece : outline_.metal) {
      edges(piece.outer);
      for (const Loop& hole : piece.holes) edges(hole);
    }
    for (const double x : {outline_.x_min, outline_.x_max}) {
      const double px = page_x(x), low = page_y(0), high = page_y(outline_.width_mm), middle = (low + high) / 2;
      canvas_.path(
          {{px, low}, {px, middle + 2}, {px - 1.5, middle + 1}, {px + 1.5, middle - 1}, {px, middle - 2}, {px, high}},
          false, "break");
    }
    const double room = std::min(drawing_.margin_mm - 6, 24.0);
    if (room < 8 || outline_.width_mm < 8) return;
    const double x = page_x(outline_.x_min) + 3, y = page_y(outline_.width_mm / 2);
    canvas_.path({{x, y - 1.5},
                  {x + room - 4, y - 1.5},
                  {x + room - 4, y - 3},
                  {x + room, y},
                  {x + room - 4, y + 3},
                  {x + room - 4, y + 1.5},
                  {x, y + 1.5}},
                 true, "feed");
    if (room > 14) canvas_.text({x + room / 2 - 1.5, y + 0.9}, "FEED", {2.6, Anchor::Middle, true, false, false});
    canvas_.take(box_around({x + room / 2, y}, room + 2, 8));
  }

  void edges(const Loop& loop) {
    const auto at_end = [&](const Point& a, const Point& b) {
      return (a.x() == b.x()) && (std::abs(a.x() - outline_.x_min) < 1e-6 || std::abs(a.x() - outline_.x_max) < 1e-6);
    };
    for (std::size_t i = 0; i < loop.size();) {
      Loop run{on_paper(loop[i])};
      while (i < loop.size() && !at_end(loop[i], loop[(i + 1) % loop.size()]))
        run.push_back(on_paper(loop[++i % loop.size()]));
      if (run.size() > 1) canvas_.path(run, false, "cut");
      ++i;
    }
  }

  void wall() {
    const double from = page_x(outline_.x_min) - 4, to = page_x(outline_.x_max) + 4, y = page_y(0);
    Loop face = on_paper(outline_.face);
    face.insert(face.begin(), {from, y});
    face.emplace_back(to, y);
    Loop body = face;
    body.emplace_back(to, y + wall_);
    body.emplace_back(from, y + wall_);
    canvas_.area({body}, "fixed");
    canvas_.path(face, false, "face");
    canvas_.text({to + 2, y + 1}, "wall, y = 0", {2.5, Anchor::Start, false, false, true});
    canvas_.text({to + 2, page_y(outline_.width_mm) + 1}, "free edge", {2.5, Anchor::Start, false, false, true});
    const double x = page_x(outline_.x_min) - 10;
    for (const double edge : {0.0, outline_.width_mm})
      canvas_.line({x - 1.5, page_y(edge)}, {page_x(outline_.x_min) - 1, page_y(edge)}, "dim");
    canvas_.vertical_dimension(x, page_y(0), page_y(outline_.width_mm), length_text(outline_.width_mm));
  }

  void obstacles() {
    for (const Loop& loop : outline_.fences) {
      canvas_.area({on_paper(loop)}, "fixed");
      canvas_.path(on_paper(loop), true, "face");
    }
    for (const Disc& pin : outline_.pins) {
      const Point centre = on_paper(pin.centre);
      canvas_.circle(centre, pin.radius_mm, "fixed");
      canvas_.circle(centre, pin.radius_mm, "face");
      const double reach = pin.radius_mm + 1.5;
      canvas_.line({centre.x() - reach, centre.y()}, {centre.x() + reach, centre.y()}, "centre");
      canvas_.line({centre.x(), centre.y() - reach}, {centre.x(), centre.y() + reach}, "centre");
    }
  }

  void blades() {
    const double low = page_y(0), high = page_y(outline_.width_mm);
    for (const PlacedFeature& feature : drawing_.features) {
      const double from = page_x(feature.start_mm), to = page_x(feature.end_mm);
      if (feature.type == "wiper") canvas_.line({from, low}, {from, high - 2}, "blade");
      if (feature.type == "hold-down") canvas_.path({{from, low}, {to, low}, {to, high}, {from, high}}, true, "rail");
    }
  }

  void labels() {
    const double edge = page_y(outline_.y_max);
    for (std::size_t i = 0; i < labels_.size(); ++i) {
      const PlacedFeature& feature = drawing_.features[i];
      const double y = edge - 5 - kRow_mm * labels_[i].row, from = page_x(feature.start_mm),
                   to = page_x(feature.end_mm);
      for (const double x : {from, to}) canvas_.line({x, edge - 0.8}, {x, y - 1.2}, "dim");
    }
    for (std::size_t i = 0; i < labels_.size(); ++i) {
      const PlacedFeature& feature = drawing_.features[i];
      const double y = edge - 5 - kRow_mm * labels_[i].row, from = page_x(feature.start_mm),
                   to = page_x(feature.end_mm);
      if (to > from) {
        canvas_.horizontal_dimension(from, to, y, labels_[i].text);
      } else {
        canvas_.text({from, y - 2}, labels_[i].text, {kText_mm, Anchor::Middle, false, false, true});
      }
    }
  }

  void datum() {
    const double x = page_x(0), y = page_y(0);
    canvas_.line({x, page_y(outline_.width_mm) - 3}, {x, y + wall_ + 3}, "axis");
    canvas_.path({{x, y}, {x - 1.6, y + 2.8}, {x + 1.6, y + 2.8}}, true, "datum");
  }

  // A dimension across the track for a feature: inside of it where there is room, else beside it, else in the table
  // alone.
  void height(const PlacedFeature& feature, double y_from, double y_to) {
    if (!(y_from >= 0 && y_to <= outline_.width_mm && y_to > y_from)) return;
    const std::string text = length_text(y_to - y_from);
    const double start = page_x(feature.start_mm), end = page_x(feature.end_mm), length = end - start;
    std::vector<double> places;
    for (const double part : {0.5, 0.3, 0.7, 0.15, 0.85, 0.4, 0.6, 0.05, 0.95}) {
      const double x = feature.start_mm + part * length;
      if (on_edge({x, y_from}) && on_edge({x, y_to})) places.push_back(page_x(x));
    }
    if (places.empty()) return;  // another feature has taken the edge away: the table has the number
    if (length < 14) places.clear();
    for (const double away : {6.0, 12.0, 18.0}) {
      places.push_back(start - away);
      places.push_back(end + away);
    }
    const auto box = [&](double x) { return SvgCanvas::vertical_dimension_box(x, page_y(y_from), page_y(y_to), text); };
    const auto found = std::find_if(places.begin(), places.end(), [&](double x) { return canvas_.is_free(box(x)); });
    if (found == places.end()) return;
    const double x = *found;
    for (const double y : {y_from, y_to}) {  // from the feature's edge to a dimension beside it
      if (y <= 0 || (x > start && x < end)) continue;
      canvas_.line({x < start ? start : end, page_y(y)}, {x + (x < start ? -1.2 : 1.2), page_y(y)}, "dim");
    }
    canvas_.vertical_dimension(x, page_y(y_from), page_y(y_to), text);
    canvas_.take(box(x));
  }

  bool on_edge(const Point& p) const {
    if (p.y() <= 0 || p.y() >= outline_.width_mm) return true;
    return std::any_of(outline_.voids.begin(), outline_.voids.end(),
                       [&](const Loop& loop) { return locate(loop, p, 1e-6) == Side::Boundary; });
  }

  void heights() {
    for (const PlacedFeature& feature : drawing_.features) {
      const double width = outline_.width_mm;
      if (feature.type == "balcony") height(feature, 0, dimension(feature, "width_mm").value_or(0));
      if (const auto from = dimension(feature, "from_mm")) height(feature, 0, *from);
      if (const auto to = dimension(feature, "to_mm")) height(feature, 0, *to);
      if (const auto depth = dimension(feature, "depth_mm")) height(feature, width - *depth, width);
    }
  }

  void reserve_corners() {
    for (const PlacedFeature& feature : drawing_.features) {
      if (!by_corners(feature)) continue;
      const auto reserve = [&](const Loop& loop) {
        for (const Point& p : loop) canvas_.take(box_around(on_paper(p), 0.6, 0.6));
      };
      for (const Polygon& polygon : feature.voids_mm) reserve(polygon.outer);
      for (const ObstacleShape& obstacle : feature.obstacles) reserve(obstacle.area.outer);
    }
  }

  // A feature's table of corners while it is filled, and the numbers beside them.
  struct CornerTable {
    Sheet& sheet;
    std::size_t feature;
    Table table;
    std::size_t count = 0;

    CornerTable(Sheet& of, std::size_t index) : sheet(of), feature(index) {
      table = {name(index) + " " + of.drawing_.features[index].type, {{"corner", "x", "y", ""}}};
    }
    void row(const Point& at, const Point& outward, const std::string& remark) {
      const std::string label = std::to_string(feature + 1) + "." + std::to_string(++count);
      number_corner(sheet.canvas_, label, sheet.on_paper(at), outward);
      table.rows.push_back({label, length_text(at.x()), length_text(at.y()), remark});
    }
    void disc(const Disc& disc) { row(disc.centre, {0, 0}, "centre of \u00d8" + length_text(2 * disc.radius_mm)); }
    void summary(const Loop& loop) {
      const Box box = bounding_box(loop);
      table.rows.push_back(
          {"least", length_text(box.min.x()), length_text(box.min.y()), "a contour of " + std::to_string(loop.size())});
      table.rows.push_back(
          {"greatest", length_text(box.max.x()), length_text(box.max.y()), "points: see the DXF file"});
    }
    void contour(const Loop& loop) {
      if (const auto found = disc_of(loop)) return disc(*found);
      const std::vector<Corner> found = corners_of(loop);
      if (count + found.size() > kMostNumbered) return summary(loop);
      for (std::size_t k = 0; k < found.size(); ++k) {
        row(found[k].at, outwards_on_paper(found, k),
            found[k].radius_mm > 0 ? "R" + length_text(found[k].radius_mm) : "");
      }
    }
    void face(const Loop& points) {
      if (points.size() > kMostNumbered) return summary(points);
      for (const Point& p : points) row(p, {0, -1}, "");
    }
  };

  // Numbers at the corners of cut-outs and obstacles, and their tables.
  void corners() {
    canvas_.take({{page_x(outline_.x_min), page_y(0) - 0.4}, {page_x(outline_.x_max), page_y(0) + wall_ + 1}});
    for (std::size_t i = 0; i < drawing_.features.size(); ++i) {
      const PlacedFeature& feature = drawing_.features[i];
      if (!by_corners(feature)) continue;
      CornerTable table(*this, i);
      for (const Polygon& polygon : feature.voids_mm) table.contour(polygon.outer);
      if (!feature.wall_face_mm.empty()) {
        table.face(feature.wall_face_mm);
      } else {
        for (const ObstacleShape& obstacle : feature.obstacles) {
          if (obstacle.radius_mm > 0) {
            table.disc({obstacle.area.outer.front(), obstacle.radius_mm});
          } else {
            table.contour(obstacle.area.outer);
          }
        }
      }
      tables_.push_back(std::move(table.table));
    }
  }

  // The x of starts and ends from the datum, below the wall; numbers that would overlap are moved apart.
  void ordinates() {
    struct Ordinate {
      double x = 0, low = 0;  // world: where, and the height at which its edge begins
      double paper = 0;       // of the number
    };
    std::vector<Ordinate> list{{0, 0, 0}};
    const auto add = [&](double x, double low) {
      for (Ordinate& known : list) {
        if (std::abs(known.x - x) > 5e-4) continue;
        known.low = std::min(known.low, low);
        return;
      }
      list.push_back({x, low, 0});
    };
    for (const PlacedFeature& feature : drawing_.features) {
      double low = feature.voids_mm.empty() ? 0 : outline_.width_mm;
      for (const Polygon& polygon : feature.voids_mm) low = std::min(low, bounding_box(polygon.outer).min.y());
      if (!feature.obstacles.empty()) low = 0;
      add(feature.start_mm, low);
      if (feature.end_mm > feature.start_mm) add(feature.end_mm, low);
    }
    std::sort(list.begin(), list.end(), [](const Ordinate& a, const Ordinate& b) { return a.x < b.x; });
    spread(list);
    const double y = page_y(0), knee = y + wall_ + 3, foot = knee + 6;
    for (const Ordinate& ordinate : list) {
      const double x = page_x(ordinate.x);
      canvas_.path({{x, page_y(ordinate.low)}, {x, knee}, {ordinate.paper, foot - 1}, {ordinate.paper, foot}}, false,
                   "dim");
      canvas_.text({ordinate.paper + 1, foot + 1}, length_text(ordinate.x),
                   {kText_mm, Anchor::End, ordinate.x == 0, true, true});
    }
    canvas_.text({page_x(outline_.x_min) - 22, foot + 6}, "x from the datum", {2.5, Anchor::Start, false, false, true});
    bottom_ = y + kOrdinates_mm + wall_ - kWall_mm;
  }

  // Positions at least kApart from each other and as near to their x as that allows: neighbours that collide share
  // their mean (pool adjacent violators).
  template <class Ordinate>
  void spread(std::vector<Ordinate>& list) const {
    constexpr double kApart = 4;
    struct Block {
      double sum = 0;
      double count = 0;
    };
    std::vector<Block> blocks;
    for (std::size_t i = 0; i < list.size(); ++i) {
      blocks.push_back({page_x(list[i].x) - kApart * static_cast<double>(i), 1});
      while (blocks.size() > 1) {
        const Block last = blocks.back();
        Block& before = blocks[blocks.size() - 2];
        if (before.sum / before.count <= last.sum / last.count) break;
        before.sum += last.sum;
        before.count += last.count;
        blocks.pop_back();
      }
    }
    std::size_t i = 0;
    for (const Block& block : blocks) {
      for (double k = 0; k < block.count; ++k, ++i)
        list[i].paper = block.sum / block.count + kApart * static_cast<double>(i);
    }
  }

  void tables() {
    Table all{"features", {{"no.", "type", "start x", "end x", "dimensions"}}};
    double first = 0, last = 0;
    for (std::size_t i = 0; i < drawing_.features.size(); ++i) {
      const PlacedFeature& feature = drawing_.features[i];
      all.rows.push_back({name(i), feature.type, length_text(feature.start_mm), length_text(feature.end_mm),
                          parameters(feature, name(i))});
      first = i == 0 ? feature.start_mm : std::min(first, feature.start_mm);
      last = i == 0 ? feature.end_mm : std::max(last, feature.end_mm);
    }
    tables_.insert(tables_.begin(), std::move(all));
    bottom_ = draw_tables(canvas_, tables_, {kFrame_mm + 4, bottom_ + 4}, width_ - kFrame_mm - 4) + 4;

    std::vector<std::string> notes{"track width " + length_text(outline_.width_mm) + ", features over " +
                                   length_text(last - first) + " of length"};
    notes.insert(notes.end(), drawing_.notes.begin(), drawing_.notes.end());
    notes.push_back(
        "All lengths in mm. Seen from above, scale 1:1 (check it with the bar). The track goes on unchanged at both "
        "ends.");
    std::vector<LegendEntry> legend{{"metal", "metal of the track"}, {"empty", "cut away"}, {"axis", "datum x = 0"}};
    const bool bladed = std::any_of(
        drawing_.features.begin(), drawing_.features.end(),
        [](const PlacedFeature& feature) { return feature.type == "wiper" || feature.type == "hold-down"; });
    if (!outline_.fences.empty() || !outline_.pins.empty()) legend.push_back({"fixed", "stands on the track"});
    if (bladed) legend.push_back({"rail", "blade or rail above the track, at its height"});
    const double foot = draw_legend(canvas_, legend, {kFrame_mm + 5, bottom_ + 2});
    bottom_ = draw_title_block(canvas_, drawing_.title, notes, {width_ - kFrame_mm, bottom_ + 2}, foot);
  }

  const TrackDrawing& drawing_;
  TrackOutline outline_;
  SvgCanvas canvas_;
  std::vector<Label> labels_;
  std::vector<Table> tables_;
  double label_rows_ = 0;
  double width_ = 0, left_ = 0, top_ = 0, bottom_ = 0;  // of the sheet; bottom_: how far down it is drawn
  double above_ = 0;                                    // what obstacles have beyond the free edge
  double wall_ = 0;                                     // how far down the wall is drawn
};

}  // namespace

std::string track_svg(const TrackDrawing& drawing) { return Sheet(drawing).draw(); }

}  // namespace formotion
