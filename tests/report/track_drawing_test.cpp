#include "report/track_drawing.hpp"

#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "analysis/geometry/boolean.hpp"
#include "analysis/geometry/offset.hpp"
#include "io/dxf_import.hpp"
#include "report/track_outline.hpp"

using namespace formotion;
using feeder::PlacedFeature;

namespace {

constexpr double kWidth = 40;

std::vector<Polygon> in_strip(const std::vector<Loop>& loops) {
  return intersection(loops, {rectangle(-1000, 0, 3000, kWidth)});
}

std::vector<Loop> milled(const Loop& loop, double radius) {
  OffsetOptions options;
  options.arc_step_rad = 2 * std::acos(1 - 0.002 / radius);
  return offset(offset({loop}, -radius, options), radius, options);
}

PlacedFeature balcony(double start, double length, double width) {
  return {"balcony",
          start,
          start + length,
          in_strip({rectangle(start, width, start + length, 100)}),
          {{"width_mm", width}, {"length_mm", length}}};
}

PlacedFeature gap(double start, double length) {
  return {"gap", start, start + length, in_strip({rectangle(start, -9, start + length, 100)}), {{"length_mm", length}}};
}

PlacedFeature slot(double start, double length, double from, double to, double radius = 0) {
  const Loop loop = rectangle(start, from, start + length, to);
  return {"slot",
          start,
          start + length,
          in_strip(radius > 0 ? milled(loop, radius) : std::vector<Loop>{loop}),
          {{"from_mm", from}, {"to_mm", to}, {"length_mm", length}}};
}

PlacedFeature cutout(double start, Loop loop) {
  for (Point& p : loop) p.x() += start;
  return {"cutout", start, bounding_box(loop).max.x(), in_strip({loop}), {}};
}

Loop dish(double start, double length, double depth) {
  const double radius = (length * length / 4 + depth * depth) / (2 * depth), half = std::asin(length / 2 / radius);
  Loop loop;
  for (int i = 0; i <= 60; ++i) {
    const double angle = half * (i / 30.0 - 1);
    loop.emplace_back(start + length / 2 + radius * std::sin(angle),
                      kWidth - depth + radius - radius * std::cos(angle));
  }
  return loop;
}

TrackDrawing example() {
  TrackDrawing drawing;
  drawing.title = "el bracket <up> & \"down\", design 7";
  drawing.track_width_mm = kWidth;
  drawing.features = {balcony(0, 60, 9.0613), cutout(80, {{2.3, 4.7}, {21.33, 1.812}, {14.25, 17.94}}), gap(140, 3.2),
                      slot(180, 30, 10.5, 18.25, 2), slot(200, 30, 15, 45)};
  drawing.features.push_back(
      {"dish-out", 260, 290, in_strip({dish(260, 30, 8)}), {{"depth_mm", 8}, {"length_mm", 30}}});
  drawing.features.push_back({"wiper", 320, 320, {}, {{"height_mm", 4.25}}});
  drawing.features.push_back({"hold-down", 100, 150, {}, {{"height_mm", 3.5}, {"length_mm", 50}}});
  drawing.notes = {"delivers up 0.00 deg", "temperature 20 \u00b0C"};
  return drawing;
}

PlacedFeature fence(double start, Loop loop) {
  for (Point& p : loop) p.x() += start;
  PlacedFeature feature{"fence", start, bounding_box(loop).max.x(), {}, {}};
  feature.obstacles = {{normalised({loop, {}})}};
  return feature;
}

PlacedFeature pin(double start, const Point& centre, double diameter) {
  PlacedFeature feature{"pin", start, start + centre.x() + diameter / 2, {}, {}};
  feature.obstacles = {{{{centre + Point(start, 0)}, {}}, diameter / 2}};
  return feature;
}

PlacedFeature profile(double start, Loop face) {
  for (Point& p : face) p.x() += start;
  PlacedFeature feature{"wall", start, face.back().x(), {}, {}};
  feature.wall_face_mm = face;
  face.emplace_back(face.back().x(), -200);
  face.emplace_back(face.front().x(), -200);
  feature.obstacles = {{normalised({face, {}})}};
  return feature;
}

// A ramp that begins in the wall, two pins, one of which touches a fence, a step with a recess behind it, a cut-out
// under a fence that stands out over the free edge.
TrackDrawing guided() {
  TrackDrawing drawing;
  drawing.title = "guided";
  drawing.track_width_mm = kWidth;
  drawing.features = {fence(0, {{0, -5}, {50, -5}, {50, 12}, {37, 12}}),
                      pin(80, {9.25, 21.5}, 6),
                      profile(120, {{0, 0}, {20, 8}, {20, -1.5}, {35, -1.5}, {35, 0}}),
                      cutout(200, {{0, 20}, {25, 12}, {25, 45}, {0, 45}}),
                      fence(195, {{0, 15}, {40, 15}, {40, 52}}),
                      pin(230, {5, 17}, 4)};
  return drawing;
}

double area(const std::vector<Loop>& loops) {
  double sum = 0;
  for (const Loop& loop : loops) sum += std::abs(signed_area(loop));
  return sum;
}

std::vector<Loop> on_layer(const std::string& dxf, const std::string& layer) {
  DxfOptions options;
  options.layers = {layer};
  std::vector<Loop> loops;
  for (const DxfContour& contour : parse_dxf(dxf, "track.dxf", options)) loops.push_back(contour.points_mm);
  return loops;
}

// Every corner of each set has one of the other within the tolerance.
bool same_corners(const std::vector<Loop>& a, const std::vector<Loop>& b, double tolerance) {
  const auto covered = [&](const std::vector<Loop>& some, const std::vector<Loop>& others) {
    for (const Loop& loop : some) {
      for (const Point& p : loop) {
        double least = 1e300;
        for (const Loop& other : others) {
          for (const Point& q : other) least = std::min(least, (p - q).norm());
        }
        if (least > tolerance) return false;
      }
    }
    return true;
  };
  return covered(a, b) && covered(b, a);
}

// What stands between two marks, for every occurrence from a place on.
std::vector<std::string> all_between(const std::string& text, const std::string& before, const std::string& after) {
  std::vector<std::string> found;
  for (std::size_t at = text.find(before); at != std::string::npos; at = text.find(before, at)) {
    at += before.size();
    const std::size_t end = text.find(after, at);
    if (end == std::string::npos) break;
    found.push_back(text.substr(at, end - at));
  }
  return found;
}

std::string between(const std::string& text, const std::string& before, const std::string& after) {
  const auto found = all_between(text, before, after);
  REQUIRE_FALSE(found.empty());
  return found.front();
}

// The SVG's texts.
std::vector<std::string> texts(const std::string& svg) {
  std::vector<std::string> found;
  for (const std::string& element : all_between(svg, "<text", "</text>")) {
    found.push_back(element.substr(element.find('>') + 1));
  }
  return found;
}

// The numbers of a path's data.
std::vector<double> numbers(std::string data) {
  std::replace_if(
      data.begin(), data.end(), [](char c) { return c == 'M' || c == 'L' || c == 'Z'; }, ' ');
  std::istringstream stream(data);
  std::vector<double> found;
  for (double value = 0; stream >> value;) found.push_back(value);
  return found;
}

}  // namespace

