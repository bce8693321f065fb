#include "report/track_outline.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "analysis/geometry/boolean.hpp"

namespace formotion {
namespace {

constexpr double kLargestTurn_rad = 0.55;  // between chords of an arc; arcs of io and applications turn by less
constexpr std::size_t kLeastTurns = 3;
constexpr double kWidestFillet_rad = 3.0;  // of the whole turn; beyond, the edges meet too far away

struct Turns {
  explicit Turns(const Loop& points) : loop(points), n(points.size()) {}
  const Loop& loop;
  std::size_t n;
  const Point& at(std::size_t i) const { return loop[i % n]; }
  double length(std::size_t i) const { return (at(i + 1) - at(i)).norm(); }  // of the edge behind corner i
  double angle(std::size_t i) const {
    const Point in = at(i) - at(i + n - 1), out = at(i + 1) - at(i);
    return std::atan2(cross(in, out), in.dot(out));
  }
  // Corners i and i + 1 turn alike.
  bool alike(std::size_t i) const {
    const double a = angle(i), b = angle(i + 1);
    return std::abs(a) < kLargestTurn_rad && std::abs(a - b) <= 0.02 * std::abs(a) && a * b > 0;
  }
  bool same_length(std::size_t i) const { return std::abs(length(i) - length(i + 1)) <= 0.02 * length(i); }
};

// Corners first to first + count - 1 are those of an arc. Chords of io and of dish-outs have their ends on the arc; the
// rounded corners of applications are tangents, the first and last of which are the straight edges themselves.
struct Arc {
  std::size_t first = 0, count = 0;
  bool tangents = false;
  double radius_mm = 0, turned_rad = 0;
};

Arc arc_from(const Turns& turns, std::size_t first, std::size_t count) {
  const double chord = turns.length(first), turn = std::abs(turns.angle(first));
  const auto is_chord = [&](std::size_t i) { return std::abs(turns.length(i) - chord) <= 0.02 * chord; };
  if (is_chord(first + turns.n - 1) && is_chord(first + count - 1)) {
    const double turned = turn * static_cast<double>(count + 1);
    return {(first + turns.n - 1) % turns.n, count + 2, false, chord / (2 * std::sin(turn / 2)), turned};
  }
  return {first % turns.n, count, true, chord / (2 * std::tan(turn / 2)), turn * static_cast<double>(count)};
}

std::vector<Arc> arcs_of(const Turns& turns) {
  std::vector<Arc> arcs;
  // Start where no arc goes on, so that none is cut in two.
  std::size_t start = 0;
  while (start < turns.n && turns.alike(start + turns.n - 1)) ++start;
  for (std::size_t i = start; i < start + turns.n;) {
    std::size_t count = 1;
    while (count < turns.n && turns.alike(i + count - 1) && (count < 2 || turns.same_length(i + count - 2))) ++count;
    if (count >= kLeastTurns && count + 2 <= turns.n) arcs.push_back(arc_from(turns, i, count));
    i += count;
  }
  return arcs;
}

std::optional<Point> meeting(const Point& a, const Point& u, const Point& b, const Point& v) {
  const double d = cross(u, v);
  if (std::abs(d) < 1e-9 * u.norm() * v.norm()) return std::nullopt;
  return Point(a + u * (cross(b - a, v) / d));
}

// A circle as chords, for what meets other shapes.
Loop chords(const Disc& disc) {
  constexpr double kChord_mm = 0.002;
  const double step = 2 * std::acos(std::max(0.5, 1 - kChord_mm / std::max(disc.radius_mm, kChord_mm)));
  const int count = static_cast<int>(std::ceil(2 * std::numbers::pi / step));
  Loop loop;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    loop.emplace_back(disc.centre + disc.radius_mm * Point(std::cos(angle), std::sin(angle)));
  }
  return loop;
}

double distance(const Point& p, const Loop& loop) {
  if (locate(loop, p, 0) != Side::Outside) return 0;
  double least = 1e300;
  for (std::size_t i = 0; i < loop.size(); ++i)
    least = std::min(least, distance_to_segment(p, loop[i], loop[(i + 1) % loop.size()]));
  return least;
}

void add_obstacles(const TrackDrawing& drawing, TrackOutline& outline) {
  constexpr double kApart_mm = 1e-3;  // contours nearer than this cannot be told apart when they are read back
  std::vector<Loop> loops;
  std::vector<Disc> discs;
  for (const feeder::PlacedFeature& feature : drawing.features) {
    const bool is_profile = !feature.wall_face_mm.empty();
    for (const ObstacleShape& obstacle : feature.obstacles) {
      if (obstacle.radius_mm > 0) {
        discs.push_back({obstacle.area.outer.front(), obstacle.radius_mm});
      } else if (!is_profile) {
        loops.push_back(obstacle.area.outer);
      } else {
        const Box box = bounding_box(obstacle.area.outer);
        if (box.max.y() <= 0) continue;
        for (const Polygon& piece :
             intersection({obstacle.area.outer}, {rectangle(box.min.x(), 0, box.max.x(), box.max.y())}))
          loops.push_back(piece.outer);
      }
    }
  }
  std::vector<Loop> meeting_loops = loops;
  for (std::size_t i = 0; i < discs.size(); ++i) {
    const Disc& disc = discs[i];
    bool apart = std::all_of(loops.begin(), loops.end(), [&](const Loop& loop) {
      return distance(disc.centre, loop) > disc.radius_mm + kApart_mm;
    });
    for (std::size_t k = 0; k < discs.size(); ++k) {
      apart =
          apart && (k == i || (discs[k].centre - disc.centre).norm() > discs[k].radius_mm + disc.radius_mm + kApart_mm);
    }
    if (apart) {
      outline.pins.push_back(disc);
    } else {
      meeting_loops.push_back(chords(disc));
    }
  }
  for (const Polygon& polygon : united(meeting_loops)) outline.fences.push_back(polygon.outer);
}

// The wall with profiles in place of its face, by areas: profiles may overlap.
void add_face(const TrackDrawing& drawing, TrackOutline& outline) {
  std::vector<Loop> bodies, hollows;
  Box box;
  box.include({outline.x_min, 0});
  box.include({outline.x_max, 0});
  for (const feeder::PlacedFeature& feature : drawing.features) {
    if (feature.wall_face_mm.empty()) continue;
    outline.has_profile = true;
    for (const Point& p : feature.wall_face_mm) box.include(p);
  }
  outline.face = {{outline.x_min, 0}, {outline.x_max, 0}};
  if (!outline.has_profile) return;
  const double bottom = box.min.y() - 1;
  const Loop below = rectangle(outline.x_min, bottom, outline.x_max, 0);
  for (const feeder::PlacedFeature& feature : drawing.features) {
    if (feature.wall_face_mm.empty()) continue;
    Loop body = feature.wall_face_mm;
    body.emplace_back(body.back().x(), bottom);
    body.emplace_back(body.front().x(), bottom);
    body = normalised({body, {}}).outer;
    for (const Polygon& hollow :
         difference({rectangle(feature.wall_face_mm.front().x(), bottom, feature.wall_face_mm.back().x(), 0)}, {body}))
      hollows.push_back(hollow.outer);
    bodies.push_back(std::move(body));
  }
  for (const Polygon& piece : difference({below}, hollows)) bodies.push_back(piece.outer);
  // The one piece with the corner below on the left; counter-clockwise the face comes from right to left.
  for (const Polygon& wall : united(bodies)) {
    const Loop& loop = wall.outer;
    const auto corner = std::find_if(loop.begin(), loop.end(), [&](const Point& p) {
      return std::abs(p.x() - outline.x_min) < 1e-6 && std::abs(p.y() - bottom) < 1e-6;
    });
    if (corner == loop.end()) continue;
    const std::size_t first = static_cast<std::size_t>(corner - loop.begin());
    outline.face.clear();
    for (std::size_t i = loop.size() - 1; i > 1; --i) outline.face.push_back(loop[(first + i) % loop.size()]);
    return;
  }
}

}  // namespace

