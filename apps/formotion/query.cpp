// query: JSON lines in, JSON lines out.
#include <algorithm>
#include <iostream>
#include <map>
#include <numbers>

#include "chosen_design.hpp"
#include "io/feeder_json.hpp"
#include "io/json_document.hpp"
#include "io/json_reader.hpp"
#include "io/suggestion.hpp"
#include "query_answers.hpp"

namespace formotion {
namespace {

const std::vector<std::string> kTypes{"support", "clearance", "contacts", "motion", "project", "facets", "sweep"};

// A design with the worlds of its aspects, made when they are asked for.
class Answers {
 public:
  explicit Answers(const ChosenDesign& chosen)
      : chosen_(chosen), problem_(chosen.file.feeder), shapes_(problem_.shapes(chosen.values)) {}

  OrderedJson operator()(const OrderedJson& request, IssueList& issues) {
    ObjectReader object(request, "", issues);
    object.ignore({"id"});
    object.require("type", "one of " + list(kTypes));
    const auto type = object.string("type");
    if (type && std::find(kTypes.begin(), kTypes.end(), *type) == kTypes.end()) {
      issues.add("/type", "the unknown type '" + *type + "'" + did_you_mean(*type, kTypes), "one of " + list(kTypes));
      return {};
    }
    const std::string aspect = read_aspect(object, request, issues);
    Configuration q;
    const bool sweeps = type && *type == "sweep";
    const SweepQuestion sweep = sweeps ? read_sweep(object, issues) : SweepQuestion{};
    if (type && *type != "facets" && !sweeps) {
      const OrderedJson* given = object.require("q", "a configuration {\"x_mm\", \"y_mm\", \"theta_deg\"}");
      if (given) q = read_configuration(*given, "/q", issues);
    }
    double tolerance_mm = kTouches_mm;
    if (type && (*type == "contacts" || *type == "motion"))
      tolerance_mm = object.number_or("tolerance_mm", kPositive, tolerance_mm);
    object.finish();
    if (!issues.issues.empty()) return {};
    if (*type == "support") return support(aspect, q);
    if (sweeps) return sweep_answer(shape_of(aspect), sweep);
    const QueriedWorld& queried = world(aspect);
    if (*type == "clearance") return clearance_answer(queried, q);
    if (*type == "contacts") return contacts_answer(queried, q, tolerance_mm);
    if (*type == "motion") return motion_answer(queried, q, tolerance_mm, issues);
    if (*type == "project") return project_answer(queried, q, issues);
    return facets_answer(queried);
  }

 private:
  static std::string list(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
  }

  std::string read_aspect(ObjectReader& object, const OrderedJson& request, IssueList& issues) const {
    std::vector<std::string> names;
    for (const feeder::AspectShape& shape : shapes_) names.push_back(shape.name);
    const auto named = object.string("aspect");
    if (named && std::find(names.begin(), names.end(), *named) == names.end()) {
      issues.add("/aspect", "the unknown aspect '" + *named + "'", "one of " + list(names));
    } else if (names.size() > 1 && object.valid() && !request.contains("aspect")) {
      issues.add("/aspect", "nothing", "one of " + list(names));
    }
    return named.value_or(names.front());
  }

  const feeder::AspectShape& shape_of(const std::string& aspect) const {
    return *std::find_if(shapes_.begin(), shapes_.end(),
                         [&](const feeder::AspectShape& shape) { return shape.name == aspect; });
  }

  OrderedJson support(const std::string& aspect, const Configuration& q) const {
    const feeder::SupportAnswer found = problem_.support(chosen_.topology, chosen_.values, aspect, q);
    OrderedJson json{{"supported", found.supported}};
    json["margin_mm"] = found.margin_mm ? OrderedJson(*found.margin_mm + 0.0) : OrderedJson(nullptr);
    return json;
  }

  const QueriedWorld& world(const std::string& aspect) {
    const auto known = worlds_.find(aspect);
    if (known != worlds_.end()) return known->second;
    feeder::World made = problem_.world(chosen_.topology, chosen_.values, aspect);
    WrittenNames names(problem_, chosen_.topology, chosen_.values, aspect, made);
    return worlds_.emplace(aspect, QueriedWorld{std::move(made), std::move(names)}).first->second;
  }

  const ChosenDesign& chosen_;
  feeder::FeederProblem problem_;
  std::vector<feeder::AspectShape> shapes_;
  std::map<std::string, QueriedWorld> worlds_;
};

std::string joined(const std::vector<InputIssue>& issues) {
  std::string text;
  for (const InputIssue& issue : issues) {
    text += text.empty() ? "" : "; ";
    if (!issue.where.empty()) text += issue.where + ": ";
    text += issue.found + (issue.expected.empty() ? "" : ", expected " + issue.expected);
  }
  return text;
}

// One line's answer; whatever is wrong with it is said there.
OrderedJson answer_line(const std::string& line, Answers& answers) {
  OrderedJson id = nullptr;
  IssueList issues{"query", {}};
  try {
    const OrderedJson request = parse_json(line, "query");
    if (request.is_object() && request.contains("id")) id = request["id"];
    OrderedJson json{{"id", id}};
    OrderedJson found = answers(request, issues);
    if (issues.issues.empty()) {
      json.update(found);
      return json;
    }
  } catch (const InputError& error) { issues.issues = error.issues; }
  return {{"id", id}, {"error", joined(issues.issues)}};
}

}  // namespace

Configuration read_configuration(const OrderedJson& value, const std::string& pointer, IssueList& issues) {
  ObjectReader object(value, pointer, issues);
  Configuration q;
  q.x_mm = object.required_number("x_mm", kAny);
  q.y_mm = object.required_number("y_mm", kAny);
  q.theta_rad = object.required_number("theta_deg", kAny) * std::numbers::pi / 180;
  object.finish();
  return q;
}

int run_query(const DesignChoice& choice) {
  const ChosenDesign chosen = chosen_design(choice);
  if (chosen.file.kind != "feeder")
    throw InputError(
        {{choice.problem, "/kind", false, "'" + chosen.file.kind + "', which query does not answer yet", "feeder"}});
  Answers answers(chosen);
  std::string line;
  while (std::getline(std::cin, line)) {
    std::cout << answer_line(line, answers).dump(-1, ' ', true, OrderedJson::error_handler_t::replace) << std::endl;
  }
  return kDone;
}

}  // namespace formotion
