#include <iomanip>
#include <sstream>

#include "applications/assembly/assembly_problem.hpp"
#include "io/assembly_json.hpp"
#include "report/joint_data.hpp"
#include "report/joint_drawing.hpp"
#include "report/shapes_kind.hpp"

namespace formotion {
namespace {

constexpr int kMostSpaces = 6;  // designs in one page with their configuration space

class AssemblyKind final : public ShapesKind<assembly::AssemblyProblem> {
 public:
  explicit AssemblyKind(const ProblemFile& file) : ShapesKind(file, *file.assembly) {}

 private:
  std::string drawn(const std::string& title, int topology, std::span<const double> values,
                    const assembly::AssemblyEvaluation& evaluation, const std::string& format) const override {
    const assembly::AssemblySpec& spec = problem().spec();
    const assembly::Joint joint = problem().joint(topology, values);
    JointDrawing drawing{
        title, joint.fixed_mm, joint.part, joint.centre_mm, spec.approach.direction_rad, spec.goal.depth_mm, {}};
    std::ostringstream share;
    share << "of all starts " << std::fixed << std::setprecision(1) << 100 * evaluation.metrics.success_fraction
          << " % assemble, with " << evaluation.metrics.peak_force_n << " N at most";
    drawing.notes.push_back(share.str());
    if (!evaluation.feasible) drawing.notes.push_back("NOT FEASIBLE: " + evaluation.violations.front().what);
    if (spec.part.thickness_mm) drawing.thickness_mm = *spec.part.thickness_mm;
    return (format == "svg" ? joint_svg : format == "dxf" ? joint_dxf : joint_stl)(drawing);
  }

  void add_asked(Json& asked, std::span<const double> values) const override {
    asked["assembly"] = asked_json(problem().spec(), values);
  }
  void add_picture(Json& design, const Judged& judged, int order) const override {
    design["joint"] =
        joint_json(problem(), judged.design.candidate.topology, judged.values, judged.evaluation, order < kMostSpaces);
  }
};

}  // namespace

std::unique_ptr<Kind> assembly_kind(ProblemFile file) { return std::make_unique<AssemblyKind>(file); }

}  // namespace formotion
