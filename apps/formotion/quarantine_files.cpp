#include "quarantine_files.hpp"

#include <filesystem>

#include "io/feeder_json.hpp"
#include "problem/staged_problem.hpp"
#include "report/run_files.hpp"

namespace formotion {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostErrors = 100;  // a bug that every candidate meets needs no thousand files

class Files {
 public:
  Files(const std::string& folder, const feeder::FeederProblem& problem)
      : folder_(folder), inside_(fs::path(folder) / "quarantine"), problem_(problem) {}

  void add(const std::string& id, const Subject& subject, Failure failure, const std::string& text, int times) {
    OrderedJson entry{{"id", id}, {"failure", name(failure)}, {"text", text}, {"times", times}};
    if (subject.stage) {
      if (const StagedProblem* stages = problem_.staged())
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
    const std::vector<double> values = problem_.all_values({subject.place, subject.values});
    OrderedJson design{{"id", id}, {"topology", subject.place}};
    design["label"] = problem_.topologies()[static_cast<std::size_t>(subject.place)].label;
    design["features"] = features_json(problem_.literal_design(subject.place, values));
    design["values"] = values_json(problem_, subject.place, values);
    design["provenance"] = text;
    write_file((inside_ / (id + ".json")).string(), design.dump(1) + "\n");
  }

  std::string folder_;
  fs::path inside_;
  const feeder::FeederProblem& problem_;
  OrderedJson list_ = OrderedJson::array();
};

}  // namespace

void write_quarantine(const std::string& folder, const feeder::FeederProblem& problem, const Quarantine& quarantine,
                      const RunState& state) {
  Files files(folder, problem);
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
