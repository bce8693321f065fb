#include "quarantine_files.hpp"

#include <filesystem>

#include "problem/staged_problem.hpp"
#include "report/run_files.hpp"

namespace formotion {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostErrors = 100;  // a bug that every candidate meets needs no thousand files

class Files {
 public:
  Files(const std::string& folder, const Kind& kind)
      : folder_(folder), inside_(fs::path(folder) / "quarantine"), kind_(kind) {}

  void add(const std::string& id, const Subject& subject, Failure failure, const std::string& text, int times) {
    nlohmann::ordered_json entry{{"id", id}, {"failure", name(failure)}, {"text", text}, {"times", times}};
    if (subject.stage) {
      if (const StagedProblem* stages = kind_.problem().staged())
        entry["stage"] = stages->kinds()[static_cast<std::size_t>(subject.place)].label;
      entry["values"] = subject.values;
    } else {
      write_design(id, subject, text);
      entry["command"] = "formotion evaluate " + (fs::path(folder_) / "problem.json").string() + " --design " +
                         (inside_ / (id + ".json")).string();
    }
    list_.push_back(std::move(entry));
  }

  void finish() const {
    std::error_code ignored;
    if (list_.empty()) fs::remove_all(inside_, ignored);  // of an earlier run in this folder
    if (list_.empty()) return;
    make_folder();
    write_file((inside_ / "list.json").string(), list_.dump(1) + "\n");
  }

  std::size_t count() const { return list_.size(); }

 private:
  void make_folder() const {
    std::error_code error;
    fs::create_directories(inside_, error);
    if (error) throw StoreError(inside_.string() + ": cannot be made: " + error.message());
  }

  void write_design(const std::string& id, const Subject& subject, const std::string& text) {
    make_folder();
    const std::vector<double> values = all_values(kind_.problem(), {subject.place, subject.values});
    nlohmann::ordered_json design{{"id", id}, {"topology", subject.place}};
    design["label"] = kind_.problem().topologies()[static_cast<std::size_t>(subject.place)].label;
    design.update(kind_.design_keys(subject.place, values));
    design["provenance"] = text;
    write_file((inside_ / (id + ".json")).string(), design.dump(1) + "\n");
  }

  std::string folder_;
  fs::path inside_;
  const Kind& kind_;
  nlohmann::ordered_json list_ = nlohmann::ordered_json::array();
};

}  // namespace

void write_quarantine(const std::string& folder, const Kind& kind, const Quarantine& quarantine,
                      const RunState& state) {
  Files files(folder, kind);
  for (const Incident& incident : quarantine.incidents()) {
    const std::string id = std::string(name(incident.failure)) + "-" + std::to_string(files.count() + 1);
    files.add(id, incident.subject, incident.failure, incident.text, incident.times);
  }
  std::size_t errors = 0;
  for (const Evaluated& e : state.evaluations()) {
    if (e.score.failure != Failure::Error || ++errors > kMostErrors) continue;
    files.add("error-" + design_id(e), {false, e.candidate.topology, e.candidate.values}, Failure::Error,
              e.score.failure_text, 1);
  }
  files.finish();
}

}  // namespace formotion
