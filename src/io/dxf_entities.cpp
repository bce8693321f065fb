#include "io/dxf_entities.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <sstream>

#include "io/dxf_groups.hpp"

namespace formotion {
namespace {

constexpr double kFlat_mm = 1e-6;
constexpr double kLargest_mm = 1e9;
constexpr double kLargestBulge = 1e6;  // an arc that lacks 4e-6 rad to a full turn
constexpr double kLeastTurn_deg = 1e-6;
constexpr double kLargestStep_rad = std::numbers::pi / 6;
constexpr std::size_t kMostPoints = 1'000'000;
constexpr std::size_t kMostGroups = 4 * kMostPoints;  // of one entity

// Annotation, fills and construction lines: drawn, but not cut.
const std::set<std::string_view> kNeverCut{
    "TEXT",    "MTEXT",   "ATTRIB", "ATTDEF",    "DIMENSION",  "ARC_DIMENSION", "LARGE_RADIAL_DIMENSION",
    "LEADER",  "MLEADER", "POINT",  "TOLERANCE", "ACAD_TABLE", "MULTILEADER",   "HATCH",
    "XLINE",   "RAY",     "IMAGE",  "VIEWPORT",  "WIPEOUT",    "SEQEND",        "ENDSEC",
    "SECTION", "EOF"};

std::string upper(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return result;
}

std::string what_to_do(const std::string& type) {
  if (type == "INSERT") return "plain lines and arcs: explode the block references";
  if (type == "SPLINE" || type == "ELLIPSE" || type == "HELIX") return "lines and arcs: convert it to polylines";
  if (type == "MLINE" || type == "REGION") return "plain lines and arcs: explode it";
  return "LINE, ARC, CIRCLE, LWPOLYLINE or POLYLINE entities";
}

std::optional<DxfUnit> unit_of(int code) {
  static const std::map<int, DxfUnit> known{{0, {1, "mm"}},       {1, {25.4, "inches"}},   {2, {304.8, "feet"}},
                                            {4, {1, "mm"}},       {5, {10, "cm"}},         {6, {1000, "m"}},
                                            {9, {0.0254, "mil"}}, {13, {0.001, "microns"}}};
  const auto found = known.find(code);
  return found == known.end() ? std::nullopt : std::optional<DxfUnit>(found->second);
}

// Turn between the ends of a chord that leaves its arc by the tolerance: r (1 - cos(step / 2)) = 2 r sin^2(step / 4).
double step_for(double radius_mm, double tolerance_mm) {
  return std::min(kLargestStep_rad, 4 * std::asin(std::sqrt(std::min(1.0, tolerance_mm / (2 * radius_mm)))));
}

// What stands between two groups of code 0.
struct Record {
  std::string type;
  int line = 0;
  std::vector<DxfGroup> groups;
};

struct Vertex {
  Point at = Point::Zero();  // in drawing units
  double bulge = 0;          // of the segment that follows: tan of a quarter of its turn
};

class Reader {
 public:
  Reader(const std::string& text, const std::string& file, const DxfOptions& options)
      : groups_(text, file), options_(options), issues_(file) {}

  DxfDrawing read() {
    bool entities = false;
    while (const auto group = groups_.next()) {
      if (group->code == 0) {
        finish_record();
        record_ = {std::string(group->value), group->line, {}};
        if (group->value == "SECTION" || group->value == "ENDSEC") section_.clear();
      } else if (record_.type == "SECTION" && section_.empty() && group->code == 2) {
        section_ = upper(group->value);
        entities |= section_ == "ENTITIES";
      } else if (section_ == "HEADER") {
        header(*group);
      } else if (wanted() && group->code < 1000) {  // codes from 1000 on are other programs' data
        record_.groups.push_back(*group);
        if (record_.groups.size() > kMostGroups) too_large();
      }
    }
    finish_record();
    finish_polyline();
    if (!entities) issues_.add("a text without an ENTITIES section", "a DXF drawing");
    for (const auto& [key, tally] : tallies_) {
      issues_.add(std::to_string(tally.count) + " " + key.first + " on layer '" + dxf_word(key.second) +
                      "', the first " + tally.where,
                  tally.expected);
    }
    issues_.throw_if_any();
    return std::move(drawing_);
  }

 private:
  struct Tally {
    int count = 0;
    std::string where, expected;
  };
  struct Polyline {
    std::string layer;
    bool closed = false, mirrored = false;
    std::vector<Vertex> vertices;
  };

