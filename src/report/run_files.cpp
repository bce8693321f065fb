#include "report/run_files.hpp"

#include "io/json_document.hpp"
#include "report/report_data.hpp"

namespace formotion {
std::string problem_json_text(const ProblemFile& file, const RunIdentity& identity) {
  OrderedJson json = parse_json(identity.problem_text, file.path);
  json["search"]["evaluations"] = identity.budget;
  json["search"]["seed"] = identity.seed;
  json["run"] = {{"program", "formotion " + identity.program_version},
                 {"problem", identity.problem_path},
                 {"evaluations", identity.budget},
                 {"seed", identity.seed}};
  return json.dump(2) + "\n";
}

std::string designs_csv(const feeder::FeederProblem& problem, const std::vector<JudgedDesign>& front) {
  std::string text = "id,topology,feasible";
  const OrderedJson names = metrics_json({});
  for (const auto& [name, value] : names.items()) text += "," + name;
  for (const Variable& variable : problem.variables()) text += "," + csv_field(variable.name);
  text += "\n";
  for (const JudgedDesign& design : front) {
    const OrderedJson json = design_json(problem, design);
    text += json["id"].get<std::string>() + "," + csv_field(json["label"].get<std::string>()) +
            (design.evaluation.feasible ? ",true" : ",false");
    for (const auto& [name, value] : json["metrics"].items()) text += "," + (value.is_null() ? "" : value.dump());
    for (const Variable& variable : problem.variables()) {
      text += "," + (json["values"].contains(variable.name) ? json["values"][variable.name].dump() : "");
    }
    text += "\n";
  }
  return text;
}

void write_run_files(const std::string& folder, const ProblemFile& file, const feeder::FeederProblem& problem,
                     const RunSummary& run, const NamedPoint& at_point) {
  const std::vector<JudgedDesign> front = judged(problem, run.front);
  FrontFiles files(folder, at_point);
  OrderedJson entries = OrderedJson::array();
  for (const JudgedDesign& design : front) entries.push_back(design_json(problem, design));
  files.pareto(file.name, problem, run, std::move(entries));
  for (const JudgedDesign& design : front) {
    const std::string id = design_id(design.design);
    files.design(id, "json", design_json(problem, design).dump(1) + "\n");
    files.design(id, "svg", design_svg(file.name, problem, design));
    files.design(id, "dxf", design_dxf(file.name, problem, design));
    files.design(id, "stl", design_stl(file.name, problem, design));
  }
  files.page(report_data(file, problem, run, front));
}

}  // namespace formotion
