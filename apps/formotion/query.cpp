// query: JSON lines in, JSON lines out.
#include <algorithm>
#include <iostream>
#include <numbers>

#include "io/json_document.hpp"
#include "io/json_reader.hpp"
#include "io/suggestion.hpp"
#include "query_answers.hpp"

namespace formotion {
namespace {

const std::vector<std::string> kTypes{"support", "clearance", "contacts", "motion", "project", "facets", "sweep"};

std::string list(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string read_aspect(ObjectReader& object, const OrderedJson& request, const std::vector<std::string>& names,
                        IssueList& issues) {
  const auto named = object.string("aspect");
  if (named && std::find(names.begin(), names.end(), *named) == names.end()) {
    issues.add("/aspect", "the unknown aspect '" + *named + "'", "one of " + list(names));
  } else if (names.size() > 1 && object.valid() && !request.contains("aspect")) {
    issues.add("/aspect", "nothing", "one of " + list(names));
  }
  return named.value_or(names.front());
}

OrderedJson answer(const OrderedJson& request, Answers& answers, IssueList& issues) {
  ObjectReader object(request, "", issues);
  object.ignore({"id"});
  object.require("type", "one of " + list(kTypes));
  const auto type = object.string("type");
  if (type && std::find(kTypes.begin(), kTypes.end(), *type) == kTypes.end()) {
    issues.add("/type", "the unknown type '" + *type + "'" + did_you_mean(*type, kTypes), "one of " + list(kTypes));
    return {};
  }
  if (const auto refused = type ? answers.refusal(*type) : std::nullopt) {
    issues.issues.push_back(*refused);
    return {};
  }
  const std::string aspect = read_aspect(object, request, answers.aspects(), issues);
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
  if (*type == "support") return answers.support(aspect, q);
  if (*type == "project") return answers.project(aspect, q, issues);
  if (sweeps) return answers.sweep(aspect, sweep);
  const QueriedWorld& world = answers.world(aspect);
  if (*type == "clearance") return clearance_answer(world, q);
  if (*type == "contacts") return contacts_answer(world, q, tolerance_mm);
  if (*type == "motion") return motion_answer(world, answers.law(aspect, q), q, tolerance_mm, issues);
  return facets_answer(world);
}

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
    const OrderedJson found = answer(request, answers, issues);
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
  const std::unique_ptr<Answers> answers = chosen.file.assembly ? assembly_answers(chosen)
                                           : chosen.file.nest   ? nest_answers(chosen)
                                                                : feeder_answers(chosen);
  std::string line;
  while (std::getline(std::cin, line)) {
    std::cout << answer_line(line, *answers).dump(-1, ' ', true, OrderedJson::error_handler_t::replace) << std::endl;
  }
  return kDone;
}

}  // namespace formotion
