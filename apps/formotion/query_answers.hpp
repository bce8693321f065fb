// Answers of `query`: what a kind of problem says of a design, and what is the same for all kinds.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/motion/contact_law.hpp"
#include "analysis/motion/projection.hpp"
#include "chosen_design.hpp"
#include "io/feeder_json.hpp"
#include "io/json_reader.hpp"
#include "io/written_names.hpp"

namespace formotion {

// An aspect of the part, relative to its centre of mass, among the design's obstacles, and what its features are
// called.
struct QueriedWorld {
  MovingShape part;
  Obstacles obstacles;
  WrittenNames names;
};

// A motion of the part, and the region from which it is cut.
struct SweepQuestion {
  std::vector<Configuration> path;
  Loop region;
  double precision_mm = 0;
};

// One design of one kind of problem. Configurations are those of the contract: of the centre of mass.
class Answers {
 public:
  virtual ~Answers() = default;
  virtual std::vector<std::string> aspects() const = 0;
  // Why questions of this type have no answer; none if they have one.
  virtual std::optional<InputIssue> refusal(const std::string& /*type*/) const { return std::nullopt; }
  // What clearance, contacts and facets are asked of.
  virtual const QueriedWorld& world(const std::string& aspect) = 0;
  // What moves a part at q, at the centre of mass.
  virtual MotionLaw law(const std::string& aspect, const Configuration& q) = 0;
  virtual OrderedJson project(const std::string& aspect, const Configuration& q, IssueList& issues) = 0;
  // These are asked only where refusal() has nothing against it.
  virtual OrderedJson support(const std::string& /*aspect*/, const Configuration& /*q*/) { return {}; }
  virtual OrderedJson sweep(const std::string& /*aspect*/, const SweepQuestion& /*question*/) { return {}; }
};

// chosen must outlive them.
std::unique_ptr<Answers> feeder_answers(const ChosenDesign& chosen);
std::unique_ptr<Answers> assembly_answers(const ChosenDesign& chosen);
std::unique_ptr<Answers> nest_answers(const ChosenDesign& chosen);

inline constexpr double kTouches_mm = 1e-6;  // contacts unless the question says otherwise

OrderedJson clearance_answer(const QueriedWorld& world, const Configuration& q);
OrderedJson contacts_answer(const QueriedWorld& world, const Configuration& q, double tolerance_mm);
OrderedJson facets_answer(const QueriedWorld& world);
// Wants a part that overlaps nothing; issues say so.
OrderedJson motion_answer(const QueriedWorld& world, const MotionLaw& law, const Configuration& q, double tolerance_mm,
                          IssueList& issues);
// outcome, path and why.
OrderedJson way_answer(const Projection& projection, const std::string& outcome);
// Whether the part overlaps what is fixed by more than the tolerance; then issues say so.
bool overlaps(const QueriedWorld& world, const Configuration& q, double tolerance_mm, IssueList& issues);

SweepQuestion read_sweep(ObjectReader& object, IssueList& issues);
OrderedJson sweep_answer(const std::vector<Polygon>& bodies, const SweepQuestion& question);

Configuration read_configuration(const OrderedJson& value, const std::string& pointer, IssueList& issues);

OrderedJson point_json(const Point& p);
OrderedJson configuration_json(const Configuration& q);  // x_mm, y_mm, theta_deg

}  // namespace formotion
