#include "io/dxf_import.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

using namespace formotion;
using nlohmann::json;

namespace {

const std::string kCorpus = FORMOTION_SOURCE_DIR "/tests/corpus/dxf/";

json expected() {
  std::ifstream stream(kCorpus + "expected.json");
  REQUIRE(stream);
  return json::parse(stream);
}

// What the reader says of a text that it must refuse.
std::string refusal(const std::function<void()>& read) {
  try {
    read();
  } catch (const InputError& error) {
    REQUIRE_FALSE(error.issues.empty());
    return error.what();
  }
  return "";
}

std::string entities(const std::string& body) { return "0\nSECTION\n2\nENTITIES\n" + body + "0\nENDSEC\n0\nEOF\n"; }

std::string line(const Point& a, const Point& b) {
  std::ostringstream out;
  out.precision(17);
  out << "0\nLINE\n8\nA\n10\n" << a.x() << "\n20\n" << a.y() << "\n11\n" << b.x() << "\n21\n" << b.y() << "\n";
  return out.str();
}

}  // namespace

TEST_CASE("drawings made by ezdxf: contours, areas and extents are those that ezdxf computes") {
  const json records = expected()["good"];
  REQUIRE(records.size() >= 35);
  for (const json& record : records) {
    DYNAMIC_SECTION(record["name"].get<std::string>()) {
      DxfOptions options;
      if (record.contains("layers")) options.layers = record["layers"].get<std::vector<std::string>>();
      const std::string path = kCorpus + "good/" + record["name"].get<std::string>() + ".dxf";
      const auto contours = read_dxf(path, options);
      const json& wanted = record["contours"];
      REQUIRE(contours.size() == wanted.size());
      const double slack = record.value("slack_mm", 0.0) + 1e-4;  // of ezdxf's flattening, and of joints
      for (std::size_t i = 0; i < contours.size(); ++i) {
        const Loop& loop = contours[i].points_mm;
        CHECK(contours[i].layer == wanted[i]["layer"]);
        const double off_by = (options.chord_tolerance_mm + slack) * wanted[i]["perimeter_mm"].get<double>();
        CHECK(signed_area(loop) == Approx(wanted[i]["area_mm2"].get<double>()).margin(off_by));
        const Box box = bounding_box(loop);
        const auto wanted_box = wanted[i]["box_mm"].get<std::vector<double>>();
        CHECK(box.min.x() == Approx(wanted_box[0]).margin(options.chord_tolerance_mm + slack));
        CHECK(box.min.y() == Approx(wanted_box[1]).margin(options.chord_tolerance_mm + slack));
        CHECK(box.max.x() == Approx(wanted_box[2]).margin(options.chord_tolerance_mm + slack));
        CHECK(box.max.y() == Approx(wanted_box[3]).margin(options.chord_tolerance_mm + slack));
        CHECK_FALSE(defect({loop, {}}).has_value());
      }
      if (record.contains("part")) {
        const Polygon part = read_dxf_part(path);
        CHECK(part.holes.size() == record["part"]["holes"].get<std::size_t>());
        CHECK(area_moments(part).area_mm2 == Approx(record["part"]["area_mm2"].get<double>()).margin(0.3));
        CHECK_FALSE(defect(part).has_value());
      }
    }
  }
}

TEST_CASE("drawings that are refused say what is wrong and where, one line for each problem") {
  const json records = expected()["bad"];
  REQUIRE(records.size() >= 25);
  for (const json& record : records) {
    DYNAMIC_SECTION(record["name"].get<std::string>()) {
      const std::string path = kCorpus + "bad/" + record["name"].get<std::string>() + ".dxf";
      const std::string said = refusal([&] {
        if (record.value("part", false)) {
          read_dxf_part(path);
        } else {
          read_dxf(path);
        }
      });
      CHECK_THAT(said, Catch::Contains(record["message"].get<std::string>()));
      for (const json& more : record.value("also", json::array())) {
        CHECK_THAT(said, Catch::Contains(more.get<std::string>()));
      }
    }
  }
}

