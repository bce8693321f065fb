#include <filesystem>
#include <iomanip>
#include <sstream>

#include "applications/assembly/assembly_problem.hpp"
#include "io/assembly_json.hpp"
#include "report/joint_data.hpp"
#include "report/joint_drawing.hpp"
#include "report/kind.hpp"
#include "report/report_page.hpp"
#include "report/run_data.hpp"
#include "report/run_files.hpp"

namespace formotion {
namespace {

namespace fs = std::filesystem;

constexpr int kMostSpaces = 6;  // designs in one page with their configuration space

class AssemblyKind final : public Kind {
 public:
  explicit AssemblyKind(ProblemFile file) : file_(std::move(file)), problem_(*file_.assembly) {}

  const Problem& problem() const override { return problem_; }
  OrderedJson design_keys(int topology, std::span<const double> values) const override {
    OrderedJson json = shapes_json(problem_.literal_design(topology, values));
    json["values"] = values_json(problem_, topology, values);
    return json;
  }

  OrderedJson evaluation(int topology, std::span<const double> values) const override {
    OrderedJson json = evaluation_json(problem_, topology, values, problem_.evaluate(topology, values));
    json["topology"] = topology;
    json.update(shapes_json(problem_.literal_design(topology, values)));
    return json;
  }
  std::string drawing(int topology, std::span<const double> values, const std::string& format) const override {
    return drawn(file_.name, topology, values, problem_.evaluate(topology, values), format);
  }

  std::string design_file(const Evaluated& design, const std::string& format) const override {
    const std::vector<double> values = all_values(problem_, design.candidate);
    const int topology = design.candidate.topology;
    const assembly::AssemblyEvaluation evaluation = problem_.evaluate(topology, values);
    if (format != "json") return drawn(title(design), topology, values, evaluation, format);
    return entry(design, values, evaluation).dump(1) + "\n";
  }

  std::string front_csv(const RunSummary& run) const override {
    std::string text = "id,feasible";
    for (const Objective& o : problem_.objectives()) text += "," + o.name;
    for (const Variable& v : problem_.variables()) text += "," + v.name;
    text += "\n";
    for (const Evaluated& design : run.front) {
      text += design_id(design) + (design.score.feasible ? ",true" : ",false");
      for (const double value : design.score.objectives) text += "," + OrderedJson(value).dump();
      for (const double value : all_values(problem_, design.candidate)) text += "," + OrderedJson(value).dump();
      text += "\n";
    }
    return text;
  }

  OrderedJson report(const RunSummary& run, const ComparedRun* other) const override {
    return page(run, other, judged(run));
  }

  void write_files(const std::string& folder, const RunSummary& run) const override {
    const std::vector<Judged> front = judged(run);
    OrderedJson pareto{{"formotion", 1}, {"problem", file_.name}};
    pareto["objectives"] = OrderedJson::array();
    for (const Objective& objective : problem_.objectives()) pareto["objectives"].push_back(objective.name);
    pareto["evaluations"] = run.evaluations;
    pareto["designs"] = OrderedJson::array();
    for (const Judged& one : front) pareto["designs"].push_back(entry(one.design, one.values, one.evaluation));
    write_file((fs::path(folder) / "pareto.json").string(), pareto.dump(1) + "\n");
    const fs::path designs = fs::path(folder) / "designs";
    std::error_code error;
    fs::remove_all(designs, error);
    fs::create_directories(designs, error);
    if (error) throw StoreError(designs.string() + ": cannot be made: " + error.message());
    for (std::size_t i = 0; i < front.size(); ++i) {
      const auto& [design, values, evaluation] = front[i];
      const std::string stem = (designs / design_id(design)).string();
      write_file(stem + ".json", pareto["designs"][i].dump(1) + "\n");
      for (const char* format : {"svg", "dxf"}) {
        write_file(stem + "." + format, drawn(title(design), design.candidate.topology, values, evaluation, format));
      }
    }
    write_file((fs::path(folder) / "report.html").string(), report_page(page(run, nullptr, front)));
  }

 private:
  struct Judged {
    Evaluated design;
    std::vector<double> values;
    assembly::AssemblyEvaluation evaluation;
  };

