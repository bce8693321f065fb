#include <iomanip>
#include <sstream>

#include "applications/nest/nest_problem.hpp"
#include "io/nest_json.hpp"
#include "report/joint_drawing.hpp"
#include "report/nest_data.hpp"
#include "report/shapes_kind.hpp"

namespace formotion {
namespace {

constexpr int kMostLandscapes = 6;  // designs in one page with their configuration space
constexpr double kThickness_mm = 10;

// "the wrong rests leave ..." in a line.
std::string outcome_note(nest::Purpose purpose, const nest::Metrics& metrics) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(2);
  if (purpose == nest::Purpose::Pallet) {
    text << "out of the seat: a rise of " << metrics.goal_escape_height_mm.value_or(0) << " mm at least; ";
    text << (metrics.worst_wrong_escape_height_mm ? "out of wrong rests: " : "");
    if (metrics.worst_wrong_escape_height_mm) text << *metrics.worst_wrong_escape_height_mm << " mm at most";
  } else {
    text << "of all placements " << 100 * metrics.seated_fraction.value_or(0) << " % end in the seat";
    if (metrics.repeatability_mm) text << ", within " << *metrics.repeatability_mm << " mm of each other";
  }
  return text.str();
}

class NestKind final : public ShapesKind<nest::NestProblem> {
 public:
  explicit NestKind(const ProblemFile& file) : ShapesKind(file, *file.nest) {}

 private:
  std::string drawn(const std::string& title, int topology, std::span<const double> values,
                    const nest::NestEvaluation& evaluation, const std::string& format) const override {
    const nest::NestSpec& spec = problem().spec();
    JointDrawing drawing;
    drawing.title = title;
    drawing.words = nest_words();
    drawing.fixed_mm = problem().nest_mm(topology, values);
    const Configuration seat = problem().seat(values);
    for (const AspectShape& shape : aspect_shapes(spec.part, values)) {
      if (shape.name != spec.goal.seat.aspect) continue;
      drawing.part = placed(shape.footprint, seat.theta_rad, seat.position());
      drawing.thickness_mm = shape.height_mm > 0 ? shape.height_mm : kThickness_mm;
    }
    drawing.centre_mm = seat.position();
    drawing.approach_rad = radians_of(spec, values);
    drawing.notes.push_back(outcome_note(spec.purpose, evaluation.metrics));
    if (!evaluation.feasible) drawing.notes.push_back("NOT FEASIBLE: " + evaluation.violations.front().what);
    return (format == "svg" ? joint_svg : format == "dxf" ? joint_dxf : joint_stl)(drawing);
  }

  static double radians_of(const nest::NestSpec& spec, std::span<const double> values) {
    return (spec.environment.gravity_deg.value(values) + spec.environment.tilt_deg.value(values)) *
           1.7453292519943295e-2;
  }

  void add_asked(Json& asked, std::span<const double> values) const override {
    asked["nest"] = asked_json(problem(), values);
  }
  void add_picture(Json& design, const Judged& judged, int order) const override {
    design["nest"] = nest_json(problem(), judged.design.candidate.topology, judged.values, judged.evaluation,
                               order < kMostLandscapes);
  }
};

}  // namespace

std::unique_ptr<Kind> nest_kind(ProblemFile file) { return std::make_unique<NestKind>(file); }

}  // namespace formotion