  bool wanted() const {
    if (section_ == "TABLES") return record_.type == "LAYER";
    return section_ == "ENTITIES" && !kNeverCut.contains(record_.type);
  }

  void header(const DxfGroup& group) {
    if (group.code == 9) variable_ = group.value;
    if (variable_ != "$INSUNITS" || group.code != 70) return;
    int code = -1;
    std::from_chars(group.value.data(), group.value.data() + group.value.size(), code);
    if (const auto unit = unit_of(code)) {
      drawing_.unit = *unit;
    } else {
      issues_.add("the unit $INSUNITS '" + dxf_word(group.value) + "'",
                  "0 (none: mm), 1 (inch), 2 (feet), 4 (mm), 5 (cm), 6 (m), 9 (mil) or 13 (micron)", group.line);
    }
  }

  void finish_record() {
    if (section_ == "TABLES" && record_.type == "LAYER") layer();
    if (section_ == "ENTITIES" && record_.type != "SECTION") entity();
    record_ = {};
  }

  std::string_view text_of(int code, std::string_view otherwise) const {
    for (const DxfGroup& group : record_.groups) {
      if (group.code == code) return group.value;
    }
    return otherwise;
  }

  int integer(int code, int otherwise) {
    for (const DxfGroup& group : record_.groups) {
      if (group.code != code) continue;
      int value = 0;
      const auto [end, error] = std::from_chars(group.value.data(), group.value.data() + group.value.size(), value);
      if (error == std::errc() && end == group.value.data() + group.value.size()) return value;
      issues_.add("'" + dxf_word(group.value) + "' for group " + std::to_string(code), "an integer", group.line);
    }
    return otherwise;
  }

  // A number of a group; wrong ones are issues and count as 0.
  double number(const DxfGroup& group) {
    const auto value = dxf_number(group.value);
    if (value && std::abs(*value) * std::max(1.0, drawing_.unit.mm) <= kLargest_mm) return *value;
    issues_.add("'" + dxf_word(group.value) + "' for group " + std::to_string(group.code),
                value ? "a number of at most 1e9 mm" : "a number", group.line);
    return 0;
  }
  double number(int code, std::optional<double> otherwise) {
    for (const DxfGroup& group : record_.groups) {
      if (group.code == code) return number(group);
    }
    if (!otherwise) {
      issues_.add("a " + record_.type + " without group " + std::to_string(code), "the group", record_.line);
    }
    return otherwise.value_or(0);
  }
  Point point(int x_code, int y_code) { return {number(x_code, {}), number(y_code, {})}; }

  void layer() {
    if ((integer(70, 0) & 1) != 0 || integer(62, 7) < 0) hidden_layers_.insert(upper(text_of(2, "")));
  }

  // The name of the record's layer; none where the layer does not count.
  std::optional<std::string> counting_layer() const {
    const std::string name(text_of(8, "0"));
    if (options_.layers.empty()) return name;
    for (const std::string& layer : options_.layers) {
      if (upper(layer) == upper(name)) return layer;
    }
    return std::nullopt;
  }

  void tally(const std::string& what, const std::string& layer, const std::string& expected) {
    Tally& tally = tallies_[{what, layer}];
    if (tally.count++ > 0) return;
    const auto x = dxf_number(text_of(10, "")), y = dxf_number(text_of(20, ""));
    tally.where = x && y ? "at " + dxf_place(Point(*x, *y) * drawing_.unit.mm, drawing_.unit) + ", line " : "in line ";
    tally.where += std::to_string(record_.line);
    tally.expected = expected;
  }

  // Whether the record lies in the drawing's plane; mirrored: it is seen from below (extrusion along -z).
  bool flat(const std::string& layer, bool in_own_plane, bool& mirrored) {
    const double nx = number(210, 0), ny = number(220, 0), nz = number(230, 1);
    const double length = std::hypot(nx, ny, nz);
    const bool upright = std::hypot(nx, ny) <= 1e-9 * length && length > 0;
    mirrored = in_own_plane && nz < 0;
    bool low = true;
    for (const DxfGroup& group : record_.groups) {
      if (group.code != 30 && group.code != 31 && group.code != 38) continue;
      low &= std::abs(number(group)) * drawing_.unit.mm <= kFlat_mm;
    }
    if (low && (upright || !in_own_plane)) return true;
    tally(record_.type + (low ? " tilted out of the drawing's plane" : " with z other than 0"), layer,
          "a flat drawing at z = 0");
    return false;
  }

