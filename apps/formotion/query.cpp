// query: JSON lines in, JSON lines out.
#include <algorithm>
#include <iostream>
#include <numbers>

#include "chosen_design.hpp"
#include "io/feeder_json.hpp"
#include "io/json_document.hpp"
#include "io/json_reader.hpp"
#include "io/suggestion.hpp"

namespace formotion {
namespace {

const std::vector<std::string> kLaterTypes{"clearance", "contacts", "motion", "project", "facets"};

feeder::Configuration read_configuration(const OrderedJson& value, IssueList& issues) {
  ObjectReader object(value, "/q", issues);
  feeder::Configuration q;
  q.x_mm = object.required_number("x_mm", kAny);
  q.y_mm = object.required_number("y_mm", kAny);
  q.theta_rad = object.required_number("theta_deg", kAny) * std::numbers::pi / 180;
  object.finish();
  return q;
}

OrderedJson answer(const OrderedJson& request, const ChosenDesign& chosen, IssueList& issues) {
  ObjectReader object(request, "", issues);
  object.ignore({"id"});
  object.require("type", "support");
  const auto type = object.string("type");
  if (type && *type != "support") {
    const bool later = std::find(kLaterTypes.begin(), kLaterTypes.end(), *type) != kLaterTypes.end();
    issues.add(
        "/type",
        "'" + *type + "'" + (later ? ", which this version does not answer yet" : did_you_mean(*type, {"support"})),
        "support");
    return {};
  }
  const std::vector<feeder::AspectShape> shapes = chosen.problem->shapes(chosen.values);
  std::string aspect = shapes.front().name, list;
  for (const feeder::AspectShape& shape : shapes) list += (list.empty() ? "" : ", ") + shape.name;
  if (const auto named = object.string("aspect")) {
    aspect = *named;
    if (std::none_of(shapes.begin(), shapes.end(), [&](const feeder::AspectShape& s) { return s.name == aspect; })) {
      issues.add("/aspect", "the unknown aspect '" + aspect + "'", "one of " + list);
    }
  } else if (shapes.size() > 1 && object.valid() && !request.contains("aspect")) {
    issues.add("/aspect", "nothing", "one of " + list);
  }
  const OrderedJson* q = object.require("q", "a configuration {\"x_mm\", \"y_mm\", \"theta_deg\"}");
  const feeder::Configuration configuration = q ? read_configuration(*q, issues) : feeder::Configuration{};
  object.finish();
  if (!issues.issues.empty()) return {};
  const feeder::SupportAnswer found = chosen.problem->support(chosen.topology, chosen.values, aspect, configuration);
  OrderedJson json{{"supported", found.supported}};
  json["margin_mm"] = found.margin_mm ? OrderedJson(*found.margin_mm + 0.0) : OrderedJson(nullptr);
  return json;
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
OrderedJson answer_line(const std::string& line, const ChosenDesign& chosen) {
  OrderedJson id = nullptr;
  IssueList issues{"query", {}};
  try {
    const OrderedJson request = parse_json(line, "query");
    if (request.is_object() && request.contains("id")) id = request["id"];
    OrderedJson json{{"id", id}};
    OrderedJson found = answer(request, chosen, issues);
    if (issues.issues.empty()) {
      json.update(found);
      return json;
    }
  } catch (const InputError& error) { issues.issues = error.issues; }
  return {{"id", id}, {"error", joined(issues.issues)}};
}

}  // namespace

int run_query(const DesignChoice& choice) {
  const ChosenDesign chosen = chosen_design(choice);
  std::string line;
  while (std::getline(std::cin, line)) {
    std::cout << answer_line(line, chosen).dump(-1, ' ', true, OrderedJson::error_handler_t::replace) << std::endl;
  }
  return kDone;
}

}  // namespace formotion
