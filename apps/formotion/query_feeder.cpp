// query: what feeders answer.
#include <algorithm>
#include <map>

#include "applications/feeder/part_model.hpp"
#include "applications/feeder/world.hpp"
#include "query_answers.hpp"

namespace formotion {
namespace {

// A feature's obstacles as they are written.
struct Written {
  std::span<const double> values;
  const std::vector<ObstacleShape>& made;

  std::vector<Loop> operator()(const feeder::Fence& f) const { return {evaluated(f.polygon_mm, values)}; }
  std::vector<Loop> operator()(const feeder::Drawing& f) const { return f.walls_mm; }
  std::vector<Loop> operator()(const feeder::Pin& f) const { return {{{f.x_mm(values), f.y_mm(values)}}}; }
  // Behind the last corner come those of the body below.
  std::vector<Loop> operator()(const feeder::WallProfile& f) const {
    Loop loop = evaluated(f.profile_mm, values);
    const double below = bounding_box(made.front().area.outer).min.y();
    loop.emplace_back(loop.back().x(), below);
    loop.emplace_back(loop.front().x(), below);
    return {loop};
  }
  template <class Other>
  std::vector<Loop> operator()(const Other&) const {
    return {};
  }
};

WrittenNames names_in(const feeder::FeederProblem& problem, int topology, std::span<const double> values,
                      const std::string& aspect, const feeder::World& world) {
  const feeder::FeederSpec& spec = problem.spec();
  std::vector<Loop> part;
  std::vector<std::vector<Loop>> fixed;
  const std::vector<AspectShape> shapes = problem.shapes(values);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (shapes[i].name == aspect) part = written_loops(spec.part.aspects[i], shapes[i], values);
  }
  // The wall's face and the cuts in it, from left to right.
  const Loop& wall = world.shapes.front().area.outer;
  fixed.push_back({{wall.rbegin(), wall.rend()}});
  const feeder::DesignSpec& design = spec.designs[static_cast<std::size_t>(topology)];
  const std::vector<feeder::PlacedFeature> placed = problem.place(topology, values);
  for (std::size_t i = 0; i < design.size(); ++i) {
    if (placed[i].obstacles.empty()) continue;  // none, or impossible values
    for (Loop& loop : std::visit(Written{values, placed[i].obstacles}, design[i].shape)) {
      for (Point& p : loop) p.x() += placed[i].start_mm;
      fixed.push_back({std::move(loop)});
    }
  }
  return {std::move(part), std::move(fixed)};
}

// The contract's outcomes, from the motion alone: support is another question.
const char* outcome(const Projection& projection) {
  switch (projection.end) {
    case ProjectionEnd::Steady:
      return projection.last_twist.linear.x() > 0 ? "delivered" : "rejected";
    case ProjectionEnd::AtRest:
      return "jammed";
    case ProjectionEnd::Ambiguous:
      return "ambiguous";
    case ProjectionEnd::Stopped:  // nobody watches
    case ProjectionEnd::Undecided:
      return "undecided";
  }
  return "undecided";
}

class FeederAnswers final : public Answers {
 public:
  explicit FeederAnswers(const ChosenDesign& chosen)
      : chosen_(chosen), problem_(chosen.file.feeder), shapes_(problem_.shapes(chosen.values)) {}

  std::vector<std::string> aspects() const override {
    std::vector<std::string> names;
    for (const AspectShape& shape : shapes_) names.push_back(shape.name);
    return names;
  }
  const QueriedWorld& world(const std::string& aspect) override { return made(aspect).queried; }

  MotionLaw law(const std::string& aspect, const Configuration&) override {
    const Made& known = made(aspect);
    return damped(known.drive.force, known.queried.part.gyration_mm, known.drive.friction);
  }

  OrderedJson support(const std::string& aspect, const Configuration& q) override {
    const feeder::SupportAnswer found = problem_.support(chosen_.topology, chosen_.values, aspect, q);
    OrderedJson json{{"supported", found.supported}};
    json["margin_mm"] = found.margin_mm ? OrderedJson(*found.margin_mm + 0.0) : OrderedJson(nullptr);
    return json;
  }

  OrderedJson project(const std::string& aspect, const Configuration& q, IssueList& issues) override {
    const Made& known = made(aspect);
    if (overlaps(known.queried, q, kTouches_mm, issues)) return {};
    const Projection projection = formotion::project(known.queried.part, known.queried.obstacles, known.drive, q);
    return way_answer(projection, outcome(projection));
  }

  OrderedJson sweep(const std::string& aspect, const SweepQuestion& question) override {
    const auto shape =
        std::find_if(shapes_.begin(), shapes_.end(), [&](const AspectShape& known) { return known.name == aspect; });
    return sweep_answer(shape->bodies, question);
  }

 private:
  struct Made {
    QueriedWorld queried;
    Drive drive;
  };

  // Made when they are asked for.
  const Made& made(const std::string& aspect) {
    const auto known = made_.find(aspect);
    if (known != made_.end()) return known->second;
    feeder::World world = problem_.world(chosen_.topology, chosen_.values, aspect);
    WrittenNames names = names_in(problem_, chosen_.topology, chosen_.values, aspect, world);
    Made made{{std::move(world.part), std::move(world.obstacles), std::move(names)}, world.drive};
    return made_.emplace(aspect, std::move(made)).first->second;
  }

  const ChosenDesign& chosen_;
  feeder::FeederProblem problem_;
  std::vector<AspectShape> shapes_;
  std::map<std::string, Made> made_;
};

}  // namespace

std::unique_ptr<Answers> feeder_answers(const ChosenDesign& chosen) { return std::make_unique<FeederAnswers>(chosen); }

}  // namespace formotion