TEST_CASE("the written DXF is read back: every void as a closed contour within the strip") {
  const TrackDrawing drawing = example();
  std::vector<Loop> voids;
  for (const PlacedFeature& feature : drawing.features) {
    for (const Polygon& polygon : feature.voids_mm) voids.push_back(polygon.outer);
  }
  const std::vector<Loop> whole = loops_of(united(voids)), read = on_layer(track_dxf(drawing), "VOID");
  CHECK(read.size() == 5);  // the two slots overlap
  CHECK(same_corners(whole, read, 1e-6));
  CHECK(area(read) == Approx(area(whole)).margin(1e-6));
  const auto nothing = difference(loops_of(united(read)), {rectangle(-1000, 0, 3000, kWidth)});
  CHECK(nothing.empty());
}

TEST_CASE("layer TRACK is the metal: with the voids it fills the strip") {
  const TrackDrawing drawing = example();
  const std::string dxf = track_dxf(drawing);
  const std::vector<Loop> track = on_layer(dxf, "TRACK");
  double metal = 0;  // holes count negative
  for (std::size_t i = 0; i < track.size(); ++i) {
    int depth = 0;
    for (std::size_t k = 0; k < track.size(); ++k) {
      depth += k != i && locate(track[k], track[i].front(), 0) == Side::Inside;
    }
    metal += depth % 2 == 0 ? signed_area(track[i]) : -signed_area(track[i]);
  }
  CHECK(metal + area(on_layer(dxf, "VOID")) == Approx((320 + 2 * drawing.margin_mm) * kWidth).margin(1e-6));
}

TEST_CASE(
    "a written drawing can be the `drawing` feature of a problem: its layers VOID and WALL hold closed contours") {
  DxfOptions options;
  options.layers = {"VOID", "WALL"};
  CHECK(parse_dxf(track_dxf(example()), "track.dxf", options).size() == 5);
}