  std::vector<Judged> judged(const RunSummary& run) const {
    std::vector<Judged> all;
    for (const Evaluated& design : run.front) {
      std::vector<double> values = all_values(problem_, design.candidate);
      assembly::AssemblyEvaluation evaluation = problem_.evaluate(design.candidate.topology, values);
      all.push_back({design, std::move(values), std::move(evaluation)});
    }
    return all;
  }

  std::string title(const Evaluated& design) const { return file_.name + ", design " + design_id(design); }

  std::string drawn(const std::string& title, int topology, std::span<const double> values,
                    const assembly::AssemblyEvaluation& evaluation, const std::string& format) const {
    const assembly::AssemblySpec& spec = problem_.spec();
    const assembly::Joint joint = problem_.joint(topology, values);
    JointDrawing drawing{
        title, joint.fixed_mm, joint.part, joint.centre_mm, spec.approach.direction_rad, spec.goal.depth_mm, {}};
    std::ostringstream share;
    share << "of all starts " << std::fixed << std::setprecision(1) << 100 * evaluation.metrics.success_fraction
          << " % assemble, with " << evaluation.metrics.peak_force_n << " N at most";
    drawing.notes.push_back(share.str());
    if (!evaluation.feasible) drawing.notes.push_back("NOT FEASIBLE: " + evaluation.violations.front().what);
    return format == "svg" ? joint_svg(drawing) : joint_dxf(drawing);
  }

  // A valid design file that also says where it comes from and what it scored.
  OrderedJson entry(const Evaluated& design, const std::vector<double>& values,
                    const assembly::AssemblyEvaluation& evaluation) const {
    const int topology = design.candidate.topology;
    const OrderedJson answer = evaluation_json(problem_, topology, values, evaluation);
    OrderedJson json{{"id", design_id(design)}, {"topology", topology}};
    json["label"] = problem_.topologies()[static_cast<std::size_t>(topology)].label;
    json["feasible"] = answer["feasible"];
    json.update(shapes_json(problem_.literal_design(topology, values)));
    for (const char* key : {"values", "metrics", "worst_case", "violations"}) json[key] = answer[key];
    json["provenance"] = design.provenance;
    return json;
  }

  OrderedJson page(const RunSummary& run, const ComparedRun* other, const std::vector<Judged>& front) const {
    OrderedJson json{{"formotion", 1}, {"program", "formotion " + run.program_version}};
    OrderedJson asked{{"name", file_.name}, {"slug", file_.slug}, {"path", file_.path}, {"kind", file_.kind}};
    std::vector<double> start;
    for (const Variable& v : problem_.variables()) start.push_back(v.start());
    asked["assembly"] = asked_json(problem_.spec(), start);
    asked["uncertainty"] = nullptr;
    add_search_space(asked, file_, problem_, run);
    json["problem"] = std::move(asked);
    add_run(json, problem_, run, other);
    json["designs"] = OrderedJson::array();
    int spaces = 1;  // one is the knee's, which the page opens with
    for (const Judged& one : front) {
      const int topology = one.design.candidate.topology;
      OrderedJson answer = evaluation_json(problem_, topology, one.values, one.evaluation);
      round_all(answer);
      OrderedJson design = design_head(problem_, one.design, run.stamps);
      for (const char* key : {"feasible", "metrics", "worst_case", "violations"}) design[key] = answer[key];
      design["values"] = values_json(problem_, topology, one.values);
      design["shapes"] = shapes_json(problem_.literal_design(topology, one.values));
      const bool is_knee = !json["knee"].is_null() && json["knee"]["id"] == design_id(one.design);
      const bool with_space = is_knee || spaces++ < kMostSpaces;
      design["joint"] = joint_json(problem_, topology, one.values, one.evaluation, with_space);
      design["commands"] = commands_json(file_, design_id(one.design));
      json["designs"].push_back(std::move(design));
    }
    json["parts"] = OrderedJson::array();
    return json;
  }

  ProblemFile file_;
  assembly::AssemblyProblem problem_;
};

}  // namespace

std::unique_ptr<Kind> assembly_kind(ProblemFile file) { return std::make_unique<AssemblyKind>(std::move(file)); }

}  // namespace formotion