TrackOutline track_outline(const TrackDrawing& drawing) {
  TrackOutline outline;
  outline.width_mm = drawing.track_width_mm;
  std::vector<Loop> loops;
  Box box;
  box.include({0, 0});
  box.include({0, drawing.track_width_mm});
  const auto include_x = [&box](const Point& p) { box.include({p.x(), 0}); };
  for (const feeder::PlacedFeature& feature : drawing.features) {
    include_x({feature.start_mm, 0});
    include_x({feature.end_mm, 0});
    for (const Polygon& polygon : feature.voids_mm) {
      loops.push_back(polygon.outer);
      for (const Point& p : polygon.outer) include_x(p);
    }
    for (const Point& p : feature.wall_face_mm) box.include(p);
    if (!feature.wall_face_mm.empty()) continue;
    for (const ObstacleShape& obstacle : feature.obstacles) {
      for (const Point& p : obstacle.area.outer) {
        box.include(p.array() - obstacle.radius_mm);
        box.include(p.array() + obstacle.radius_mm);
      }
    }
  }
  outline.x_min = box.min.x();
  outline.x_max = box.max.x();
  outline.y_min = box.min.y();
  outline.y_max = box.max.y();
  outline.x_min -= drawing.margin_mm;
  outline.x_max += drawing.margin_mm;
  std::vector<Loop> filled;
  for (const Polygon& polygon : united(loops)) filled.push_back(polygon.outer);
  for (const Polygon& polygon : united(filled)) outline.voids.push_back(polygon.outer);  // islands are inside now
  std::sort(outline.voids.begin(), outline.voids.end(),
            [](const Loop& a, const Loop& b) { return bounding_box(a).min.x() < bounding_box(b).min.x(); });
  add_obstacles(drawing, outline);
  add_face(drawing, outline);
  outline.metal = difference({rectangle(outline.x_min, 0, outline.x_max, outline.width_mm)}, outline.voids);
  return outline;
}

