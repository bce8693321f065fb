#include "io/dxf_import.hpp"

#include <algorithm>

#include "io/dxf_contours.hpp"
#include "io/dxf_entities.hpp"
#include "io/dxf_groups.hpp"
#include "io/json_document.hpp"
#include "io/segment_pairs.hpp"

namespace formotion {
namespace {

constexpr double kTouch_mm = 1e-6;  // edges closer than this touch
constexpr std::size_t kMostMeetings = 20;
constexpr std::size_t kMostPartCorners = 20'000;

struct Contours {
  std::vector<DxfContour> all;
  DxfUnit unit;
  int hidden = 0;
};

// across_layers: contours of different layers must not meet either.
void check_apart(const Contours& contours, bool across_layers, DxfIssues& issues) {
  std::vector<Loop> loops;
  for (const DxfContour& contour : contours.all) loops.push_back(contour.points_mm);
  const auto layer = [&](int i) -> const std::string& { return contours.all[static_cast<std::size_t>(i)].layer; };
  const MeetingsResult found =
      meetings(loops, kTouch_mm, kMostMeetings, [&](int a, int b) { return across_layers || layer(a) == layer(b); });
  for (const Meeting& meeting : found.meetings) {
    const std::string at = dxf_place(meeting.at_mm, contours.unit),
                      on = " on layer '" + dxf_word(layer(meeting.a)) + "'";
    if (meeting.a == meeting.b) {
      issues.add("a contour" + on + " that crosses or touches itself at " + at, "a simple contour");
    } else {
      const bool same = layer(meeting.a) == layer(meeting.b);
      issues.add("two contours" + on + (same ? "" : " and '" + dxf_word(layer(meeting.b)) + "'") +
                     " that cross or touch at " + at,
                 "contours apart from each other");
    }
  }
  if (!found.complete) issues.add("a drawing too dense to be checked for crossings", "fewer edges beside each other");
}

Contours read(const std::string& text, const std::string& file, const DxfOptions& options, bool across_layers) {
  // Issues of entities come alone: with an entity missing its contour is open anyway.
  const DxfDrawing drawing = read_dxf_drawing(text, file, options);
  DxfIssues issues(file);
  Contours contours{joined_contours(drawing, options.join_tolerance_mm, issues), drawing.unit, drawing.hidden};
  check_apart(contours, across_layers, issues);
  issues.throw_if_any();
  return contours;
}

// How many of the other contours contain the first corner of this one; contours are apart.
int depth(const std::vector<DxfContour>& contours, const std::vector<Box>& boxes, std::size_t of) {
  const Point& p = contours[of].points_mm.front();
  int count = 0;
  for (std::size_t i = 0; i < contours.size(); ++i) {
    const bool in_box = (boxes[i].min.array() <= p.array()).all() && (p.array() <= boxes[i].max.array()).all();
    count += i != of && in_box && locate(contours[i].points_mm, p, 0) == Side::Inside;
  }
  return count;
}

}  // namespace

std::vector<DxfContour> parse_dxf(const std::string& text, const std::string& file, const DxfOptions& options) {
  return read(text, file, options, false).all;
}

std::vector<DxfContour> read_dxf(const std::string& path, const DxfOptions& options) {
  return parse_dxf(read_text_file(path), path, options);
}

Polygon parse_dxf_part(const std::string& text, const std::string& file, const DxfOptions& options) {
  const Contours contours = read(text, file, options, true);
  DxfIssues issues(file);
  std::size_t corners = 0;
  std::vector<Box> boxes;
  for (const DxfContour& contour : contours.all) {
    corners += contour.points_mm.size();
    boxes.push_back(bounding_box(contour.points_mm));
  }
  if (corners > kMostPartCorners) {
    issues.add("a part with " + std::to_string(corners) + " corners", "at most " + std::to_string(kMostPartCorners));
    issues.throw_if_any();
  }
  Polygon part;
  for (std::size_t i = 0; i < contours.all.size(); ++i) {
    Loop loop = contours.all[i].points_mm;
    const std::string where = "'" + dxf_word(contours.all[i].layer) + "' at " + dxf_place(loop.front(), contours.unit);
    const int inside_of = depth(contours.all, boxes, i);
    if (inside_of == 0 && !part.outer.empty()) {
      issues.add("one more outermost contour, on layer " + where, "one outline with its holes inside");
    } else if (inside_of == 0) {
      part.outer = std::move(loop);
    } else if (inside_of == 1) {
      std::reverse(loop.begin(), loop.end());
      part.holes.push_back(std::move(loop));
    } else {
      issues.add("a contour inside of a hole, on layer " + where, "one outline with its holes inside");
    }
  }
  if (contours.all.empty()) {
    issues.add(
        "a drawing without a contour" +
            (contours.hidden > 0 ? " (" + std::to_string(contours.hidden) + " hidden entities do not count)" : ""),
        "the part's outline");
  }
  issues.throw_if_any();
  return part;
}

Polygon read_dxf_part(const std::string& path, const DxfOptions& options) {
  return parse_dxf_part(read_text_file(path), path, options);
}

}  // namespace formotion
