// query: sweep.
#include "applications/feeder/swept_obstacle.hpp"
#include "query_answers.hpp"

namespace formotion {
namespace {

constexpr double kPrecision_mm = 0.05;
constexpr Range kPrecisions{1e-3, 10, false};  // finer ones take a union of millions of shapes

OrderedJson loop_of_points(const Loop& loop) {
  OrderedJson list = OrderedJson::array();
  for (const Point& p : loop) list.push_back(point_json(p));
  return list;
}

}  // namespace

SweepQuestion read_sweep(ObjectReader& object, IssueList& issues) {
  SweepQuestion question;
  question.precision_mm = object.number_or("precision_mm", kPrecisions, kPrecision_mm);
  const OrderedJson* path = object.require("path", "an array of configurations");
  if (path && path->is_array() && !path->empty()) {
    for (std::size_t i = 0; i < path->size(); ++i)
      question.path.push_back(read_configuration((*path)[i], "/path/" + std::to_string(i), issues));
  } else if (path) {
    issues.add("/path", described(*path), "an array of configurations");
  }
  const OrderedJson* region = object.require("region_mm", "a polygon [[x, y], ...]");
  if (!region) return question;
  if (!region->is_array()) issues.add("/region_mm", described(*region), "a polygon [[x, y], ...]");
  for (std::size_t i = 0; region->is_array() && i < region->size(); ++i) {
    const OrderedJson& corner = (*region)[i];
    const std::string at = "/region_mm/" + std::to_string(i);
    if (!corner.is_array() || corner.size() != 2) {
      issues.add(at, described(corner), "a corner [x, y]");
      continue;
    }
    const auto x = read_number(corner[0], at + "/0", kAny, issues), y = read_number(corner[1], at + "/1", kAny, issues);
    if (x && y) question.region.emplace_back(*x, *y);
  }
  if (!issues.issues.empty()) return question;
  if (const auto found = defect(normalised({question.region, {}})))
    issues.add("/region_mm", *found, "a simple polygon");
  return question;
}

OrderedJson sweep_answer(const std::vector<Polygon>& bodies, const SweepQuestion& question) {
  const feeder::SweptObstacle swept =
      feeder::swept_obstacle(bodies, question.path, question.region, question.precision_mm);
  OrderedJson polygon = OrderedJson::array(), pieces = OrderedJson::array();
  if (!swept.pieces.empty()) polygon = loop_of_points(swept.pieces.front().outer);
  for (const Polygon& piece : swept.pieces) {
    OrderedJson holes = OrderedJson::array();
    for (const Loop& hole : piece.holes) holes.push_back(loop_of_points(hole));
    pieces.push_back({{"polygon_mm", loop_of_points(piece.outer)}, {"holes_mm", holes}});
  }
  return {{"polygon_mm", polygon}, {"pieces", pieces}, {"precision_mm", question.precision_mm}};
}

}  // namespace formotion
