#include "io/problem_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "applications/feeder/feeder_problem.hpp"
#include "applications/feeder/grammar.hpp"
#include "applications/feeder/inverse_goals.hpp"
#include "io/json_document.hpp"
#include "io/problem_reader.hpp"
#include "io/read_asked.hpp"
#include "io/read_assembly.hpp"
#include "io/read_nest.hpp"
#include "io/suggestion.hpp"

namespace formotion {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMostEvaluations = 1e9;
constexpr double kLargestSeed = 9007199254740992.0;  // 2^53: JSON numbers of every reader hold it

bool begins_name(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool goes_on_name(char c) { return begins_name(c) || (c >= '0' && c <= '9') || c == '.'; }
bool is_name(const std::string& text) {
  return !text.empty() && text.size() <= 64 && begins_name(text[0]) &&
         std::all_of(text.begin(), text.end(), goes_on_name);
}

std::string slug_of(const std::string& name) {
  std::string slug;
  for (const char c : name) {
    if (goes_on_name(c) || c == '-') {
      slug += c;
    } else if (!slug.empty() && slug.back() != '_') {
      slug += '_';
    }
  }
  while (!slug.empty() && (slug.back() == '_' || slug.back() == '.')) slug.pop_back();
  while (!slug.empty() && (slug.front() == '_' || slug.front() == '.')) slug.erase(slug.begin());
  return slug.empty() ? "problem" : slug.substr(0, 100);
}

std::vector<Variable> read_variables(const Json* value, IssueList& issues) {
  std::vector<Variable> variables;
  if (!value) return variables;
  if (!value->is_object()) {
    issues.add("/variables", described(*value), "an object: {\"NAME\": {\"min\", \"max\", \"value\"}, ...}");
    return variables;
  }
  for (const auto& [name, bounds] : value->items()) {
    ObjectReader object(bounds, "/variables/" + name, issues);
    Variable variable{name, 0, 0, std::nullopt};
    if (!is_name(name)) {
      issues.add(object.pointer(), "the name '" + name + "'", "letters, digits, '_' and '.', beginning with a letter");
    }
    variable.min = object.required_number("min", kAny);
    variable.max = object.required_number("max", kAny);
    variable.value = object.number("value", kAny);
    object.finish();
    const auto is_number = [&given = bounds](const char* key) { return given.contains(key) && given[key].is_number(); };
    if (!object.valid() || !is_number("min") || !is_number("max")) {
      // said already
    } else if (variable.min > variable.max) {
      issues.add(object.at("min"), Json(variable.min).dump(), "a number of at most max, " + Json(variable.max).dump());
    } else if (variable.value && (*variable.value < variable.min || *variable.value > variable.max)) {
      issues.add(object.at("value"), Json(*variable.value).dump(),
                 "a number from " + Json(variable.min).dump() + " to " + Json(variable.max).dump());
    }
    variables.push_back(std::move(variable));
  }
  return variables;
}

// usual: how many of the known ones, from the first on, are searched for unless the problem says otherwise.
std::vector<Objective> read_objectives(const Json* value, std::span<const Objective> known, int usual,
                                       IssueList& issues) {
  if (!value) return {known.begin(), known.begin() + usual};
  std::vector<std::string> names;
  for (const Objective& objective : known) names.push_back(objective.name);
  std::vector<Objective> objectives;
  if (!value->is_array() || value->empty()) {
    issues.add("/search/objectives", described(*value), "an array of objectives' names");
    return objectives;
  }
  for (std::size_t i = 0; i < value->size(); ++i) {
    const std::string pointer = "/search/objectives/" + std::to_string(i);
    const auto name = read_string((*value)[i], pointer, issues);
    if (!name) continue;
    const auto found = std::find_if(known.begin(), known.end(), [&](const Objective& o) { return o.name == *name; });
    if (found == known.end()) {
      std::string list;
      for (const std::string& each : names) list += (list.empty() ? "" : ", ") + each;
      issues.add(pointer, "the unknown objective '" + *name + "'" + did_you_mean(*name, names), "one of " + list);
    } else if (std::any_of(objectives.begin(), objectives.end(), [&](const Objective& o) { return o.name == *name; })) {
      issues.add(pointer, "'" + *name + "' again", "each objective once");
    } else {
      objectives.push_back(*found);
    }
  }
  return objectives;
}

std::optional<std::int64_t> whole_number(ObjectReader& object, const std::string& key, double least, double most,
                                         IssueList& issues) {
  const Json* value = object.find(key);
  if (!value) return std::nullopt;
  const auto number = read_number(*value, object.at(key), {least, most, false}, issues);
  if (!number) return std::nullopt;
  if (*number != std::floor(*number)) {
    issues.add(object.at(key), described(*value), "a whole number");
    return std::nullopt;
  }
  return static_cast<std::int64_t>(*number);
}

// Objectives and robustness into a specification of any kind.
template <class Spec>
void read_search(const Json* value, std::span<const Objective> known, int usual, ProblemFile& file, Spec& spec,
                 IssueList& issues) {
  if (!value) {
    spec.objectives = read_objectives(nullptr, known, usual, issues);
    return;
  }
  ObjectReader object(*value, "/search", issues);
  file.search.evaluations =
      whole_number(object, "evaluations", 1, kMostEvaluations, issues).value_or(file.search.evaluations);
  file.search.seed = static_cast<std::uint64_t>(whole_number(object, "seed", 0, kLargestSeed, issues).value_or(1));
  spec.objectives = read_objectives(object.find("objectives"), known, usual, issues);
  spec.robust = object.boolean_or("robust", false);
  if (spec.robust && !spec.uncertainty.any())
    issues.add("/search/robust", "true", "something under uncertainty to be robust against");
  object.finish();
}

// A topology: {"features": [...]}; a design file may say more of itself.
feeder::DesignSpec read_design(const Json& value, const std::string& pointer, const std::vector<std::string>& ignored,
                               ReadContext& context, Json& canonical) {
  ObjectReader object(value, pointer, context.issues);
  const Json* features = object.require("features", "an array of features");
  object.ignore(ignored);
  object.finish();
  if (!features) return {};
  return read_features(*features, pointer + "/features", context, canonical["features"]);
}

// The list of topologies; read(value, pointer, canonical) adds one.
template <class Read>
void read_topologies(const Json* topologies, ReadContext& context, const Read& read) {
  if (!topologies) return;
  if (!topologies->is_array() || topologies->empty()) {
    context.issues.add("/topologies", described(*topologies), "an array of designs");
    return;
  }
  for (std::size_t i = 0; i < topologies->size(); ++i)
    read((*topologies)[i], "/topologies/" + std::to_string(i), context.canonical["topologies"][i]);
}

void read_designs(ObjectReader& object, ProblemFile& file, ReadContext& context) {
  const Json* design = object.find("design");
  const Json* topologies = object.find("topologies");
  const Json* grammar = object.find("grammar");
  const int count = (design != nullptr) + (topologies != nullptr) + (grammar != nullptr);
  if (count != 1) {
    if (object.valid())
      context.issues.add("", count == 0 ? "no design" : "more than one of design, topologies and grammar",
                         "exactly one of design, topologies and grammar");
  }
  const auto add = [&](const Json& value, const std::string& pointer, Json& canonical) {
    file.feeder.designs.push_back(read_design(value, pointer, {}, context, canonical));
  };
  if (grammar) file.feeder.grammar = read_grammar(*grammar, context);
  if (design) add(*design, "/design", context.canonical["design"]);
  read_topologies(topologies, context, add);
}

// Designs that are shapes; read(value, pointer) gives one.
template <class Spec, class Read>
void read_shape_designs(ObjectReader& object, Spec& spec, ReadContext& context, const Read& read) {
  const Json* design = object.find("design");
  const Json* topologies = object.find("topologies");
  if (object.find("grammar"))
    context.issues.add("/grammar", "a grammar", "design or topologies: grammars are of tracks");
  else if ((design != nullptr) == (topologies != nullptr))
    context.issues.add("", design ? "both design and topologies" : "no design", "exactly one of design and topologies");
  const auto add = [&](const Json& value, const std::string& pointer, const Json&) {
    spec.designs.push_back(read(value, pointer, std::vector<std::string>{}, context));
  };
  if (design) add(*design, "/design", context.canonical["design"]);
  read_topologies(topologies, context, add);
}

// The names that occur in the strings of a value.
void collect_names(const Json& value, std::set<std::string>& names) {
  if (value.is_string()) {
    const std::string& text = value.get_ref<const std::string&>();
    for (std::size_t i = 0; i < text.size();) {
      std::size_t end = i + 1;
      if (begins_name(text[i])) {
        while (end < text.size() && goes_on_name(text[end])) ++end;
        names.insert(text.substr(i, end - i));
      }
      i = end;
    }
  } else if (value.is_structured()) {
    for (const Json& item : value) collect_names(item, names);
  }
}

// keys: where expressions may stand; of_grammar: the names that a grammar gives.
void check_variables_used(const Json& document, const std::vector<const char*>& keys,
                          const std::vector<Variable>& variables, const std::vector<std::string>& of_grammar,
                          IssueList& issues) {
  std::set<std::string> used;
  for (const char* key : keys) {
    if (document.contains(key)) collect_names(document[key], used);
  }
  used.insert(of_grammar.begin(), of_grammar.end());
  for (const Variable& variable : variables) {
    if (!is_name(variable.name) || used.count(variable.name)) continue;
    const std::string guess = did_you_mean(variable.name, of_grammar);
    issues.add("/variables/" + variable.name, "a variable that nothing uses" + guess,
               of_grammar.empty() ? "one that the designs or the part use"
                                  : "one of the grammar's (" + of_grammar.front() + ", ...) or of the part");
  }
}

void read_kind(ObjectReader& object, ProblemFile& file, IssueList& issues) {
  const std::vector<std::string> known{"feeder", "assembly", "fixture", "pallet"};
  object.require("kind", "one of " + list(known));
  const auto kind = object.string("kind");
  const bool is_known = kind && std::find(known.begin(), known.end(), *kind) != known.end();
  file.kind = is_known ? *kind : "feeder";
  if (kind && !is_known)
    issues.add("/kind", "the unknown kind '" + *kind + "'" + did_you_mean(*kind, known), "one of " + list(known));
  if (file.kind == "assembly") file.assembly.emplace();
  if (file.kind != "fixture" && file.kind != "pallet") return;
  file.nest.emplace();
  file.nest->purpose = file.kind == "pallet" ? nest::Purpose::Pallet : nest::Purpose::Fixture;
}

void read_feeder(ObjectReader& object, const Json& document, ProblemFile& file, ReadContext& context) {
  IssueList& issues = context.issues;
  bool part_is_good = false;
  if (const Json* part = object.require("part", "a part")) {
    const std::size_t before = issues.issues.size();
    file.feeder.part = read_part(*part, context);
    part_is_good = issues.issues.size() == before;
  }
  file.feeder.environment = read_environment(object.find("environment"), context);
  read_designs(object, file, context);
  if (const Json* goal = object.require("goal", "a goal: {\"deliver\": ...}")) {
    const std::size_t before = issues.issues.size();
    file.feeder.goal = read_goal(*goal, file.feeder.part, context);
    if (part_is_good && issues.issues.size() == before) {
      if (const auto found = feeder::goal_defect(file.feeder))
        issues.add("/goal/deliver", (*goal)["deliver"].dump(), *found);
      if (issues.issues.empty()) {
        if (const auto found = feeder::place_references(file.feeder))
          issues.add("/goal/facets/" + std::to_string(found->first), found->second, "a facet at the starting values");
      }
    }
  }
  file.feeder.manufacture = read_manufacture(object.find("manufacture"), context);
  file.feeder.uncertainty = read_uncertainty(object.find("uncertainty"), context);
  read_search(object.find("search"), feeder::known_objectives(), 3, file, file.feeder, issues);
  object.finish();
  std::vector<std::string> of_grammar;
  if (file.feeder.grammar) of_grammar = feeder::variable_names(*file.feeder.grammar);
  check_variables_used(document, {"part", "design", "topologies"}, file.feeder.variables, of_grammar, issues);
  issues.throw_if_any();
  if (file.feeder.grammar) {
    if (!file.feeder.goal.facets.empty())
      issues.add("/goal/facets", "facets on tracks of a grammar, which have none in common", "a goal without facets");
    expand_grammar(file.feeder, issues);
  }
  issues.throw_if_any();
}

void read_assembly(ObjectReader& object, const Json& document, ProblemFile& file, ReadContext& context) {
  IssueList& issues = context.issues;
  assembly::AssemblySpec& spec = *file.assembly;
  if (const Json* part = object.require("part", "a part")) spec.part = read_assembly_part(*part, context);
  read_assembly_environment(object.find("environment"), spec, context);
  read_shape_designs(object, spec, context, read_fixed_shapes);
  if (const Json* goal = object.require("goal", "a goal: {\"depth_mm\", \"lateral_mm\", \"tilt_deg\", ...}"))
    read_assembly_goal(*goal, spec, context);
  read_assembly_uncertainty(object.find("uncertainty"), spec, context);
  read_search(object.find("search"), assembly::known_objectives(), 3, file, spec, issues);
  object.finish();
  check_variables_used(document, {"part", "environment", "design", "topologies"}, spec.variables, {}, issues);
  issues.throw_if_any();
}

void read_nest(ObjectReader& object, const Json& document, ProblemFile& file, ReadContext& context) {
  IssueList& issues = context.issues;
  nest::NestSpec& spec = *file.nest;
  if (const Json* part = object.require("part", "a part")) {
    spec.part = read_part(*part, context, false);
    if (std::any_of(spec.part.aspects.begin(), spec.part.aspects.end(),
                    [](const AspectSpec& aspect) { return !aspect.layers.empty(); }))
      issues.add("/part", "layers", "outlines alone: a nest is planar");
  }
  read_nest_environment(object.find("environment"), spec, context);
  read_shape_designs(object, spec, context, read_nest_shapes);
  if (const Json* goal = object.require("goal", "a goal: {\"seat\": {...}, ...}")) read_nest_goal(*goal, spec, context);
  read_nest_uncertainty(object.find("uncertainty"), spec, context);
  read_search(object.find("search"), nest::known_objectives(spec.purpose), 2, file, spec, issues);
  object.finish();
  check_variables_used(document, {"part", "environment", "design", "topologies", "goal"}, spec.variables, {}, issues);
  issues.throw_if_any();
}

}  // namespace

ProblemFile parse_problem(const std::string& text, const std::string& path) {
  const Json document = parse_json(text, path);
  IssueList issues{path, {}};
  Json canonical = document;
  ProblemFile file;
  file.path = path;
  ObjectReader object(document, "", issues);
  issues.throw_if_any();

  object.require("formotion", "the format's version, 1");
  const auto version = object.number("formotion", kAny);
  if (version && *version != 1)
    issues.add("/formotion", described(document["formotion"]), "1, the only version of the format so far");
  object.require("name", "the problem's name");
  file.name = object.string("name").value_or("");
  if (document.contains("name") && document["name"].is_string() && file.name.empty())
    issues.add("/name", "an empty name", "a name");
  file.slug = slug_of(file.name);
  read_kind(object, file, issues);
  object.ignore({"run"});  // of problem.json in a run's folder: how it was run

  (file.assembly ? file.assembly->variables
   : file.nest   ? file.nest->variables
                 : file.feeder.variables) = read_variables(object.find("variables"), issues);
  ReadContext context{issues, std::filesystem::path(path).parent_path().string(), {}, canonical};
  for (const Variable& variable : variables_of(file)) context.names.push_back(variable.name);

  if (file.assembly) {
    read_assembly(object, document, file, context);
  } else if (file.nest) {
    read_nest(object, document, file, context);
  } else {
    read_feeder(object, document, file, context);
  }
  file.canonical = canonical.dump(2);
  return file;
}

std::span<const Variable> variables_of(const ProblemFile& file) {
  return file.assembly ? file.assembly->variables : file.nest ? file.nest->variables : file.feeder.variables;
}

std::size_t topologies_in(const ProblemFile& file) {
  return file.assembly ? file.assembly->designs.size()
         : file.nest   ? file.nest->designs.size()
                       : file.feeder.designs.size();
}

std::size_t aspects_in(const ProblemFile& file) {
  if (file.assembly) return file.assembly->part.flips ? 2 : 1;
  return (file.nest ? file.nest->part : file.feeder.part).aspects.size();
}

ProblemFile read_problem_file(const std::string& path) { return parse_problem(read_text_file(path), path); }

void apply_design_file(ProblemFile& problem, const std::string& path,
                       std::vector<std::pair<std::string, double>>& values) {
  const Json document = parse_json(read_text_file(path), path);
  IssueList issues{path, {}};
  Json canonical = document;
  ReadContext context{issues, std::filesystem::path(path).parent_path().string(), {}, canonical};
  for (const Variable& variable : variables_of(problem)) context.names.push_back(variable.name);
  // What pareto.json and exports say beside the features or shapes.
  const std::vector<std::string> beside{"id",         "topology", "values",     "metrics", "worst_case",
                                        "provenance", "feasible", "violations", "label"};
  if (problem.assembly) {
    problem.assembly->designs = {read_fixed_shapes(document, "", beside, context)};
  } else if (problem.nest) {
    problem.nest->designs = {read_nest_shapes(document, "", beside, context)};
  } else {
    problem.feeder.designs = {read_design(document, "", beside, context, canonical)};
  }
  if (document.is_object() && document.contains("values")) {
    ObjectReader object(document["values"], "/values", issues);
    for (const std::string& name : context.names) {
      if (const auto value = object.number(name, kAny)) values.emplace_back(name, *value);
    }
    object.finish();
  }
  issues.throw_if_any();
}

}  // namespace formotion
