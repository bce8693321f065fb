#include "report/report_data.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "applications/feeder/travel_picture.hpp"
#include "io/feeder_json.hpp"
#include "report/run_data.hpp"
#include "report/turning_data.hpp"

namespace formotion {
namespace {

using Json = OrderedJson;
using namespace feeder;

// Numbers of generators in one page, about 8 bytes each; designs beyond have no animated hull.
constexpr std::size_t kMostTravelNumbers = 400000;
// Designs in one page with their configuration space, some 100 kB each; the page says so of the others.
constexpr int kMostSpaces = 6;

Json mm(double value) { return std::isfinite(value) ? Json(std::round(value * 1e4) / 1e4 + 0.0) : Json(nullptr); }
Json mm(const std::optional<double>& value) { return value ? mm(*value) : Json(nullptr); }
Json degrees(double rad) { return std::round(rad * 180 / std::numbers::pi * 1e6) / 1e6 + 0.0; }

Json point(const Point& p) { return {mm(p.x()), mm(p.y())}; }
Json loop(const Loop& points) {
  Json json = Json::array();
  for (const Point& p : points) json.push_back(point(p));
  return json;
}
Json polygon(const Polygon& area) {
  Json holes = Json::array();
  for (const Loop& hole : area.holes) holes.push_back(loop(hole));
  return {{"outer_mm", loop(area.outer)}, {"holes_mm", holes}};
}
Json polygons(const std::vector<Polygon>& areas) {
  Json json = Json::array();
  for (const Polygon& area : areas) json.push_back(polygon(area));
  return json;
}

Json goal_json(const Goal& goal) {
  Json json{{"one_pose", goal.one_pose}};
  if (!goal.one_pose) {
    json["aspect"] = goal.aspect;
    json["orientation_deg"] = degrees(goal.orientation_rad);
  }
  json["require_tip"] = goal.require_tip;
  return json;
}

Json environment_json(const Environment& e) {
  return {{"track_width_mm", e.track_width_mm},      {"wall_friction", e.wall_friction},
          {"drive_deg", degrees(e.drive_rad)},       {"conveying_speed_mm_s", e.conveying_speed_mm_s},
          {"tilt_deg", degrees(e.tilt_rad)},         {"spacing_mm", mm(e.spacing_mm)},  // null: the part's diameter
          {"settling_friction", e.settling_friction}};
}

Json uncertainty_json(const Uncertainty& u) {
  if (!u.any()) return nullptr;
  Json json{{"outline_mm", u.outline_mm}, {"com_mm", u.com_mm}, {"feature_mm", u.feature_mm}};
  for (const auto& [name, range] : u.intervals) json["intervals"][name] = {range.first, range.second};
  return json;
}

Json problem_json(const ProblemFile& file, const FeederProblem& problem, const RunSummary& run) {
  const FeederSpec& spec = problem.spec();
  Json json{{"name", file.name}, {"slug", file.slug}, {"path", file.path}, {"kind", file.kind}};
  json["environment"] = environment_json(spec.environment);
  json["goal"] = goal_json(spec.goal);
  json["manufacture"] = {{"cutter_radius_mm", mm(spec.manufacture.cutter_radius_mm)},
                         {"min_web_mm", mm(spec.manufacture.min_web_mm)}};
  json["uncertainty"] = uncertainty_json(spec.uncertainty);
  add_search_space(json, file, problem, run);
  return json;
}

// The part in all of its poses: shared by all designs that do not change it.
Json part_json(const FeederProblem& problem, std::span<const double> values, const std::vector<PosePicture>& pictures) {
  const std::vector<AspectShape> shapes = problem.shapes(values);
  Json json{{"aspects", Json::array()}, {"poses", Json::array()}};
  double across = 0;
  for (const AspectShape& shape : shapes) {
    Loop corners;
    for (const Polygon& body : shape.bodies) corners.insert(corners.end(), body.outer.begin(), body.outer.end());
    across = std::max(across, diameter(corners));
    json["aspects"].push_back({{"name", shape.name},
                               {"probability", fine(shape.probability)},
                               {"height_mm", mm(shape.height_mm)},
                               {"com_height_mm", mm(shape.com_height_mm)},
                               {"footprint", polygon(shape.footprint)},
                               {"upper", polygons({shape.bodies.begin() + 1, shape.bodies.end()})}});
  }
  json["diameter_mm"] = mm(across);
  for (const PosePicture& picture : pictures) {
    const Point supported(0, picture.supported_y_mm);
    Loop hull;
    for (const Point& p : picture.plain_hull) hull.push_back(p + supported);
    json["poses"].push_back({{"aspect", shapes[static_cast<std::size_t>(picture.stable.aspect)].name},
                             {"orientation_deg", degrees(picture.stable.orientation_rad)},
                             {"prior", fine(picture.stable.prior)},
                             {"com_y_mm", mm(picture.stable.com_wall_mm)},
                             {"supported_y_mm", mm(picture.supported_y_mm)},
                             {"x_min_mm", mm(picture.x_min_mm)},
                             {"x_max_mm", mm(picture.x_max_mm)},
                             {"plain_margin_mm", mm(picture.plain_margin_mm)},
                             {"plain_hull_mm", loop(hull)},
                             {"footprint", polygon(picture.footprint)},
                             {"upper", polygons({picture.bodies.begin() + 1, picture.bodies.end()})}});
  }
  return json;
}

// The hull's corners: [x_in, x_out, x, y] at rest, [x_in, x_out, x, y, x, y] moving from the first place to the second;
// x_in, x_out: positions of the centre of mass; x from the centre of mass, y from the wall.
Json travel_json(const PosePicture& picture, std::size_t& numbers) {
  Json json{{"groups", Json::array()}, {"held_mm", Json::array()}};
  for (const GroupPicture& group : picture.groups) {
    Json generators = Json::array();
    for (const Generator& g : group.generators) {
      const Point up(0, picture.supported_y_mm), begin = g.position + up, end = g.at(g.x_out) + up;
      Json row{mm(g.x_in), mm(g.x_out), mm(begin.x()), mm(begin.y())};
      if (g.moving) row.insert(row.end(), {mm(end.x()), mm(end.y())});
      numbers += row.size();
      generators.push_back(std::move(row));
    }
    json["groups"].push_back({{"from_mm", mm(group.from_mm)}, {"to_mm", mm(group.to_mm)}, {"generators", generators}});
  }
  for (const Interval& held : picture.held) json["held_mm"].push_back({mm(held.from), mm(held.to)});
  return json;
}

Json track_json(const std::vector<PlacedFeature>& features) {
  Json json = Json::array();
  for (const PlacedFeature& feature : features) {
    Json dimensions = Json::array();
    for (const auto& [name, value] : feature.dimensions) dimensions.push_back({name, mm(value)});
    json.push_back({{"type", feature.type},
                    {"start_mm", mm(feature.start_mm)},
                    {"end_mm", mm(feature.end_mm)},
                    {"voids", polygons(feature.voids_mm)},
                    {"dimensions", dimensions}});
  }
  return json;
}

// Designs in detail, and the different parts that they need.
class DesignWriter {
 public:
  DesignWriter(const ProblemFile& file, const FeederProblem& problem, const std::map<std::string, std::string>& stamps)
      : file_(file), problem_(problem), stamps_(stamps) {}

