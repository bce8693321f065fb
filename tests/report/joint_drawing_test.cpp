// Drawings of joints: what is cut reads back, what is measured is what is drawn.
#include "report/joint_drawing.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "analysis/geometry/boolean.hpp"
#include "io/dxf_import.hpp"
#include "report/joint_outline.hpp"

using namespace formotion;

namespace {

constexpr double kPi = 3.14159265358979323846;

JointDrawing peg() {
  JointDrawing drawing;
  drawing.title = "peg & chamfer, design <7>";
  drawing.fixed_mm = {{{-25, -20}, {-5.1, -20}, {-5.1, -3.2}, {-7.1, 0}, {-25, 0}},
                      {{5.1, -20}, {25, -20}, {25, 0}, {7.1, 0}, {5.1, -3.2}}};
  drawing.part = {{{-5, 5}, {5, 5}, {5, 35}, {-5, 35}}, {{{-1, 20}, {-1, 22}, {1, 22}, {1, 20}}}};
  drawing.centre_mm = {0, 7};
  drawing.depth_mm = 22;
  return drawing;
}

std::vector<Loop> read_layer(const std::string& dxf, const char* layer) {
  DxfOptions options;
  options.layers = {layer};
  std::vector<Loop> loops;
  for (const DxfContour& contour : parse_dxf(dxf, "joint.dxf", options)) loops.push_back(contour.points_mm);
  return loops;
}

double area(const std::vector<Polygon>& polygons) {
  double sum = 0;
  for (const Polygon& polygon : polygons) sum += area_moments(polygon).area_mm2;
  return sum;
}

// The same points in the same turn, from any of them on.
bool same_loop(const Loop& a, const Loop& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t shift = 0; shift < a.size(); ++shift) {
    bool same = true;
    for (std::size_t i = 0; same && i < a.size(); ++i) same = (a[i] - b[(i + shift) % b.size()]).norm() < 1e-9;
    if (same) return true;
  }
  return false;
}

bool contains(const std::string& text, const std::string& piece) { return text.find(piece) != std::string::npos; }

}  // namespace

TEST_CASE("The DXF file of a joint reads back as its fixed shapes and its part") {
  const JointDrawing drawing = peg();
  const std::string dxf = joint_dxf(drawing);
  const std::vector<Loop> fixed = read_layer(dxf, "FIXED");
  REQUIRE(fixed.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) CHECK(same_loop(fixed[i], drawing.fixed_mm[i]));
  DxfOptions part_only;
  part_only.layers = {"PART"};
  const Polygon part = parse_dxf_part(dxf, "joint.dxf", part_only);
  CHECK(same_loop(part.outer, drawing.part.outer));
  REQUIRE(part.holes.size() == 1);
  CHECK(same_loop(part.holes[0], drawing.part.holes[0]));
  Loop deep = drawing.part.outer;
  for (Point& p : deep) p.y() -= 22;
  CHECK(same_loop(read_layer(dxf, "GOAL").at(0), deep));
}

TEST_CASE("Fixed shapes that touch or overlap are cut as one piece of their common area") {
  JointDrawing drawing = peg();
  drawing.fixed_mm.push_back({{-25, -24}, {-25, -19}, {25, -19}, {25, -24}});  // clockwise, overlaps both jaws
  const std::vector<Loop> fixed = read_layer(joint_dxf(drawing), "FIXED");
  REQUIRE(fixed.size() == 1);
  const double jaws = area({{drawing.fixed_mm[0], {}}, {drawing.fixed_mm[1], {}}});
  CHECK(std::abs(signed_area(fixed[0])) == Approx(jaws + 50 * 5 - 2 * 19.9));
}

TEST_CASE("Openings and slanted faces are measured along any approach") {
  const JointDrawing drawing = peg();
  for (const double turn : {0.0, kPi / 2, 1.1, kPi}) {
    const ApproachFrame frame(-kPi / 2 + turn);
    std::vector<Loop> loops;
    for (const Loop& loop : drawing.fixed_mm) loops.push_back(frame.seen(placed({loop, {}}, turn, {3, -2}).outer));
    double hole = 0, mouth = 0;
    for (const Width& width : widths(loops, Between::Opening)) (width.constant ? hole : mouth) = width.to - width.from;
    CHECK(hole == Approx(10.2));
    CHECK(mouth == Approx(14.2));
    const std::vector<SlantedFace> faces = slanted_faces(loops);
    REQUIRE(faces.size() == 2);
    for (const SlantedFace& face : faces) {
      CHECK(face.width_mm == Approx(2));
      CHECK(face.depth_mm == Approx(3.2));
      CHECK(face.angle_rad == Approx(std::atan2(2, 3.2)));
    }
  }
}

TEST_CASE("The sheet of a joint says its dimensions and escapes its title") {
  const std::string svg = joint_svg(peg());
  for (const char* text : {">10.20<", ">14.20<", ">30.00<", ">depth 22.00<", ">2.00 x 3.20, 32.0\u00b0<", ">P.4<",
                           ">compliance centre<", "design &lt;7&gt;", "Scale 2:1"}) {
    INFO(text);
    CHECK(contains(svg, text));
  }
  CHECK_FALSE(contains(svg, "nan"));
}

TEST_CASE("A turned joint gives the same sheet but for coordinates") {
  const JointDrawing drawing = peg();
  JointDrawing turned = drawing;
  for (Loop& loop : turned.fixed_mm) loop = placed({loop, {}}, kPi / 2, Point::Zero()).outer;
  turned.part = placed(drawing.part, kPi / 2, Point::Zero());
  turned.centre_mm = {-7, 0};
  turned.approach_rad = 0;
  const std::string svg = joint_svg(turned);
  for (const char* text : {">10.20<", ">14.20<", ">depth 22.00<", ">2.00 x 3.20, 32.0\u00b0<", "Scale 2:1"}) {
    INFO(text);
    CHECK(contains(svg, text));
  }
}

TEST_CASE("A nest is drawn with its own words and without the goal of an assembly") {
  JointDrawing drawing = peg();
  drawing.depth_mm = 0;
  drawing.words = nest_words();
  const std::string svg = joint_svg(drawing);
  for (const char* text : {">GRAVITY<", ">centre of mass<", ">C: centre of mass<", ">part in its seat<", ">nest 1<",
                           ">to gravity<", "Gravity", ">10.20<"}) {
    INFO(text);
    CHECK(contains(svg, text));
  }
  for (const char* text : {"APPROACH", "pproach", "ompliance", "as drawn", "goal", "depth 0"}) {
    INFO(text);
    CHECK_FALSE(contains(svg, text));
  }
  const std::string dxf = joint_dxf(drawing);
  CHECK(read_layer(dxf, "FIXED").size() == 2);
  CHECK(read_layer(dxf, "PART").size() == 2);
  CHECK(contains(dxf, "layer PART is the part in its seat"));
  CHECK(contains(dxf, "direction of gravity, from the centre of mass"));
  CHECK_FALSE(contains(dxf, "compliance"));
  CHECK_FALSE(contains(dxf, "layer GOAL"));
}
