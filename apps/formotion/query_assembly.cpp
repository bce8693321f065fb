// query: what assemblies answer.
#include <Eigen/LU>
#include <cmath>
#include <map>

#include "io/assembly_json.hpp"
#include "query_answers.hpp"

namespace formotion {
namespace {

using namespace assembly;

// The part is held by its compliance centre, but questions are asked of its centre of mass.
class AssemblyAnswers final : public Answers {
 public:
  explicit AssemblyAnswers(const ChosenDesign& chosen)
      : chosen_(chosen),
        problem_(*chosen.file.assembly),
        joint_(problem_.joint(chosen.topology, chosen.values)),
        defects_(problem_.defects(chosen.topology, chosen.values)) {}

  std::vector<std::string> aspects() const override {
    if (problem_.spec().part.flips) return {"up", "down"};
    return {"up"};
  }

  std::optional<InputIssue> refusal(const std::string& type) const override {
    const auto issue = [](const std::string& where, const std::string& found, const std::string& expected) {
      return InputIssue{"query", where, false, found, expected};
    };
    if (type == "support") return issue("/type", "'support' of an assembly, whose part is held by its support", "");
    if (type == "sweep")
      return issue("/type", "'sweep' of an assembly, whose fixed shapes are its design's alone", "a feeder's");
    if (!defects_.empty())
      return issue("", "a design that cannot be used: " + defects_[0].where + ": " + defects_[0].what, "valid shapes");
    return std::nullopt;
  }

  const QueriedWorld& world(const std::string& aspect) override { return made(aspect).queried; }

  // The carrier is where the part is, without forces yet, and goes on by 1 mm along the approach: K times that is the
  // load at the compliance centre, 1 / K the mobility. Both are moved to the centre of mass (derived): with
  // v_com = v - w r', r' the turned lever from the centre of mass, twists go over by A and wrenches by its inverse
  // transposed.
  MotionLaw law(const std::string& aspect, const Configuration& q) override {
    const Made& known = made(aspect);
    const InsertionTask& task = known.scene->task;
    const Eigen::Vector3d stiffness(task.stiffness.kx_n_per_mm, task.stiffness.ky_n_per_mm,
                                    task.stiffness.ktheta_nmm_per_rad);
    const Point& along = task.approach.direction;
    const Point lever = turned_left(rotated(known.centre, q.theta_rad));
    Eigen::Matrix3d to_com = Eigen::Matrix3d::Identity();
    to_com(0, 2) = -lever.x();
    to_com(1, 2) = -lever.y();
    MotionLaw law;
    law.load = to_com.inverse().transpose() * stiffness.cwiseProduct(Eigen::Vector3d(along.x(), along.y(), 0));
    law.mobility = to_com * stiffness.cwiseInverse().asDiagonal() * to_com.transpose();
    law.friction = task.friction;
    law.length_mm = known.queried.part.gyration_mm;
    return law;
  }

  OrderedJson project(const std::string& aspect, const Configuration& q, IssueList&) override {
    const Made& known = made(aspect);
    InsertionOptions options;
    options.keep_path = true;
    const Configuration start = moved(q, known.centre);
    const Insertion found = insert(known.scene->task, start, options);
    OrderedJson path = OrderedJson::array();
    const auto add = [&](const Configuration& at, double depth_mm, const OrderedJson& event) {
      path.push_back(configuration_json(moved(at, -known.centre)));
      path.back()["depth_mm"] = depth_mm + 0.0;
      path.back()["event"] = event;
    };
    for (const InsertionMoment& moment : found.path)
      add(moment.q, moment.depth_mm, moment.event.empty() ? OrderedJson(nullptr) : OrderedJson(moment.event));
    if (found.path.empty()) add(start, found.depth_mm, "overlaps");
    if (path.back()["event"].is_null()) path.back()["event"] = "ends here";
    OrderedJson answer{{"outcome", formotion::name(found.outcome)}, {"path", path}};
    answer["why"] = found.why;
    answer["depth_mm"] = found.depth_mm + 0.0;
    answer["peak_force_n"] = found.peak_axial_n + 0.0;
    answer["peak_lateral_force_n"] = found.peak_lateral_n + 0.0;
    answer["work_nmm"] = found.work_nmm + 0.0;
    return answer;
  }

 private:
  struct Made {
    QueriedWorld queried;
    std::unique_ptr<Scene> scene;  // relative to the compliance centre
    Point centre;                  // of compliance, from the centre of mass as the part has it
  };

  // The same place of the part, told of another point of it.
  static Configuration moved(const Configuration& q, const Point& by) {
    const Point at = q.position() + rotated(by, q.theta_rad);
    return {at.x(), at.y(), q.theta_rad};
  }

  const Made& made(const std::string& aspect) {
    const auto known = made_.find(aspect);
    if (known != made_.end()) return known->second;
    Made made{{{}, {}, names_of(joint_, aspect, joint_.com_mm)},
              problem_.scene(chosen_.topology, chosen_.values, aspect, 0),
              Joint::held(joint_.centre_mm, joint_.com_mm, aspect)};
    const MovingShape& part = made.scene->part;
    made.queried.part = MovingShape::of({placed(part.bodies.front(), 0, made.centre)}, part.gyration_mm);
    made.queried.obstacles = made.scene->obstacles;
    return made_.emplace(aspect, std::move(made)).first->second;
  }

  const ChosenDesign& chosen_;
  AssemblyProblem problem_;
  Joint joint_;
  std::vector<Violation> defects_;
  std::map<std::string, Made> made_;
};

}  // namespace

std::unique_ptr<Answers> assembly_answers(const ChosenDesign& chosen) {
  return std::make_unique<AssemblyAnswers>(chosen);
}

}  // namespace formotion