  int part(std::span<const double> values, const std::vector<PosePicture>& pictures) {
    Json json = part_json(problem_, values, pictures);
    const auto found = std::find(parts_.begin(), parts_.end(), json);
    if (found != parts_.end()) return static_cast<int>(found - parts_.begin());
    parts_.push_back(std::move(json));
    return static_cast<int>(parts_.size()) - 1;
  }

  Json operator()(const JudgedDesign& judged) {
    const Evaluated& design = judged.design;
    const std::vector<double>& values = judged.values;
    const int topology = design.candidate.topology;
    const std::vector<PosePicture> pictures = travel_pictures(problem_, topology, values);
    Json evaluation = evaluation_json(problem_, topology, values, judged.evaluation);
    round_all(evaluation);
    Json json = design_head(problem_, design, stamps_);
    json["uncertainty"] = evaluation.contains("uncertainty") ? evaluation["uncertainty"] : Json(nullptr);
    for (const char* key : {"feasible", "metrics", "worst_case", "violations", "warnings", "goal_pose", "poses"}) {
      json[key] = evaluation[key];
    }
    json["values"] = values_json(problem_, topology, values);
    json["features"] = features_json(problem_.literal_design(topology, values));
    json["track"] = track_json(problem_.place(topology, values));
    json["part"] = part(values, pictures);
    // Where parts turn the poses' own travel is not what happens.
    if (const auto picture = turning_picture(problem_, topology, values, spaces_ < kMostSpaces)) {
      spaces_ += picture->spaces.empty() ? 0 : 1;
      json["travel"] = nullptr;
      json["turning"] = turning_json(problem_, *picture);
    } else {
      json["travel"] = travels(pictures);
    }
    json["commands"] = commands_json(file_, design_id(design));
    return json;
  }

  const Json& parts() const { return parts_; }

 private:
  Json travels(const std::vector<PosePicture>& pictures) {
    std::size_t numbers = 0;
    Json json = Json::array();
    for (const PosePicture& picture : pictures) json.push_back(travel_json(picture, numbers));
    if (travel_numbers_ + numbers > kMostTravelNumbers) return nullptr;
    travel_numbers_ += numbers;
    return json;
  }

  const ProblemFile& file_;
  const FeederProblem& problem_;
  const std::map<std::string, std::string>& stamps_;
  Json parts_ = Json::array();
  std::size_t travel_numbers_ = 0;
  int spaces_ = 0;
};

}  // namespace

Json report_data(const ProblemFile& file, const FeederProblem& problem, const RunSummary& run,
                 const std::vector<JudgedDesign>& front, const ComparedRun* other) {
  Json json{{"formotion", 1}, {"program", "formotion " + run.program_version}};
  json["problem"] = problem_json(file, problem, run);
  add_run(json, problem, run, other);
  if (file.feeder.grammar) {
    for (const PrunedSequences& entry : file.feeder.grammar->pruned) {
      json["findings"].push_back({{"topic", "pruned"},
                                  {"subject", std::to_string(entry.count) + " sequences of " + entry.pattern},
                                  {"text", entry.reason}});
    }
  }
  DesignWriter writer(file, problem, run.stamps);
  std::vector<double> start;
  for (const Variable& v : problem.variables()) start.push_back(v.start());
  if (!problem.topologies().empty()) writer.part(start, travel_pictures(problem, 0, start));
  json["designs"] = Json::array();
  // The knee is what the page opens with: its travel comes first, should there be too many.
  std::vector<Json> designs(front.size());
  const auto write = [&](bool of_knee) {
    for (std::size_t i = 0; i < designs.size(); ++i) {
      const bool is_knee = !json["knee"].is_null() && json["knee"]["id"] == design_id(front[i].design);
      if (is_knee == of_knee) designs[i] = writer(front[i]);
    }
  };
  write(true);
  write(false);
  for (Json& design : designs) json["designs"].push_back(std::move(design));
  json["parts"] = writer.parts();  // [0] is the part as asked for, variables at their starting values
  return json;
}

}  // namespace formotion
