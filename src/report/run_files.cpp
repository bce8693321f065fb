#include "report/run_files.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "io/json_document.hpp"
#include "report/report_data.hpp"
#include "report/report_page.hpp"

namespace formotion {
namespace {

namespace fs = std::filesystem;

// A field of a CSV file (RFC 4180).
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

}  // namespace

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

std::string pareto_json_text(const ProblemFile& file, const feeder::FeederProblem& problem, const RunSummary& run,
                             const std::vector<JudgedDesign>& front) {
  OrderedJson json{{"formotion", 1}, {"problem", file.name}};
  json["objectives"] = OrderedJson::array();
  for (const Objective& objective : problem.objectives()) json["objectives"].push_back(objective.name);
  json["evaluations"] = run.evaluations;
  json["designs"] = OrderedJson::array();
  for (const JudgedDesign& design : front) json["designs"].push_back(design_json(problem, design));
  return json.dump(1) + "\n";
}

std::string designs_csv(const feeder::FeederProblem& problem, const std::vector<JudgedDesign>& front) {
  std::string text = "id,topology,feasible";
  const OrderedJson names = metrics_json({});
  for (const auto& [name, value] : names.items()) text += "," + name;
  for (const Variable& variable : problem.variables()) text += "," + quoted(variable.name);
  text += "\n";
  for (const JudgedDesign& design : front) {
    const OrderedJson json = design_json(problem, design);
    text += json["id"].get<std::string>() + "," + quoted(json["label"].get<std::string>()) +
            (design.evaluation.feasible ? ",true" : ",false");
    for (const auto& [name, value] : json["metrics"].items()) text += "," + (value.is_null() ? "" : value.dump());
    for (const Variable& variable : problem.variables()) {
      text += "," + (json["values"].contains(variable.name) ? json["values"][variable.name].dump() : "");
    }
    text += "\n";
  }
  return text;
}

void write_file(const std::string& path, const std::string& text, const NamedPoint& at_point) {
  const std::string fresh = path + ".new";
  reached(at_point, "file: before it");
  std::ofstream stream(fresh, std::ios::binary | std::ios::trunc);
  stream << text;
  stream.close();
  std::error_code error;
  if (!stream) {
    const std::string why = std::strerror(errno);
    fs::remove(fresh, error);
    throw StoreError(path + ": cannot be written: " + why);
  }
  reached(at_point, "file: beside its place");
  fs::rename(fresh, path, error);
  if (error) throw StoreError(path + ": cannot be put in place: " + error.message());
  reached(at_point, "file: in place");
}

void write_run_files(const std::string& folder, const ProblemFile& file, const feeder::FeederProblem& problem,
                     const RunSummary& run, const NamedPoint& at_point) {
  const std::vector<JudgedDesign> front = judged(problem, run.front);
  write_file((fs::path(folder) / "pareto.json").string(), pareto_json_text(file, problem, run, front), at_point);
  const fs::path designs = fs::path(folder) / "designs";
  std::error_code error;
  fs::remove_all(designs, error);
  reached(at_point, "files: old designs removed");
  fs::create_directories(designs, error);
  if (error) throw StoreError(designs.string() + ": cannot be made: " + error.message());
  for (const JudgedDesign& design : front) {
    const std::string stem = (designs / design_id(design.design)).string();
    write_file(stem + ".json", design_json(problem, design).dump(1) + "\n", at_point);
    write_file(stem + ".svg", design_svg(file.name, problem, design), at_point);
    write_file(stem + ".dxf", design_dxf(file.name, problem, design), at_point);
  }
  write_file((fs::path(folder) / "report.html").string(), report_page(report_data(file, problem, run, front)),
             at_point);
}

}  // namespace formotion
