#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/geometry/boolean.hpp"
#include "report/track_drawing.hpp"
#include "report/track_outline.hpp"
#include "solid/stl.hpp"

namespace formotion {
namespace {

constexpr double kWallDepth_mm = 5;
constexpr double kChord_mm = 0.002;  // as the layout's arcs

// Corners on the circle.
Loop chords(const Disc& disc) {
  const double step = 2 * std::acos(std::max(0.5, 1 - kChord_mm / disc.radius_mm));
  const int count = static_cast<int>(std::ceil(2 * std::numbers::pi / step));
  Loop loop;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    loop.push_back(disc.centre + disc.radius_mm * Point(std::cos(angle), std::sin(angle)));
  }
  return loop;
}

}  // namespace

std::string track_stl(const TrackDrawing& drawing) {
  const TrackOutline outline = track_outline(drawing);
  double back = 0;
  for (const Point& p : outline.face) back = std::min(back, p.y());
  back -= kWallDepth_mm;
  Loop wall = outline.face;
  wall.emplace_back(wall.back().x(), back);
  wall.emplace_back(wall.front().x(), back);
  wall = normalised({wall, {}}).outer;

  std::vector<Loop> plate = loops_of(outline.metal);
  for (const Loop& loop : loops_of(intersection({wall}, {rectangle(outline.x_min, back, outline.x_max, 0)})))
    plate.push_back(loop);

  // A fence may begin behind the wall.
  std::vector<Loop> standing = outline.fences;
  for (const Disc& pin : outline.pins) standing.push_back(chords(pin));
  Box box;
  box.include({outline.x_min, back});
  box.include({outline.x_max, outline.y_max});
  standing = loops_of(intersection(standing, {rectangle(box.min.x(), back, box.max.x(), box.max.y() + 1)}));
  standing.push_back(wall);

  const Solid solid = stacked({{united(plate), drawing.plate_mm}, {united(standing), drawing.obstacle_height_mm}});
  return stl(solid, drawing.title);
}

}  // namespace formotion
