// Scores every design of a run's front again by samples:
//   witness_front PROBLEM.json PARETO.json
// Prints a line for each design; exit code 1 if any disagrees.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <nlohmann/json.hpp>

#include "io/problem_file.hpp"
#include "witness/sampled_track.hpp"

namespace {

using namespace formotion;

// Topologies stand in result files by number or by label.
int topology_of(const nlohmann::json& design, const feeder::FeederProblem& problem) {
  const nlohmann::json& named = design.at("topology");
  if (named.is_number_integer()) return named.get<int>();
  for (std::size_t i = 0; i < problem.topologies().size(); ++i) {
    if (problem.topologies()[i].label == named.get<std::string>()) return static_cast<int>(i);
  }
  throw std::runtime_error("no topology " + named.dump());
}

int compare_front(const char* problem_path, const char* front_path) {
  const feeder::FeederProblem problem(read_problem_file(problem_path).feeder);
  std::ifstream stream(front_path);
  const nlohmann::json front = nlohmann::json::parse(stream);
  int wrong = 0;
  witness::Confirmation total;
  for (const nlohmann::json& design : front.at("designs")) {
    std::vector<double> values;
    for (const Variable& variable : problem.variables()) {
      values.push_back(design.at("values").value(variable.name, variable.start()));
    }
    const witness::Confirmation one = witness::compare(problem, topology_of(design, problem), values);
    std::printf("%s: %s\n", design.at("id").dump().c_str(), one.disagreements.empty() ? "agrees" : "DISAGREES");
    for (const std::string& text : one.disagreements) std::printf("  %s\n", text.c_str());
    wrong += !one.disagreements.empty();
    total.outcomes += one.outcomes;
    total.margins += one.margins;
    total.falls += one.falls;
    total.tolerances += one.tolerances;
  }
  std::printf("%zu designs: %d outcomes, %d margins, %d falls, %d tolerances compared; %d designs disagree\n",
              front.at("designs").size(), total.outcomes, total.margins, total.falls, total.tolerances, wrong);
  return wrong == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: witness_front PROBLEM.json PARETO.json\n");
    return 2;
  }
  try {
    return compare_front(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
