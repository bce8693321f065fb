// Answers of `query`, one function a type of question.
#pragma once

#include "applications/feeder/world.hpp"
#include "io/feeder_json.hpp"
#include "io/json_reader.hpp"
#include "query_names.hpp"

namespace formotion {

// An aspect among the design's obstacles, and what its features are called.
struct QueriedWorld {
  feeder::World world;
  WrittenNames names;
};

inline constexpr double kTouches_mm = 1e-6;  // contacts unless the question says otherwise

OrderedJson clearance_answer(const QueriedWorld& queried, const Configuration& q);
OrderedJson contacts_answer(const QueriedWorld& queried, const Configuration& q, double tolerance_mm);
OrderedJson facets_answer(const QueriedWorld& queried);
// These two want a part that overlaps nothing; issues say so.
OrderedJson motion_answer(const QueriedWorld& queried, const Configuration& q, double tolerance_mm, IssueList& issues);
OrderedJson project_answer(const QueriedWorld& queried, const Configuration& q, IssueList& issues);

// A motion of the part, and the region from which it is cut.
struct SweepQuestion {
  std::vector<Configuration> path;
  Loop region;
  double precision_mm = 0;
};
SweepQuestion read_sweep(ObjectReader& object, IssueList& issues);
OrderedJson sweep_answer(const feeder::AspectShape& shape, const SweepQuestion& question);

Configuration read_configuration(const OrderedJson& value, const std::string& pointer, IssueList& issues);

// The keys type, moving, fixed of a contact; place: on the obstacle, with the part at q.
OrderedJson pair_json(const QueriedWorld& queried, const ContactPair& pair, const Configuration& q, const Point& place);
OrderedJson point_json(const Point& p);
OrderedJson configuration_json(const Configuration& q);  // x_mm, y_mm, theta_deg

}  // namespace formotion
