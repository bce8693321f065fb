#include "report/front_files.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "optimize/run_store.hpp"
#include "report/report_page.hpp"

namespace formotion {

namespace fs = std::filesystem;

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

std::string pareto_text(const std::string& name, const Problem& problem, const RunSummary& run,
                        nlohmann::ordered_json designs) {
  nlohmann::ordered_json json{{"formotion", 1}, {"problem", name}};
  json["objectives"] = nlohmann::ordered_json::array();
  for (const Objective& objective : problem.objectives()) json["objectives"].push_back(objective.name);
  json["evaluations"] = run.evaluations;
  json["designs"] = std::move(designs);
  return json.dump(1) + "\n";
}

void FrontFiles::pareto(const std::string& name, const Problem& problem, const RunSummary& run,
                        nlohmann::ordered_json designs) {
  write_file((fs::path(folder_) / "pareto.json").string(), pareto_text(name, problem, run, std::move(designs)),
             at_point_);
  const fs::path folder = fs::path(folder_) / "designs";
  std::error_code error;
  fs::remove_all(folder, error);
  reached(at_point_, "files: old designs removed");
  fs::create_directories(folder, error);
  if (error) throw StoreError(folder.string() + ": cannot be made: " + error.message());
}

void FrontFiles::design(const std::string& id, const std::string& format, const std::string& text) {
  write_file((fs::path(folder_) / "designs" / (id + "." + format)).string(), text, at_point_);
}

void FrontFiles::page(const nlohmann::ordered_json& data) {
  write_file((fs::path(folder_) / "report.html").string(), report_page(data), at_point_);
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

std::string scores_csv(const Problem& problem, const RunSummary& run) {
  std::string text = "id,feasible";
  for (const Objective& o : problem.objectives()) text += "," + o.name;
  for (const Variable& v : problem.variables()) text += "," + csv_field(v.name);
  text += "\n";
  for (const Evaluated& design : run.front) {
    text += design_id(design) + (design.score.feasible ? ",true" : ",false");
    for (const double value : design.score.objectives) text += "," + nlohmann::ordered_json(value).dump();
    for (const double value : all_values(problem, design.candidate)) text += "," + nlohmann::ordered_json(value).dump();
    text += "\n";
  }
  return text;
}

}  // namespace formotion
