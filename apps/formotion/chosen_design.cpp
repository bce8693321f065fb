#include "chosen_design.hpp"

#include <charconv>
#include <cmath>

#include "io/input_error.hpp"
#include "io/suggestion.hpp"

namespace formotion {

ChosenDesign chosen_design(const DesignChoice& choice) {
  ProblemFile file = read_problem_file(choice.problem);
  std::vector<std::pair<std::string, double>> given;
  if (!choice.design.empty()) apply_design_file(file, choice.design, given);

  std::vector<InputIssue> issues;
  std::vector<std::string> names;
  for (const Variable& variable : variables_of(file)) names.push_back(variable.name);
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
  if (topology >= static_cast<int>(topologies_in(file))) {
    issues.push_back(
        {"--topology", "", false, std::to_string(topology), "a number below " + std::to_string(topologies_in(file))});
  }
  if (!issues.empty()) throw InputError(issues);

  ChosenDesign chosen{{}, topology, {}};
  for (const Variable& variable : variables_of(file)) chosen.values.push_back(variable.start());
  for (const auto& [name, value] : given) {
    chosen.values[static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin())] = value;
  }
  chosen.file = std::move(file);
  return chosen;
}

}  // namespace formotion