TEST_CASE("what stands on the track is read back from layer WALL, what is removed from VOID") {
  const std::string dxf = track_dxf(guided());
  const std::vector<Loop> walls = on_layer(dxf, "WALL");
  std::vector<Loop> expected;
  for (const PlacedFeature& feature : guided().features) {
    for (const ObstacleShape& obstacle : feature.obstacles) {
      if (obstacle.radius_mm > 0) {
        Loop circle;
        for (int i = 0; i < 720; ++i) {
          const double angle = M_PI * i / 360;
          circle.emplace_back(obstacle.area.outer[0] + obstacle.radius_mm * Point(std::cos(angle), std::sin(angle)));
        }
        expected.push_back(circle);
      } else if (feature.type == "wall") {
        expected.push_back({{120, 0}, {140, 0}, {140, 8}});  // the recess is the wall's
      } else {
        expected.push_back(obstacle.area.outer);
      }
    }
  }
  REQUIRE(walls.size() == 4);  // the second pin is one with the fence
  const auto extra = [](const std::vector<Loop>& a, const std::vector<Loop>& b) {
    return area(loops_of(difference(a, b)));
  };
  CHECK(extra(walls, loops_of(united(expected))) < 0.05);  // a circle is read as chords within 0.002 mm
  CHECK(extra(loops_of(united(expected)), walls) < 0.05);
  CHECK(same_corners(on_layer(dxf, "VOID"), loops_of(in_strip({{{200, 20}, {225, 12}, {225, 45}, {200, 45}}})), 1e-6));
  std::vector<Loop> fences;  // sharp corners come back as they were
  for (const Loop& loop : walls) {
    if (loop.size() < 10) fences.push_back(loop);
  }
  CHECK(same_corners(fences, {{{0, -5}, {50, -5}, {50, 12}, {37, 12}}, {{120, 0}, {140, 0}, {140, 8}}}, 1e-6));
}

TEST_CASE("the wall's face stands on layer FACE, pins as circles with crosses, only where there are such") {
  const std::string dxf = track_dxf(guided());
  const std::string face = between(dxf, "POLYLINE\n8\nFACE\n", "SEQEND");
  CHECK(between(face, "\n70\n", "\n") == "0");  // open
  std::vector<double> xs, ys;
  for (const std::string& vertex : all_between(face, "VERTEX\n8\nFACE\n10\n", "\n30\n")) {
    xs.push_back(std::stod(vertex));
    ys.push_back(std::stod(vertex.substr(vertex.find("\n20\n") + 4)));
  }
  const std::vector<double> x{-30, 120, 140, 140, 155, 155, 267}, y{0, 0, 8, -1.5, -1.5, 0, 0};
  REQUIRE(xs.size() == x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    CHECK(xs[i] == Approx(x[i]).margin(1e-6));
    CHECK(ys[i] == Approx(y[i]).margin(1e-6));
  }
  CHECK(all_between(dxf, "\nCIRCLE\n8\nWALL\n", "\n40\n").size() == 1);
  CHECK(all_between(dxf, "\nLINE\n8\nCENTER\n", "\n11\n").size() == 2);
  const std::string plain = track_dxf(example());
  for (const char* layer : {"\n8\nWALL\n", "\n8\nFACE\n", "\n8\nCENTER\n"}) {
    CHECK(plain.find(layer) == std::string::npos);
  }
}

TEST_CASE("the SVG numbers the corners of obstacles and says where they are") {
  const std::string svg = track_svg(guided());
  const auto shown = texts(svg);
  const std::set<std::string> words(shown.begin(), shown.end());
  for (const char* word : {"F1 fence 50.00", "-5.00", "37.00", "12.00", "1.4", "F2 pin 12.25", "89.25", "21.50",
                           "centre of \u00d86.00", "F3 wall 35.00", "140.00", "8.00", "155.00", "-1.50", "3.5",
                           "235.00", "52.00", "centre of \u00d84.00", "stands on the track"}) {
    CAPTURE(word);
    CHECK(words.contains(word));
  }
  CHECK(all_between(svg, "<circle class=\"fixed\"", ">").size() == 1);
  // Everything is on the sheet, also what stands out over the free edge.
  const double wide = std::stod(between(svg, "width=\"", "mm\"")), high = std::stod(between(svg, "height=\"", "mm\""));
  for (const std::string& path : all_between(svg, " d=\"", "\"")) {
    if (path == "M.9 0V1.8") continue;  // of the hatching
    const auto coordinates = numbers(path);
    for (std::size_t i = 0; i + 1 < coordinates.size(); i += 2) {
      CHECK((coordinates[i] > 0 && coordinates[i] < wide));
      CHECK((coordinates[i + 1] > 0 && coordinates[i + 1] < high));
    }
  }
  CHECK(std::none_of(shown.begin(), shown.end(), [](const std::string& text) { return text == "-200.00"; }));
}

