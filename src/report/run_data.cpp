#include "report/run_data.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

#include "report/knee.hpp"

namespace formotion {
namespace {

using Json = nlohmann::ordered_json;

// Topologies of a problem that are all listed; of more only those of the designs shown.
constexpr std::size_t kMostTopologiesListed = 100;

Json scores_json(const std::vector<double>& scores) {
  Json json = Json::array();
  for (const double score : scores) json.push_back(fine(score));
  return json;
}

// All topologies, or of very many those of the designs shown.
Json topologies_json(const Problem& problem, const RunSummary& run) {
  const std::span<const Topology> all = problem.topologies();
  std::set<std::size_t> listed;
  for (const Evaluated& design : run.front) listed.insert(static_cast<std::size_t>(design.candidate.topology));
  for (std::size_t i = 0; i < all.size() && all.size() <= kMostTopologiesListed; ++i) listed.insert(i);
  Json json = Json::array();
  for (const std::size_t number : listed) {
    Json names = Json::array();
    for (const int index : all[number].variables)
      names.push_back(problem.variables()[static_cast<std::size_t>(index)].name);
    json.push_back({{"number", number}, {"label", all[number].label}, {"variables", names}});
  }
  return json;
}

// For a POSIX shell.
std::string quoted(const std::string& word) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || (c && std::strchr("/._-+", c));
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

Json knee_json(const Problem& problem, const RunSummary& run) {
  if (run.feasible == 0) return nullptr;
  std::vector<std::vector<double>> losses;
  for (const Evaluated& design : run.front) {
    losses.emplace_back();
    for (std::size_t k = 0; k < design.score.objectives.size(); ++k) {
      losses.back().push_back(problem.objectives()[k].loss(design.score.objectives[k]));
    }
  }
  const std::optional<Knee> found = knee(losses);
  if (!found) return nullptr;
  return {{"id", design_id(run.front[found->index])},
          {"distance", fine(found->distance)},
          {"how",
           "farthest, towards the better side, from the plane through the best designs of every objective; "
           "objectives scaled to 0..1 over the front"}};
}

}  // namespace

Json fine(double value) { return std::isfinite(value) ? Json(std::round(value * 1e6) / 1e6 + 0.0) : Json(nullptr); }

// Every measured number; what must be exact (values, features) is put in afterwards.
void round_all(Json& json) {
  if (json.is_number_float()) {
    json = fine(json.get<double>());
  } else if (json.is_structured()) {
    for (auto& item : json) round_all(item);
  }
}

void add_search_space(Json& json, const ProblemFile& file, const Problem& problem, const RunSummary& run) {
  json["objectives"] = Json::array();
  for (const Objective& o : problem.objectives()) {
    json["objectives"].push_back({{"name", o.name}, {"maximise", o.maximise}, {"resolution", o.resolution}});
  }
  json["variables"] = Json::array();
  for (const Variable& v : problem.variables()) {
    json["variables"].push_back(
        {{"name", v.name}, {"min", v.min}, {"max", v.max}, {"value", v.value ? Json(*v.value) : Json(nullptr)}});
  }
  json["topologies"] = topologies_json(problem, run);
  json["topology_count"] = problem.topologies().size();
  json["text"] = file.canonical;
}

void add_run(Json& json, const Problem& problem, const RunSummary& run, const ComparedRun* other) {
  json["run"] = {{"evaluations", run.evaluations}, {"stages", run.stages}, {"budget", run.budget},
                 {"feasible", run.feasible},       {"seed", run.seed},     {"complete", run.complete},
                 {"failures", run.failures}};
  const CourseBox box = course_box(run, other);
  json["history"] = course_json(run, box);
  json["compared"] = compared_json(other, box);
  json["findings"] = Json::array();
  for (const Finding& f : run.findings)
    json["findings"].push_back({{"topic", f.topic}, {"subject", f.subject}, {"text", f.text}});
  json["sample"] = Json::array();  // [number, topology, feasible, violation, [objectives]]
  for (const Evaluated& e : run.sample) {
    json["sample"].push_back({e.number, e.candidate.topology, e.score.feasible ? 1 : 0, fine(e.score.violation),
                              scores_json(e.score.objectives)});
  }
  json["knee"] = knee_json(problem, run);
}

Json design_head(const Problem& problem, const Evaluated& design, const std::map<std::string, std::string>& stamps) {
  Json json{{"id", design_id(design)}, {"number", design.number}, {"topology", design.candidate.topology}};
  json["label"] = problem.topologies()[static_cast<std::size_t>(design.candidate.topology)].label;
  json["provenance"] = design.provenance;
  json["objectives"] = scores_json(design.score.objectives);
  json["violation"] = fine(design.score.violation);
  const bool uncertain = !design.score.worst_case.empty() && design.score.worst_case != design.score.objectives;
  json["worst"] = uncertain ? scores_json(design.score.worst_case) : Json(nullptr);
  const auto stamp = stamps.find(design_id(design));
  json["stamp"] = stamp == stamps.end() ? Json(nullptr) : Json::parse(stamp->second);
  return json;
}

// evaluate takes the design's numbers from its file, so that they stay exact whatever the problem's topologies.
Json commands_json(const ProblemFile& file, const std::string& id) {
  const std::string program = "build/release/formotion ", run = "results/" + file.slug;
  return {
      {"evaluate", program + "evaluate " + quoted(file.path) + " --design " + quoted(run + "/designs/" + id + ".json")},
      {"export", program + "export " + quoted(run) + " --design " + id + " --format json"}};
}

}  // namespace formotion
