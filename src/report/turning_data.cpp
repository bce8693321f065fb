#include "report/turning_data.hpp"

#include <cmath>
#include <numbers>

namespace formotion {
namespace {

using Json = OrderedJson;
using namespace feeder;

Json to_unit(double value, double per) {
  return std::isfinite(value) ? Json(std::round(value * per) / per + 0.0) : Json(nullptr);
}
Json mm(double value) { return to_unit(value, 1e3); }
Json coarse(double value) { return to_unit(value, 1e2); }
Json degrees(double rad) { return to_unit(rad * 180 / std::numbers::pi, 1e3); }
Json share(double value) { return to_unit(value, 1e6); }

Json point(const Point& p) { return {mm(p.x()), mm(p.y())}; }
Json loop(const Loop& points) {
  Json json = Json::array();
  for (const Point& p : points) json.push_back(point(p));
  return json;
}

const char* name(MotionKind motion) {
  switch (motion) {
    case MotionKind::Free:
      return "free";
    case MotionKind::Slide:
      return "slide";
    case MotionKind::Pivot:
      return "pivot";
    case MotionKind::Curve:
      return "curve";
    case MotionKind::Translation:
      return "translation";
  }
  return "free";
}

const char* kind(ContactKind of) { return of == ContactKind::EdgeOnCorner ? "EV" : "VE"; }

Json obstacle_json(const ObstaclePicture& obstacle) {
  Json json{{"name", obstacle.name}};
  if (obstacle.shape.radius_mm > 0) {
    json["centre_mm"] = point(obstacle.shape.area.outer.front());
    json["radius_mm"] = mm(obstacle.shape.radius_mm);
  } else {
    json["outline_mm"] = loop(obstacle.shape.area.outer);
  }
  return json;
}

Json path_json(const PathPicture& path, const std::string& aspect) {
  Json json{{"aspect", aspect},
            {"start_deg", degrees(path.start_rad)},
            {"outcome", name(path.outcome)},
            {"reason", path.reason},
            {"is_goal", path.is_goal}};
  json["legs"] = Json::array();
  for (const LegPicture& leg : path.legs) {
    Json contacts = Json::array();
    for (const ActiveContact& c : leg.contacts) {
      contacts.push_back({{"kind", kind(c.pair.kind)},
                          {"point_mm", point(c.point)},
                          {"normal", {to_unit(c.normal.x(), 1e4), to_unit(c.normal.y(), 1e4)}},
                          {"sticks", c.sticks}});
    }
    json["legs"].push_back(
        {{"motion", name(leg.motion)}, {"event", leg.event}, {"from", leg.from}, {"contacts", contacts}});
  }
  json["points"] = Json::array();
  for (const Configuration& q : path.points) json["points"].push_back({mm(q.x_mm), mm(q.y_mm), degrees(q.theta_rad)});
  return json;
}

Json space_json(const SpacePicture& space) {
  Json json{{"theta_step_deg", degrees(space.step_rad)}, {"slices", Json::array()}, {"facets", Json::array()}};
  for (std::size_t k = 0; k < space.slices.size(); ++k) {
    Json pieces = Json::array();
    for (const PiecePicture& piece : space.slices[k]) {
      pieces.push_back({piece.facet, coarse(piece.from.x()), coarse(piece.from.y()), coarse(piece.to.x()),
                        coarse(piece.to.y()), piece.supported ? 1 : 0});
    }
    json["slices"].push_back({{"theta_deg", degrees(static_cast<double>(k) * space.step_rad)}, {"pieces", pieces}});
  }
  for (const FacetPicture& facet : space.facets) {
    json["facets"].push_back({{"kind", kind(facet.kind)},
                              {"moving", facet.moving},
                              {"fixed", {facet.component, facet.fixed}},
                              {"label", facet.label}});
  }
  return json;
}

Json transitions_json(const TurningPicture& picture) {
  if (picture.transitions.empty()) return nullptr;
  Json json{{"poses", picture.poses}, {"features", Json::array()}};
  for (std::size_t i = 0; i < picture.transitions.size(); ++i) {
    Json matrix = Json::array();
    for (const std::vector<double>& row : picture.transitions[i]) {
      matrix.push_back(Json::array());
      for (const double p : row) matrix.back().push_back(share(p));
    }
    json["features"].push_back({{"name", picture.features[i]}, {"matrix", matrix}});
  }
  return json;
}

}  // namespace

Json turning_json(const FeederProblem& problem, const TurningPicture& picture) {
  const FeederSpec& spec = problem.spec();
  Json json{{"wall_y", 0},
            {"track_width_mm", mm(spec.environment.track_width_mm)},
            {"friction", share(spec.environment.wall_friction)}};
  json["obstacles"] = Json::array();
  for (const ObstaclePicture& obstacle : picture.obstacles) json["obstacles"].push_back(obstacle_json(obstacle));
  std::vector<std::string> aspects;
  for (std::size_t i = 0; i < picture.parts.size(); ++i) {
    aspects.push_back(spec.part.aspects[i].name);
    Json holes = Json::array();
    for (const Loop& hole : picture.parts[i].holes) holes.push_back(loop(hole));
    json["parts"][aspects.back()] = {{"outline_mm", loop(picture.parts[i].outer)}, {"holes_mm", holes}};
  }
  json["outcome_map"] = outcome_map_json([&] {
    std::vector<MapInterval> map;
    for (const IntervalPicture& interval : picture.map) map.push_back(interval.interval);
    return map;
  }());
  for (std::size_t i = 0; i < picture.map.size(); ++i) json["outcome_map"][i]["path"] = picture.map[i].path;
  json["paths"] = Json::array();
  for (const PathPicture& path : picture.paths)
    json["paths"].push_back(path_json(path, aspects[static_cast<std::size_t>(path.aspect)]));
  json["space"] = nullptr;
  for (const SpacePicture& space : picture.spaces)
    json["space"][aspects[static_cast<std::size_t>(space.aspect)]] = space_json(space);
  json["sensitivity"] = Json::array();
  for (const Sensitivity& s : picture.sensitivity) {
    json["sensitivity"].push_back({{"gyration_factor", s.gyration_factor},
                                   {"same_outcomes", s.same_outcomes},
                                   {"changed_probability", share(s.changed_probability)}});
  }
  json["transitions"] = transitions_json(picture);
  return json;
}

}  // namespace formotion