TEST_CASE("metal that is cut free all around counts as void") {
  TrackDrawing drawing;
  drawing.track_width_mm = kWidth;
  PlacedFeature ring{"drawing", 0, 20, {}, {}};
  ring.voids_mm = difference({rectangle(0, 5, 20, 25)}, {rectangle(5, 10, 15, 20)});
  REQUIRE(ring.voids_mm.at(0).holes.size() == 1);
  drawing.features = {ring};
  CHECK(area(on_layer(track_dxf(drawing), "VOID")) == Approx(400));
  CHECK(on_layer(track_dxf(drawing), "TRACK").size() == 2);
}

TEST_CASE("ezdxf audits the written DXF without an error and finds the same contours") {
  const TrackDrawing drawing = GENERATE(example(), guided());
  const std::filesystem::path folder = std::filesystem::temp_directory_path();
  const std::string path = (folder / ("track_drawing_test_" + std::to_string(::getpid()) + ".dxf")).string();
  const std::string dxf = track_dxf(drawing);
  std::ofstream(path) << dxf;
  const std::string command = "/usr/bin/python3 " FORMOTION_SOURCE_DIR "/tests/report/audit_dxf.py " + path + " 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  REQUIRE(pipe != nullptr);
  std::string said;
  char buffer[4096];
  while (std::fgets(buffer, sizeof buffer, pipe) != nullptr) said += buffer;
  const int status = pclose(pipe);
  std::filesystem::remove(path);
  CAPTURE(said);
  REQUIRE(status == 0);
  CHECK_THAT(said, Catch::StartsWith("AC1009 4\n"));
  double on_circles = 0;  // which the audit leaves out
  for (const Loop& loop : on_layer(dxf, "WALL")) {
    if (disc_of(loop)) on_circles += area({loop});
  }
  std::map<std::string, double> areas;
  std::istringstream lines(said.substr(said.find('\n') + 1));
  std::string layer;
  double corners = 0, contour = 0;
  while (lines >> layer >> corners >> contour) areas[layer] += contour;
  CHECK(areas["VOID"] == Approx(area(on_layer(dxf, "VOID"))).margin(1e-5));
  CHECK(areas["TRACK"] == Approx(area(on_layer(dxf, "TRACK"))).margin(1e-5));
  CHECK(areas["WALL"] == Approx(area(on_layer(dxf, "WALL")) - on_circles).margin(1e-5));
  CHECK(areas["BLADE"] == Approx(drawing.title == "guided" ? 0 : 50 * kWidth));
}

TEST_CASE("notes reach the DXF as ASCII, other characters by their number") {
  const std::string dxf = track_dxf(example());
  CHECK_THAT(dxf, Catch::Contains("temperature 20 \\U+00B0C\n"));
  CHECK(std::all_of(dxf.begin(), dxf.end(), [](char c) { return c == '\n' || (c >= ' ' && c <= '~'); }));
}

TEST_CASE("the SVG is to scale: one unit is one millimetre, on paper and in the drawing") {
  const std::string svg = track_svg(example());
  const double wide = std::stod(between(svg, "width=\"", "mm\"")), high = std::stod(between(svg, "height=\"", "mm\""));
  CHECK(numbers(between(svg, "viewBox=\"", "\"")) == std::vector<double>{0, 0, wide, high});
  const auto coordinates = numbers(between(svg, "class=\"metal\" fill-rule=\"evenodd\" d=\"", "\""));
  Box box;
  for (std::size_t i = 0; i + 1 < coordinates.size(); i += 2) box.include({coordinates[i], coordinates[i + 1]});
  CHECK(box.max.x() - box.min.x() == Approx(320 + 60).margin(1e-3));
  CHECK(box.max.y() - box.min.y() == Approx(kWidth).margin(1e-3));
  CHECK(box.max.x() < wide);
  CHECK(box.max.y() < high);
}

