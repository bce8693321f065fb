#include "report/run_course.hpp"

#include <algorithm>
#include <cmath>

#include "optimize/hypervolume.hpp"

namespace formotion {
namespace {

using Json = nlohmann::ordered_json;

Json fine(double value) { return std::round(value * 1e6) / 1e6 + 0.0; }

Json fine(const std::vector<double>& values) {
  Json json = Json::array();
  for (const double value : values) json.push_back(fine(value));
  return json;
}

}  // namespace

CourseBox course_box(const RunSummary& run, const ComparedRun* other) {
  CourseBox box{run.least, run.most};
  if (!other || other->run.least.empty()) return box;
  if (box.least.empty()) return {other->run.least, other->run.most};
  for (std::size_t k = 0; k < box.least.size(); ++k) {
    box.least[k] = std::min(box.least[k], other->run.least[k]);
    box.most[k] = std::max(box.most[k], other->run.most[k]);
  }
  return box;
}

Json course_json(const RunSummary& run, const CourseBox& box) {
  Json json = Json::array();
  for (const RunProgress& p : run.history) {
    const bool measured = !box.least.empty() && !p.front.empty();
    json.push_back(
        {{"evaluations", p.spent()},
         {"work", p.work},
         {"front", p.front_size},
         {"best", fine(p.best)},
         {"hypervolume", measured ? fine(normalised_hypervolume(p.front, {box.least, box.most})) : Json(nullptr)}});
  }
  return json;
}

Json compared_json(const ComparedRun* other, const CourseBox& box) {
  if (!other) return nullptr;
  Json json{{"name", other->name},
            {"evaluations", other->run.evaluations},
            {"seed", other->run.seed},
            {"complete", other->run.complete},
            {"history", course_json(other->run, box)},
            {"designs", Json::array()}};
  for (const Evaluated& design : other->run.front) {
    json["designs"].push_back({{"id", design_id(design)},
                               {"label", other->labels[static_cast<std::size_t>(design.candidate.topology)]},
                               {"feasible", design.score.feasible},
                               {"objectives", fine(design.score.objectives)}});
  }
  return json;
}

}  // namespace formotion