TEST_CASE("chords have their ends on the arc and leave it inwards by at most the tolerance") {
  for (const double radius : {0.01, 0.5, 7.0, 300.0, 20000.0}) {
    for (const double tolerance : {0.0005, 0.002, 0.1}) {
      CAPTURE(radius, tolerance);
      DxfOptions options;
      options.chord_tolerance_mm = tolerance;
      options.join_tolerance_mm = 1e-6;
      const std::string text = entities("0\nCIRCLE\n8\nA\n10\n3\n20\n4\n40\n" + std::to_string(radius) + "\n");
      const Loop loop = parse_dxf(text, "t.dxf", options).at(0).points_mm;
      const Point centre(3, 4);
      double deepest = 0;
      for (std::size_t i = 0; i < loop.size(); ++i) {
        REQUIRE((loop[i] - centre).norm() == Approx(radius).epsilon(1e-12));
        const Point middle = (loop[i] + loop[(i + 1) % loop.size()]) / 2;
        deepest = std::max(deepest, radius - (middle - centre).norm());
      }
      CHECK(deepest <= tolerance * (1 + 1e-6));
      CHECK((deepest > tolerance / 4 || loop.size() == 12));  // no more chords than it takes
    }
  }
}

TEST_CASE("a bulge is the tangent of a quarter of the arc's turn, to the right of its chord where positive") {
  for (const double bulge : {-3.0, -1.0, -0.2, 0.05, 0.7, 1.0, 4.0}) {
    CAPTURE(bulge);
    DxfOptions options;
    options.chord_tolerance_mm = 1e-6;
    std::ostringstream body;
    body << "0\nLWPOLYLINE\n8\nA\n70\n1\n10\n0\n20\n0\n42\n"
         << bulge << "\n10\n10\n20\n0\n10\n5\n20\n"
         << (bulge > 0 ? 20 : -20) << "\n";
    const Loop loop = parse_dxf(entities(body.str()), "t.dxf", options).at(0).points_mm;
    // Triangle plus circular segment.
    const double turn = 4 * std::atan(std::abs(bulge)), radius = 5 / std::sin(turn / 2);
    CHECK(signed_area(loop) == Approx(100 + radius * radius / 2 * (turn - std::sin(turn))).epsilon(1e-5));
    const Box box = bounding_box(loop);
    CHECK((bulge > 0 ? box.min.y() : box.max.y()) == Approx(-5 * bulge).epsilon(1e-5));
  }
}

TEST_CASE("the order and direction of a contour's lines do not matter") {
  std::mt19937 random(20260301);
  for (int n = 3; n < 40; ++n) {
    Loop star;
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * M_PI * i / n, radius = 10 + 4 * std::sin(7.0 * i);
      star.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    std::vector<std::string> lines;
    for (int i = 0; i < n; ++i) {
      const Point a = star[i], b = star[(i + 1) % n];
      lines.push_back(random() % 2 == 0 ? line(a, b) : line(b, a));
    }
    std::shuffle(lines.begin(), lines.end(), random);
    std::string body;
    for (const std::string& one : lines) body += one;
    const auto contours = parse_dxf(entities(body), "t.dxf");
    REQUIRE(contours.size() == 1);
    CHECK(signed_area(contours[0].points_mm) == Approx(signed_area(star)));
    CHECK(contours[0].points_mm.size() == static_cast<std::size_t>(n));
  }
}

TEST_CASE("a hundred thousand lines join in seconds, and so do as many that meet nowhere") {
  std::string squares, loose;
  for (int i = 0; i < 25000; ++i) {
    const Point at(3.0 * (i % 250), 3.0 * (i / 250));
    const Loop corners{at, at + Point(2, 0), at + Point(2, 2), at + Point(0, 2)};
    for (int k = 0; k < 4; ++k) {
      squares += line(corners[k], corners[(k + 1) % 4]);
      loose += line(corners[k], at + Point(1, 0.5 + 0.1 * k));
    }
  }
  const auto begin = std::chrono::steady_clock::now();
  CHECK(parse_dxf(entities(squares), "t.dxf").size() == 25000);
  const std::string said = refusal([&] { parse_dxf(entities(loose), "t.dxf"); });
  CHECK_THAT(said, Catch::Contains("an open contour") && Catch::Contains("99950 more problems"));
  const std::string same = refusal([&] {
    std::string body;
    for (int i = 0; i < 50000; ++i) body += line({0, 0}, {1e5 * std::cos(i), 1e5 * std::sin(i)});
    parse_dxf(entities(body), "t.dxf");
  });
  CHECK_THAT(same, Catch::Contains("50000 lines that meet at (0, 0) mm"));
  CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(30));
}