std::vector<Corner> corners_of(const Loop& loop) {
  const Turns turns(loop);
  if (turns.n < 3) return {};
  const std::vector<Arc> arcs = arcs_of(turns);
  std::vector<int> arc_at(turns.n, -1);
  for (std::size_t k = 0; k < arcs.size(); ++k) {
    for (std::size_t i = 0; i < arcs[k].count; ++i) arc_at[(arcs[k].first + i) % turns.n] = static_cast<int>(k);
  }
  for (std::size_t k = 0; k < arcs.size(); ++k) arc_at[arcs[k].first] = static_cast<int>(k);  // also where two meet
  std::vector<Corner> corners;
  for (std::size_t i = 0; i < turns.n; ++i) {
    if (arc_at[i] < 0) {
      corners.push_back({turns.at(i), 0});
      continue;
    }
    const Arc& arc = arcs[static_cast<std::size_t>(arc_at[i])];
    if (i != arc.first) continue;
    const std::size_t last = arc.first + arc.count - 1;
    const Point before = turns.at(i + turns.n - 1), in = turns.at(i) - before;
    const Point out = turns.at(last + 1) - turns.at(last);
    // Whether the neighbours go on where the arc ends: chords leave them by half of the turn between chords.
    const double half = arc.turned_rad / static_cast<double>(arc.count - 1) / 2;
    const auto smooth = [&](std::size_t k) { return std::abs(std::abs(turns.angle(k)) - half) <= 0.1 * half; };
    const auto sharp = meeting(before, in, turns.at(last), out);
    if (sharp && arc.turned_rad < kWidestFillet_rad && (arc.tangents || (smooth(i) && smooth(last)))) {
      corners.push_back({*sharp, arc.radius_mm});
    } else {
      corners.push_back({turns.at(i), arc.radius_mm});
      corners.push_back({turns.at(last), arc.radius_mm});
    }
  }
  return corners;
}

std::optional<Disc> disc_of(const Loop& loop) {
  constexpr std::size_t kLeastCorners = 12;
  if (loop.size() < kLeastCorners) return std::nullopt;
  Point centre = Point::Zero();
  for (const Point& p : loop) centre += p / static_cast<double>(loop.size());
  double least = 1e300, most = 0;
  for (const Point& p : loop) {
    least = std::min(least, (p - centre).norm());
    most = std::max(most, (p - centre).norm());
  }
  if (most - least > 1e-4 * most) return std::nullopt;
  return Disc{centre, (least + most) / 2};
}

std::string length_text(double value_mm) {
  char text[64];
  std::snprintf(text, sizeof text, "%.3f", value_mm);
  std::string result = text;
  if (result.find_first_not_of("-0.") == std::string::npos) return "0.00";
  if (result.back() == '0') result.pop_back();
  return result;
}

std::string printable(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const auto c = static_cast<unsigned char>(text[i]);
    const std::size_t length = c < 0x80                ? 1
                               : c >= 0xC2 && c < 0xE0 ? 2
                               : c >= 0xE0 && c < 0xF0 ? 3
                               : c >= 0xF0 && c < 0xF5 ? 4
                                                       : 0;
    bool whole = length > 0 && i + length <= text.size();
    for (std::size_t k = 1; whole && k < length; ++k) whole = (static_cast<unsigned char>(text[i + k]) & 0xC0) == 0x80;
    if (!whole) {
      result += '?';
      ++i;
      continue;
    }
    result += c < ' ' || c == 0x7F ? std::string(" ") : text.substr(i, length);
    i += length;
  }
  return result;
}

}  // namespace formotion
