// query: what fixtures and pallets answer.
#include <map>

#include "analysis/contact/clearance.hpp"
#include "analysis/energy/escape.hpp"
#include "applications/nest/drops.hpp"
#include "io/json_values.hpp"
#include "query_answers.hpp"

namespace formotion {
namespace {

using namespace nest;

constexpr int kMostMoves = 50;  // a wedge takes some, each shorter than the one before

// Numbers are rounded, so that a part at rest may overlap a little: moved out of that, by the least translations.
Configuration moved_out(const Scene& scene, Configuration q) {
  for (int i = 0; i < kMostMoves; ++i) {
    const Clearance near = clearance(scene.part, scene.obstacles, q);
    if (near.mm >= 0) break;
    const Point by = near.on_obstacles - near.on_part;
    q.x_mm += by.x();
    q.y_mm += by.y();
  }
  return q;
}

class NestAnswers final : public Answers {
 public:
  explicit NestAnswers(const ChosenDesign& chosen)
      : chosen_(chosen),
        problem_(*chosen.file.nest),
        defects_(problem_.defects(chosen.topology, chosen.values)),
        shapes_(aspect_shapes(problem_.spec().part, chosen.values)) {}

  std::vector<std::string> aspects() const override {
    std::vector<std::string> names;
    for (const AspectShape& shape : shapes_) names.push_back(shape.name);
    return names;
  }

  std::optional<InputIssue> refusal(const std::string& type) const override {
    const auto issue = [](const std::string& where, const std::string& found, const std::string& expected) {
      return InputIssue{"query", where, false, found, expected};
    };
    if (type == "support") return issue("/type", "'support' in a nest, which has no track", "");
    if (type == "sweep") return issue("/type", "'sweep' of a nest, whose shapes are its design's alone", "a feeder's");
    if (!defects_.empty())
      return issue("", "a design that cannot be used: " + defects_[0].where + ": " + defects_[0].what, "valid shapes");
    return std::nullopt;
  }

  const QueriedWorld& world(const std::string& aspect) override { return made(aspect).queried; }

  MotionLaw law(const std::string& aspect, const Configuration&) override {
    const Scene& scene = *made(aspect).scene;
    return damped(scene.gravity.down, scene.part.gyration_mm, scene.friction);
  }

  // Let go, without bouncing. Only the seat's aspect can be seated.
  OrderedJson project(const std::string& aspect, const Configuration& q, IssueList& issues) override {
    const Made& known = made(aspect);
    if (overlaps(known.queried, q, kTouches_mm, issues)) return {};
    const Scene& scene = *known.scene;
    const SeatSpec& seat = problem_.spec().goal.seat;
    const double within = aspect == seat.aspect ? seat.within_mm : 0;
    const Configuration from = moved_out(scene, q);
    if (overlaps(known.queried, from, 0, issues)) return {};
    const DropEnd end = dropped(scene, problem_.seat(chosen_.values), within, from);
    OrderedJson answer =
        way_answer(formotion::project(*scene.space, {scene.gravity.down, scene.friction}, from), name(end.outcome));
    const EscapeBracket way_out = escape(*scene.space, scene.gravity, from, scene.outside);
    answer["escape_height_mm"] = {number_json(way_out.lower_mm), number_json(way_out.upper_mm)};
    return answer;
  }

 private:
  struct Made {
    QueriedWorld queried;
    std::unique_ptr<Scene> scene;
  };

  const Made& made(const std::string& aspect) {
    const auto known = made_.find(aspect);
    if (known != made_.end()) return known->second;
    std::unique_ptr<Scene> scene = problem_.scene(chosen_.topology, chosen_.values, aspect);
    std::vector<std::vector<Loop>> fixed;
    for (const Loop& loop : problem_.nest_mm(chosen_.topology, chosen_.values)) fixed.push_back({loop});
    Made made{{scene->part, scene->obstacles, WrittenNames(part_loops(aspect), std::move(fixed))}, std::move(scene)};
    return made_.emplace(aspect, std::move(made)).first->second;
  }

  // As written, about the centre of mass.
  std::vector<Loop> part_loops(const std::string& aspect) const {
    const std::vector<AspectSpec>& specs = problem_.spec().part.aspects;
    for (std::size_t i = 0; i < specs.size(); ++i) {
      if (specs[i].name == aspect) return written_loops(specs[i], shapes_[i], chosen_.values);
    }
    return {};
  }

  const ChosenDesign& chosen_;
  NestProblem problem_;
  std::vector<Violation> defects_;
  std::vector<AspectShape> shapes_;
  std::map<std::string, Made> made_;
};

}  // namespace

std::unique_ptr<Answers> nest_answers(const ChosenDesign& chosen) { return std::make_unique<NestAnswers>(chosen); }

}  // namespace formotion