TEST_CASE("crossings are found among many contours and none is invented") {
  // Comb of thin bars that lie in each other's boxes, slanted.
  std::string bars;
  for (int i = 0; i < 2000; ++i) {
    const Point a(0, i), u(1000, 1000), v(0, 0.5);
    bars += line(a, a + u) + line(a + u, a + u + v) + line(a + u + v, a + v) + line(a + v, a);
  }
  CHECK(parse_dxf(entities(bars), "t.dxf").size() == 2000);
  const Loop across{{500, 100}, {501, 100}, {501, 3000}, {500, 3000}};
  for (int k = 0; k < 4; ++k) bars += line(across[k], across[(k + 1) % 4]);
  CHECK_THAT(refusal([&] { parse_dxf(entities(bars), "t.dxf"); }), Catch::Contains("cross or touch"));
}

TEST_CASE("layers are chosen without regard to case, and named as the caller spells them") {
  const std::string body =
      "0\nCIRCLE\n8\nvoid\n10\n0\n20\n0\n40\n1\n0\nCIRCLE\n8\nOther\n10\n9\n20\n0\n40\n1\n"
      "0\nCIRCLE\n8\nwAll\n10\n20\n20\n0\n40\n1\n";
  DxfOptions options;
  options.layers = {"VOID", "WALL"};
  const auto contours = parse_dxf(entities(body), "t.dxf", options);
  REQUIRE(contours.size() == 2);
  CHECK(contours[0].layer == "VOID");
  CHECK(contours[1].layer == "WALL");
  CHECK(parse_dxf(entities(body), "t.dxf").size() == 3);
}

TEST_CASE("what is not seen does not count: invisible entities and paper space") {
  const std::string seen = line({0, 0}, {4, 0}) + line({4, 0}, {0, 3}) + line({0, 3}, {0, 0});
  for (const char* hidden : {"60\n1\n", "67\n1\n"}) {
    const auto contours = parse_dxf(entities(seen + line({1, 1}, {9, 9}) + hidden), "t.dxf");
    REQUIRE(contours.size() == 1);
    CHECK(signed_area(contours[0].points_mm) == Approx(6));
  }
  CHECK_THAT(refusal([&] {
               parse_dxf(entities(seen + line({1, 1}, {9, 9}) + "60\n0\n"), "t.dxf");
             }),
             Catch::Contains("an open contour"));
}

TEST_CASE("curve-fitted polylines are read along the curve, without the frame's control points") {
  std::string body = "0\nPOLYLINE\n8\nA\n66\n1\n70\n5\n";
  const auto vertex = [](double x, double y, int flags) {
    std::ostringstream out;
    out << "0\nVERTEX\n8\nA\n10\n" << x << "\n20\n" << y << "\n70\n" << flags << "\n";
    return out.str();
  };
  for (const auto& [x, y] : {std::pair{-50, -50}, {90, -50}}) body += vertex(x, y, 16);
  for (const auto& [x, y] : {std::pair{0, 0}, {10, 0}, {10, 5}, {0, 5}}) body += vertex(x, y, 8);
  const auto contours = parse_dxf(entities(body + "0\nSEQEND\n8\nA\n"), "t.dxf");
  REQUIRE(contours.size() == 1);
  CHECK(signed_area(contours[0].points_mm) == Approx(50));
}

TEST_CASE("Windows line ends, blanks around values and comments do not matter") {
  std::string text =
      "999\r\na comment\r\n  0\r\nSECTION\r\n  2\r\nENTITIES\r\n  0\r\nCIRCLE \r\n  8\r\n A\r\n 10\r\n  +1.0\r\n 20\r\n"
      "2.\r\n 40\r\n   .5E+1\r\n  0\r\nENDSEC\r\n  0\r\nEOF\r\n";
  const auto contours = parse_dxf(text, "t.dxf");
  REQUIRE(contours.size() == 1);
  CHECK(bounding_box(contours[0].points_mm).min.x() == Approx(-4));
}

TEST_CASE("files that are none are refused by name") {
  CHECK_THAT(refusal([] { read_dxf(kCorpus + "nowhere.dxf"); }), Catch::Contains("nowhere.dxf: no such file"));
  CHECK_THAT(refusal([] { read_dxf(kCorpus); }), Catch::Contains("not a regular file"));
}
