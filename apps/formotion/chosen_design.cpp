#include "chosen_design.hpp"

#include <charconv>
#include <cmath>

#include "io/input_error.hpp"
#include "io/suggestion.hpp"

namespace formotion {

ProblemFile read_feeder_problem(const std::string& path) {
  ProblemFile file = read_problem_file(path);
  if (file.kind != "feeder")
    throw InputError({{path, "/kind", false, "'" + file.kind + "', which validate alone takes so far", "feeder"}});
  return file;
}

ChosenDesign chosen_design(const DesignChoice& choice) {
  ProblemFile file = read_feeder_problem(choice.problem);
  std::vector<std::pair<std::string, double>> given;
  if (!choice.design.empty()) apply_design_file(file, choice.design, given);

  std::vector<InputIssue> issues;
  std::vector<std::string> names;
  for (const Variable& variable : file.feeder.variables) names.push_back(variable.name);
  for (const std::string& setting : choice.settings) {
    const std::size_t sign = setting.find('=');
    const std::string name = setting.substr(0, sign);
    double value = 0;
    const char* from = setting.data() + (sign == std::string::npos ? setting.size() : sign + 1);
    const char* to = setting.data() + setting.size();
    const auto [end, error] = std::from_chars(from, to, value);
    if (sign == std::string::npos || error != std::errc() || end != to || !std::isfinite(value)) {
      issues.push_back({"--set", "", false, "'" + setting + "'", "NAME=VALUE with a number"});
    } else if (std::find(names.begin(), names.end(), name) == names.end()) {
      issues.push_back({"--set", "", false, "the unknown variable '" + name + "'" + did_you_mean(name, names),
                        "a variable of the problem"});
    } else {
      given.emplace_back(name, value);
    }
  }
  const int topology = choice.topology.value_or(0);
  if (topology >= static_cast<int>(file.feeder.designs.size())) {
    issues.push_back({"--topology", "", false, std::to_string(topology),
                      "a number below " + std::to_string(file.feeder.designs.size())});
  }
  if (!issues.empty()) throw InputError(issues);

  ChosenDesign chosen{file.name, nullptr, topology, {}};
  for (const Variable& variable : file.feeder.variables) chosen.values.push_back(variable.start());
  for (const auto& [name, value] : given) {
    chosen.values[static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin())] = value;
  }
  chosen.problem = std::make_unique<feeder::FeederProblem>(std::move(file.feeder));
  return chosen;
}

}  // namespace formotion