  void entity() {
    if (record_.type.empty()) return;
    if (record_.type == "VERTEX") {
      if (polyline_) vertex();  // else of a polyline that does not count
      return;
    }
    finish_polyline();
    if (kNeverCut.contains(record_.type)) return;
    const auto layer = counting_layer();
    if (!layer || integer(67, 0) != 0) return;
    if (hidden_layers_.contains(upper(text_of(8, "0"))) || integer(60, 0) != 0) {
      ++drawing_.hidden;
      return;
    }
    if (record_.type == "LINE") {
      line(*layer);
    } else if (record_.type == "ARC" || record_.type == "CIRCLE") {
      arc(*layer);
    } else if (record_.type == "LWPOLYLINE") {
      light_polyline(*layer);
    } else if (record_.type == "POLYLINE") {
      begin_polyline(*layer);
    } else {
      tally("unsupported " + dxf_word(record_.type), *layer, what_to_do(record_.type));
    }
  }

  void line(const std::string& layer) {
    bool mirrored = false;
    if (!flat(layer, false, mirrored)) return;
    const Point from = point(10, 20), to = point(11, 21);
    take_room(2);
    add({layer, false, {from, to}}, false);
  }

  void arc(const std::string& layer) {
    bool mirrored = false;
    if (!flat(layer, true, mirrored)) return;
    const Point centre = point(10, 20);
    const double radius = number(40, {});
    if (!(radius > 0)) {
      tally(record_.type + " with a radius of " + dxf_word(text_of(40, "0")), layer, "a radius above 0");
      return;
    }
    const bool circle = record_.type == "CIRCLE";
    const double from_deg = circle ? 0 : number(50, {}), to_deg = circle ? 360 : number(51, {});
    double turn_deg = std::fmod(to_deg - from_deg, 360.0);  // always counter-clockwise
    if (turn_deg <= kLeastTurn_deg) turn_deg += 360;        // from 0 to 360 is a full circle
    const bool closed = turn_deg >= 360;
    if (closed) turn_deg = 360;
    const double turn = turn_deg / 180 * std::numbers::pi;
    double steps = std::ceil(turn / step_for(radius * drawing_.unit.mm, options_.chord_tolerance_mm) - 1e-9);
    if (closed) steps = 4 * std::ceil(steps / 4);  // vertices at the quadrants: the extent is exact
    take_room(steps);
    DxfPath path{layer, closed, {}};
    for (double i = 0; i < steps + (closed ? 0 : 1); ++i) {
      const double angle = (from_deg + turn_deg * i / steps) / 180 * std::numbers::pi;
      path.points_mm.emplace_back(centre + radius * Point(std::cos(angle), std::sin(angle)));
    }
    add(std::move(path), mirrored);
  }

  void light_polyline(const std::string& layer) {
    Polyline polyline{layer, (integer(70, 0) & 1) != 0, false, {}};
    if (!flat(layer, true, polyline.mirrored)) return;
    for (const DxfGroup& group : record_.groups) {
      if (group.code == 101) break;  // an embedded object follows
      if (group.code == 10) polyline.vertices.push_back({{number(group), 0}, 0});
      if (polyline.vertices.empty()) continue;
      if (group.code == 20) polyline.vertices.back().at.y() = number(group);
      if (group.code == 42) polyline.vertices.back().bulge = bulge(group);
    }
    add(polyline);
  }

  void begin_polyline(const std::string& layer) {
    constexpr int kClosed = 1, kIn3d = 8, kMesh = 16, kPolyface = 64;
    const int flags = integer(70, 0);
    if ((flags & (kMesh | kPolyface)) != 0) return tally("unsupported POLYLINE meshes", layer, what_to_do(""));
    Polyline polyline{layer, (flags & kClosed) != 0, false, {}};
    if (!flat(layer, (flags & kIn3d) == 0, polyline.mirrored)) return;
    polyline_ = std::move(polyline);
  }

  void vertex() {
    constexpr int kFrameOfSpline = 16;  // a control point: not on the curve
    if ((integer(70, 0) & kFrameOfSpline) != 0) return;
    bool mirrored = false;
    if (!flat(polyline_->layer, false, mirrored)) return;
    Vertex vertex{point(10, 20), 0};
    for (const DxfGroup& group : record_.groups) {
      if (group.code == 42) vertex.bulge = bulge(group);
    }
    polyline_->vertices.push_back(vertex);
    if (polyline_->vertices.size() > kMostPoints) too_large();
  }

