#include <algorithm>

#include "analysis/geometry/boolean.hpp"
#include "io/dxf_import.hpp"
#include "report/design_files.hpp"
#include "verify/checks.hpp"

namespace formotion {
namespace {

using namespace feeder;

constexpr double kBeyond_mm = 10;          // the air beyond the track's rims
constexpr double kMarginsAgree_mm = 1e-3;  // the chords of circles

bool has_profile(const Layout& layout) {
  return std::any_of(layout.features.begin(), layout.features.end(),
                     [](const LaidFeature& f) { return !f.wall_face_mm.empty(); });
}

// The track that somebody cuts who has the drawing alone. Drawn voids end at the strip's rims; beyond these is air, so
// what is cut goes on there, and leaves no lip of no width.
Layout cut_from(const std::string& dxf, const TestedDesign& design) {
  DxfOptions options;
  options.layers = {"VOID", "WALL"};
  std::vector<Loop> voids;
  Drawing drawing;
  Box box;
  for (DxfContour& contour : parse_dxf(dxf, "the drawing", options)) {
    if (contour.layer == "WALL") {
      drawing.walls_mm.push_back(std::move(contour.points_mm));
      continue;
    }
    for (const Point& p : contour.points_mm) box.include(p);
    voids.push_back(std::move(contour.points_mm));
  }
  std::vector<Loop> gone;
  if (!voids.empty()) {
    const double width = design.environment().track_width_mm, from = box.min.x() - 1, to = box.max.x() + 1;
    const std::vector<Loop> metal = loops_of(difference({rectangle(from, 0, to, width)}, voids));
    gone = loops_of(difference({rectangle(from, -kBeyond_mm, to, width + kBeyond_mm)}, metal));
  }
  std::vector<LaidFeature> blades;  // drawn as lines, with their heights as texts
  for (LaidFeature feature : design.plain.features) {
    feature.voids.clear();
    feature.own_voids.clear();
    feature.obstacles.clear();
    if (feature.blade_mm) blades.push_back(std::move(feature));
  }
  FeatureSpec walls;
  walls.shape = drawing;
  walls.at_mm = Affine{0, {}};
  Layout cut = lay_out({walls}, design.environment(), {}, design.part.diameter_mm, {});
  if (!gone.empty()) set_voids(cut.features.front(), std::move(gone));
  cut.features.insert(cut.features.end(), blades.begin(), blades.end());
  return cut;
}

}  // namespace

Check check_drawn(const TestedDesign& design) {
  Check check{"drawn"};
  check.unit = design.belt ? "starts" : "poses";
  if (has_profile(design.layout)) {
    check.note = "a wall profile's face is drawn as an open line, which is not read back";
    return check;
  }
  const JudgedDesign judged{design.stored, design.values, design.evaluation};
  try {
    const Layout cut = cut_from(design_dxf("", design.problem, judged), design);
    check.count = static_cast<std::int64_t>(design.arrivals.size());
    const Comparison found = compare_ends(design, cut);
    if (found.difference) check.fail("cut from its drawing, " + *found.difference);
    const Comparison scored = compare_ends(design, design.layout);
    const double apart = std::max(std::abs(found.least_margin_mm - scored.least_margin_mm),
                                  std::abs(found.least_depth_mm - scored.least_depth_mm));
    check.worst = apart;
    check.worst_of = "mm between the margins as scored and as drawn";
    if (apart > kMarginsAgree_mm) check.fail("margins as drawn differ from the ones scored");
  } catch (const InputError& error) { check.fail("the drawing cannot be read back: " + std::string(error.what())); }
  return check;
}

}  // namespace formotion