TEST_CASE("the SVG shows every feature's start, end and parameters, and the corners of cut-outs") {
  const auto shown = texts(track_svg(example()));
  const std::set<std::string> words(shown.begin(), shown.end());
  for (const char* word : {"0.00", "60.00", "9.061", "140.00", "143.20", "180.00", "210.00", "10.50", "82.30", "4.70",
                           "101.33", "1.812", "94.25", "17.94", "8.00", "FEED", "wall, y = 0", "free edge", "320.00"}) {
    CAPTURE(word);
    CHECK(words.contains(word));
  }
  CHECK(words.contains("F4 slot 30.00, corners R2.00"));
  CHECK(words.contains("F7 wiper, height 4.25"));
  CHECK(words.contains("F8 hold-down 50.00, height 3.50"));
  CHECK(words.contains("el bracket &lt;up&gt; &amp; &quot;down&quot;, design 7"));
}

TEST_CASE("numbers of features do not cover each other however close their edges are") {
  TrackDrawing drawing;
  drawing.track_width_mm = kWidth;
  for (int i = 0; i < 12; ++i) drawing.features.push_back(slot(1.7 * i, 1, 5 + i, 8 + i));
  const std::string svg = track_svg(drawing);
  std::vector<double> at;  // of the numbers below the wall
  for (const std::string& element : all_between(svg, "<text ", ">")) {
    if (element.find("rotate") == std::string::npos || element.find("anchor=\"end\"") == std::string::npos) continue;
    at.push_back(std::stod(between(element, "x=\"", "\"")));
  }
  REQUIRE(at.size() == 24);
  std::sort(at.begin(), at.end());
  for (std::size_t i = 1; i < at.size(); ++i) CHECK(at[i] - at[i - 1] >= 4 - 1e-3);
}

TEST_CASE("a drawing without features, with broken text and with shapes out of the ordinary is still drawn") {
  TrackDrawing drawing;
  drawing.track_width_mm = 3;
  drawing.margin_mm = 1;
  drawing.title = "\xff\x01 \xc3";
  CHECK_THAT(track_svg(drawing), Catch::Contains("</svg>") && Catch::Contains("?") && !Catch::Contains("\xff"));
  CHECK_THAT(track_dxf(drawing), Catch::EndsWith("0\nEOF\n"));
  drawing.features = {{"gap", 5, 5, {}, {}}};  // a feature that the variables made impossible
  CHECK_THAT(track_svg(drawing), Catch::Contains("F1 gap"));
}

TEST_CASE("rounded corners are given where their edges meet, with the radius that was milled") {
  const auto loops = milled(rectangle(10, 5, 40, 17), 2.5);
  REQUIRE(loops.size() == 1);
  const std::vector<Corner> corners = corners_of(loops[0]);
  REQUIRE(corners.size() == 4);
  for (const Corner& corner : corners) {
    CHECK(corner.radius_mm == Approx(2.5).margin(0.01));
    CHECK(std::min(std::abs(corner.at.x() - 10), std::abs(corner.at.x() - 40)) < 1e-6);
    CHECK(std::min(std::abs(corner.at.y() - 5), std::abs(corner.at.y() - 17)) < 1e-6);
  }
}

TEST_CASE("fillets of imported drawings, whose chords end on the arc, are recognised as well") {
  Loop loop{{0, 0}, {20, 0}, {20, 10}};
  for (int i = 0; i <= 16; ++i) {  // a fillet of 4 mm at (0, 10), from (4, 10) to (0, 6)
    const double angle = M_PI / 2 + M_PI / 2 * i / 16;
    loop.emplace_back(4 + 4 * std::cos(angle), 6 + 4 * std::sin(angle));
  }
  const std::vector<Corner> corners = corners_of(loop);
  REQUIRE(corners.size() == 4);
  CHECK((corners[3].at - Point(0, 10)).norm() < 1e-9);
  CHECK(corners[3].radius_mm == Approx(4));
}

TEST_CASE("a dish's arc is given by its ends on the free edge and its radius") {
  const std::vector<Corner> corners = corners_of(dish(0, 30, 8));
  REQUIRE(corners.size() == 2);
  CHECK(corners[0].radius_mm == Approx((225.0 + 64) / 16).margin(1e-6));
  CHECK(corners[0].at.y() == Approx(kWidth));
  CHECK(corners[1].at.y() == Approx(kWidth));
}

TEST_CASE("lengths are written with two or three decimals and never as minus zero") {
  CHECK(length_text(60) == "60.00");
  CHECK(length_text(9.0613) == "9.061");
  CHECK(length_text(2.5) == "2.50");
  CHECK(length_text(-0.0001) == "0.00");
  CHECK(length_text(-12.3456) == "-12.346");
}