  double bulge(const DxfGroup& group) {
    const double value = number(group);
    if (std::abs(value) <= kLargestBulge) return value;
    issues_.add("a bulge of " + dxf_word(group.value), "one of at most 1e6", group.line);
    return 0;
  }

  void finish_polyline() {
    if (polyline_) add(*polyline_);
    polyline_.reset();
  }

  void add(const Polyline& polyline) {
    if (polyline.vertices.empty()) return;
    DxfPath path{polyline.layer, polyline.closed, {}};
    const std::size_t n = polyline.vertices.size();
    take_room(static_cast<double>(n));
    for (std::size_t i = 0; i < n; ++i) {
      path.points_mm.push_back(polyline.vertices[i].at);
      if (i + 1 < n || polyline.closed)
        append_arc(path.points_mm, polyline.vertices[i], polyline.vertices[(i + 1) % n].at);
    }
    add(std::move(path), polyline.mirrored);
  }

  // The inner points of the arc from a vertex to the next one. By chords from its start: no centre that lies far away.
  void append_arc(Loop& points, const Vertex& from, const Point& to) {
    const Point chord = to - from.at;
    const double length = chord.norm(), b = std::abs(from.bulge);
    if (length == 0 || b * length / 2 * drawing_.unit.mm < 1e-9) return;  // the sagitta
    const double turn = 4 * std::atan(b), diameter = length * (1 + b * b) / (2 * b);
    const double steps =
        std::ceil(turn / step_for(diameter / 2 * drawing_.unit.mm, options_.chord_tolerance_mm) - 1e-9);
    take_room(steps);
    const double sense = from.bulge > 0 ? 1 : -1;  // positive: counter-clockwise, to the right of the chord
    for (double i = 1; i < steps; ++i) {
      const double part = turn * i / steps;
      const double angle = sense * (part - turn) / 2;
      const Point along = chord / length * std::cos(angle) + Point(-chord.y(), chord.x()) / length * std::sin(angle);
      points.emplace_back(from.at + diameter * std::sin(part / 2) * along);
    }
  }

  void add(DxfPath path, bool mirrored) {
    for (Point& p : path.points_mm) {
      if (mirrored) p.x() = -p.x();  // the object's own axes for a normal along -z (DXF's arbitrary axis algorithm)
      p *= drawing_.unit.mm;
    }
    drawing_.paths.push_back(std::move(path));
  }

  // Before points are made: a large arc in a small file may ask for any number of chords.
  void take_room(double points) {
    if (points_ + points > static_cast<double>(kMostPoints)) too_large();
    points_ += points;
  }
  [[noreturn]] void too_large() const {
    throw InputError({{groups_.file(), "", false, "a drawing of more than " + std::to_string(kMostPoints) + " points",
                       "a smaller one"}});
  }

  DxfGroups groups_;
  const DxfOptions& options_;
  DxfIssues issues_;
  DxfDrawing drawing_;
  std::string section_, variable_;
  Record record_;
  std::optional<Polyline> polyline_;
  std::set<std::string> hidden_layers_;  // upper case
  std::map<std::pair<std::string, std::string>, Tally> tallies_;
  double points_ = 0;
};

}  // namespace

std::string dxf_place(const Point& p_mm, const DxfUnit& unit) {
  const auto pair = [](const Point& p) {
    std::ostringstream out;
    out.precision(9);
    out << "(" << p.x() + 0.0 << ", " << p.y() + 0.0 << ")";
    return out.str();
  };
  std::string place = pair(p_mm) + " mm";
  if (unit.mm != 1) place += ", in the drawing " + pair(p_mm / unit.mm) + " " + unit.name;
  return place;
}

DxfDrawing read_dxf_drawing(const std::string& text, const std::string& file, const DxfOptions& options) {
  return Reader(text, file, options).read();
}

void DxfIssues::add(const std::string& found, const std::string& expected, int line) {
  if (full()) {
    ++more_;
  } else {
    issues_.push_back({file_, line > 0 ? std::to_string(line) + ":1" : "", line > 0, found, expected});
  }
}

void DxfIssues::throw_if_any() const {
  if (issues_.empty()) return;
  std::vector<InputIssue> all = issues_;
  if (more_ > 0) all.push_back({file_, "", false, std::to_string(more_) + " more problems", ""});
  throw InputError(std::move(all));
}

}  // namespace formotion
