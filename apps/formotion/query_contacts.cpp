// query: clearance, contacts, facets.
#include <cmath>
#include <numbers>

#include "analysis/contact/clearance.hpp"
#include "analysis/contact/facets.hpp"
#include "query_answers.hpp"

namespace formotion {
namespace {

double degrees(double rad) { return rad * 180 / std::numbers::pi + 0.0; }

// A facet's middle: there its features are for sure.
Configuration middle_of(const QueriedWorld& world, const ContactFacet& facet) {
  const double theta = facet.orientations.from_rad + facet.orientations.width_rad / 2;
  double along = facet.extent_mm / 2;
  const auto ranges = along_ranges(world.part, world.obstacles, facet.pair, theta);
  if (!ranges.empty()) along = (ranges.front().from_mm + ranges.front().to_mm) / 2;
  return configuration_on(world.part, world.obstacles, facet.pair, theta, along);
}

// With the part at q, where the pair touches.
Point place_of(const QueriedWorld& world, const ContactPair& pair, const Configuration& q) {
  const double c = std::cos(q.theta_rad), s = std::sin(q.theta_rad);
  return q.position() + contact_state(world.part, world.obstacles, pair, q.position(), c, s).lever;
}

// The keys type, moving, fixed of a contact; place: on the obstacle, with the part at q.
OrderedJson pair_json(const QueriedWorld& world, const ContactPair& pair, const Configuration& q, const Point& place) {
  OrderedJson json{{"type", kind_word(pair.kind)}};
  json.update(features_json(world.names.of(world.part, world.obstacles, pair, q, place)));
  return json;
}

OrderedJson boundary_json(const ContactFacet& facet) {
  constexpr const char* kSides[] = {"along-start", "along-end", "theta-start", "theta-end"};
  OrderedJson list = OrderedJson::array();
  for (std::size_t side = 0; side < facet.boundary.size(); ++side) {
    const FacetBoundary& boundary = facet.boundary[side];
    if (!boundary.exists) continue;
    OrderedJson neighbours = OrderedJson::array();
    for (const FacetNeighbour& neighbour : boundary.neighbours) neighbours.push_back(neighbour.facet);
    list.push_back({{"side", kSides[side]},
                    {"curve", boundary.horizontal ? "line" : "helix"},
                    {"from", configuration_json(boundary.from)},
                    {"to", configuration_json(boundary.to)},
                    {"neighbours", neighbours}});
  }
  return list;
}

}  // namespace

OrderedJson point_json(const Point& p) { return {p.x() + 0.0, p.y() + 0.0}; }

OrderedJson configuration_json(const Configuration& q) {
  return {{"x_mm", q.x_mm + 0.0}, {"y_mm", q.y_mm + 0.0}, {"theta_deg", degrees(q.theta_rad)}};
}

OrderedJson clearance_answer(const QueriedWorld& world, const Configuration& q) {
  const double mm = clearance_mm(world.part, world.obstacles, q);
  return {{"free", mm >= 0}, {"clearance_mm", mm + 0.0}};
}

OrderedJson contacts_answer(const QueriedWorld& world, const Configuration& q, double tolerance_mm) {
  OrderedJson list = OrderedJson::array();
  for (const Contact& contact : contacts_at(world.part, world.obstacles, q, tolerance_mm)) {
    OrderedJson json = pair_json(world, contact.pair, q, contact.point);
    json["point_mm"] = point_json(contact.point);
    json["normal"] = point_json(contact.state.normal);
    list.push_back(std::move(json));
  }
  return {{"contacts", list}};
}

OrderedJson facets_answer(const QueriedWorld& world) {
  OrderedJson list = OrderedJson::array();
  for (const ContactFacet& facet : contact_facets(world.part, world.obstacles)) {
    const Configuration middle = middle_of(world, facet);
    OrderedJson json = pair_json(world, facet.pair, middle, place_of(world, facet.pair, middle));
    const double from = facet.orientations.from_rad, to = from + facet.orientations.width_rad;
    json["theta_deg"] = {degrees(from), degrees(to)};
    json["boundary"] = boundary_json(facet);
    list.push_back(std::move(json));
  }
  return {{"facets", list}};
}

}  // namespace formotion
