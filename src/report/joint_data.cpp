#include "report/joint_data.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "analysis/contact/free_slice.hpp"
#include "applications/shared/starts.hpp"
#include "io/assembly_json.hpp"

namespace formotion {
namespace {

using Json = nlohmann::ordered_json;
using namespace assembly;

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr int kGrid = 5;                  // starts a side that can be clicked
constexpr std::size_t kMostMoments = 60;  // of one insertion
constexpr double kSliceStep_rad = 0.5 / kDegrees;
constexpr int kSlices = 10;  // on each side of the drawn orientation

Json to_unit(double value, double per) {
  return std::isfinite(value) ? Json(std::round(value * per) / per + 0.0) : Json(nullptr);
}
Json mm(double value) { return to_unit(value, 1e4); }
Json degrees(double rad) { return to_unit(rad * kDegrees, 1e4); }
Json point(const Point& p) { return {mm(p.x()), mm(p.y())}; }
Json loop(const Loop& points, const Point& minus = Point::Zero()) {
  Json json = Json::array();
  for (const Point& p : points) json.push_back(point(p - minus));
  return json;
}
Json interval(const ErrorInterval& i, double per = 1) { return {mm(i.min * per), mm(i.max * per)}; }

// place: where the two touch with the part at q.
Json pair_json(const ContactSpace& space, const WrittenNames& names, const ContactPair& pair, const Configuration& q,
               const Point& place) {
  Json json{{"kind", kind_word(pair.kind)}};
  json.update(features_json(names.of(space.part, space.obstacles, pair, q, place)));
  return json;
}

Json moment_json(const ContactSpace& space, const WrittenNames& names, const InsertionMoment& moment) {
  Json json{{"travel_mm", mm(moment.travel_mm)},
            {"q", {mm(moment.q.x_mm), mm(moment.q.y_mm), degrees(moment.q.theta_rad)}},
            {"depth_mm", mm(moment.depth_mm)},
            {"axial_n", mm(moment.axial_n)},
            {"lateral_n", mm(moment.lateral_n)},
            {"moment_nmm", mm(moment.moment_nmm)},
            {"event", moment.event},
            {"contacts", Json::array()}};
  for (const CarriedContact& contact : moment.contacts) {
    Json one = pair_json(space, names, contact.pair, moment.q, contact.point);
    one["point"] = point(contact.point);
    one["normal"] = point(contact.normal);
    one["mode"] = mode_word(contact.mode);
    one["force"] = {mm(contact.force.normal), mm(contact.force.tangential)};
    json["contacts"].push_back(std::move(one));
  }
  return json;
}

// The start projected again, with its path; moments between events are thinned.
Json insertion_json(const InsertionTask& task, const WrittenNames& names, double x_mm, double y_mm, double theta_rad) {
  InsertionOptions options;
  options.keep_path = true;
  const Insertion found = insert(task, start_with_errors(task, x_mm, y_mm, theta_rad), options);
  Json json{{"x_mm", mm(x_mm)},
            {"y_mm", mm(y_mm)},
            {"theta_deg", degrees(theta_rad)},
            {"outcome", name(found.outcome)},
            {"why", found.why},
            {"depth_mm", mm(found.depth_mm)},
            {"deepest_mm", mm(found.deepest_mm)},
            {"peak_axial_n", mm(found.peak_axial_n)},
            {"peak_lateral_n", mm(found.peak_lateral_n)},
            {"work_nmm", mm(found.work_nmm)},
            {"moments", Json::array()}};
  const std::size_t every = found.path.size() / kMostMoments + 1;
  for (std::size_t i = 0; i < found.path.size(); ++i) {
    const bool kept = i % every == 0 || i + 1 == found.path.size() || (every == 1 && !found.path[i].event.empty());
    if (kept) json["moments"].push_back(moment_json(*task.space, names, found.path[i]));
  }
  if (found.path.empty()) {
    InsertionMoment at_start;
    at_start.q = start_with_errors(task, x_mm, y_mm, theta_rad);
    at_start.event = "overlaps";
    json["moments"].push_back(moment_json(*task.space, names, at_start));
  }
  return json;
}

Json region_json(const AssemblyEvaluation& evaluation) {
  const OutcomeRegion& region = evaluation.regions[evaluation.regions.size() / 2];
  Json json{{"x_mm", {mm(region.box.u_min), mm(region.box.u_max)}},
            {"theta_deg", {degrees(region.box.v_min), degrees(region.box.v_max)}},
            {"shares", Json::object()},
            {"rows", Json::array()}};
  for (int k = 0; k < kInsertionOutcomes; ++k) {
    const double share = share_of(region, k);
    if (share > 0) json["shares"][name(static_cast<InsertionOutcome>(k))] = to_unit(share, 1e6);
  }
  for (const RegionRow& row : region.rows) {
    Json intervals = Json::array();
    for (const RegionInterval& i : row.intervals)
      intervals.push_back({mm(i.from), mm(i.to), name(static_cast<InsertionOutcome>(i.outcome))});
    json["rows"].push_back({{"theta_deg", degrees(row.v)}, {"intervals", intervals}});
  }
  return json;
}

Json space_json(const Scene& scene, const WrittenNames& names) {
  Json json{{"theta_step_deg", degrees(kSliceStep_rad)}, {"slices", Json::array()}, {"facets", Json::array()}};
  std::map<std::size_t, std::size_t> numbers;  // of the pairs that occur
  for (int k = -kSlices; k <= kSlices; ++k) {
    const double theta = scene.task.drawn.theta_rad + k * kSliceStep_rad;
    Json pieces = Json::array();
    for (const SlicePiece& piece : free_slice(scene.part, scene.obstacles, theta).pieces) {
      const std::size_t pair = scene.space->index_of(piece.pair);
      const auto [known, is_new] = numbers.emplace(pair, numbers.size());
      if (is_new) {
        const Point middle = (piece.from + piece.to) / 2;
        const Configuration q{middle.x(), middle.y(), theta};
        const ContactState state =
            contact_state(scene.part, scene.obstacles, piece.pair, middle, std::cos(theta), std::sin(theta));
        Json facet = pair_json(*scene.space, names, piece.pair, q, middle + state.lever);
        facet["label"] = facet["kind"].get<std::string>() + " part " + facet["moving"].dump() + ", shape " +
                         facet["fixed"][0].dump() + " " + facet["fixed"][1].dump();
        json["facets"].push_back(std::move(facet));
      }
      const auto coarse = [](double v) { return to_unit(v, 1e2); };
      pieces.push_back({known->second, coarse(piece.from.x()), coarse(piece.from.y()), coarse(piece.to.x()),
                        coarse(piece.to.y()), 1});
    }
    json["slices"].push_back({{"theta_deg", degrees(theta)}, {"pieces", pieces}});
  }
  return json;
}

}  // namespace

Json asked_json(const AssemblySpec& spec, std::span<const double> values) {
  const StartsSpec& starts = spec.goal.starts;
  Json never = Json::array();
  for (const NeverSpec& goal : spec.goal.never)
    never.push_back({{"aspect", goal.aspect}, {"orientation_deg", degrees(goal.orientation_rad)}});
  return {{"friction", mm(spec.friction.value(values))},
          {"damper", spec.support.damper},
          {"stiffness",
           {{"kx_n_per_mm", mm(spec.support.kx.value(values))},
            {"ky_n_per_mm", mm(spec.support.ky.value(values))},
            {"ktheta_nmm_per_rad", mm(spec.support.ktheta.value(values))}}},
          {"approach",
           {{"direction_deg", degrees(spec.approach.direction_rad)},
            {"distance_mm", mm(spec.approach.distance_mm)},
            {"max_force_n", spec.approach.max_force_n ? mm(*spec.approach.max_force_n) : Json(nullptr)}}},
          {"goal",
           {{"depth_mm", mm(spec.goal.depth_mm)},
            {"lateral_mm", mm(spec.goal.lateral_mm)},
            {"tilt_deg", degrees(spec.goal.tilt_rad)},
            {"starts",
             {{"x_mm", interval(starts.x_mm)},
              {"y_mm", interval(starts.y_mm)},
              {"theta_deg", interval(starts.theta_rad, kDegrees)}}},
            {"never", never}}}};
}

Json joint_json(const AssemblyProblem& problem, int topology, std::span<const double> values,
                const AssemblyEvaluation& evaluation, bool with_space) {
  const Joint joint = problem.joint(topology, values);
  Json json{{"fixed", Json::array()}, {"part", Json::array()}, {"centre_mm", point(joint.centre_mm)}};
  for (const Loop& shape : joint.fixed_mm) json["fixed"].push_back(loop(shape));
  json["part"].push_back(loop(joint.part.outer, joint.centre_mm));
  for (const Loop& hole : joint.part.holes) json["part"].push_back(loop(hole, joint.centre_mm));
  if (evaluation.regions.empty()) return nullptr;  // shapes that are not valid
  json["region"] = region_json(evaluation);
  const Metrics& metrics = evaluation.metrics;
  json["capture"] = {{"mm", metrics.capture_mm ? mm(*metrics.capture_mm) : Json(nullptr)},
                     {"deg", metrics.capture_deg ? mm(*metrics.capture_deg) : Json(nullptr)}};
  const std::unique_ptr<Scene> scene = problem.scene(topology, values, "up", 0);
  const WrittenNames names = names_of(joint, "up", joint.centre_mm);
  const StartsSpec& starts = problem.spec().goal.starts;
  const double y = (starts.y_mm.min + starts.y_mm.max) / 2;
  json["insertions"] = Json::array();
  for (const double theta : values_of(starts.theta_rad, kGrid)) {
    for (const double x : values_of(starts.x_mm, kGrid))
      json["insertions"].push_back(insertion_json(scene->task, names, x, y, theta));
  }
  json["never"] = Json::array();
  for (const NeverResult& result : evaluation.never) {
    const std::unique_ptr<Scene> wrong = problem.scene(topology, values, result.aspect, result.orientation_rad);
    wrong->task.goal = {problem.spec().goal.depth_mm, 1e9, 1e9};
    const StartResult& start = result.deepest;
    json["never"].push_back({{"aspect", result.aspect},
                             {"orientation_deg", degrees(result.orientation_rad)},
                             {"holds", result.holds},
                             {"proved", result.proved},
                             {"bound_mm", result.bound_mm ? mm(*result.bound_mm) : Json(nullptr)},
                             {"deepest_mm", mm(start.insertion.deepest_mm)},
                             {"starts", result.starts},
                             {"why", result.why},
                             {"mirrored", result.aspect == "down"},
                             {"insertion", insertion_json(wrong->task, names_of(joint, result.aspect, joint.centre_mm),
                                                          start.x_mm, start.y_mm, start.theta_rad)}});
  }
  json["space"] = with_space ? space_json(*scene, names) : Json(nullptr);
  return json;
}

}  // namespace formotion
