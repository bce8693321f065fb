// The kinds whose designs are shapes: what their files and pages have in common.
#pragma once

#include "report/front_files.hpp"
#include "report/kind.hpp"
#include "report/run_data.hpp"

namespace formotion {

// P: the application's problem, with evaluate and literal_design; evaluation_json, shapes_json and values_json of io.
template <class P>
class ShapesKind : public Kind {
 public:
  using Json = nlohmann::ordered_json;
  using Evaluation = decltype(std::declval<P>().evaluate(0, {}));

  template <class Spec>
  ShapesKind(ProblemFile file, const Spec& spec) : file_(std::move(file)), problem_(spec) {}

  const P& problem() const override { return problem_; }
  Json design_keys(int topology, std::span<const double> values) const override {
    Json json = shapes_json(problem_.literal_design(topology, values));
    json["values"] = values_json(problem_, topology, values);
    return json;
  }
  Json evaluation(int topology, std::span<const double> values) const override {
    Json json = evaluation_json(problem_, topology, values, problem_.evaluate(topology, values));
    json["topology"] = topology;
    json.update(shapes_json(problem_.literal_design(topology, values)));
    return json;
  }
  std::string drawing(int topology, std::span<const double> values, const std::string& format) const override {
    return drawn(file_.name, topology, values, problem_.evaluate(topology, values), format);
  }

  std::string design_file(const Evaluated& design, const std::string& format) const override {
    return text_of(judged(design), format);
  }
  std::string front_csv(const RunSummary& run) const override { return scores_csv(problem_, run); }
  Json report(const RunSummary& run, const ComparedRun* other) const override { return page(run, other, judged(run)); }
  void write_files(const std::string& folder, const RunSummary& run) const override {
    const std::vector<Judged> front = judged(run);
    FrontFiles files(folder);
    Json entries = Json::array();
    for (const Judged& one : front) entries.push_back(entry(one));
    files.pareto(file_.name, problem_, run, std::move(entries));
    for (const Judged& one : front) {
      for (const char* format : {"json", "svg", "dxf", "stl"})
        files.design(design_id(one.design), format, text_of(one, format));
    }
    files.page(page(run, nullptr, front));
  }

 protected:
  struct Judged {
    Evaluated design;
    std::vector<double> values;
    Evaluation evaluation;
  };

  const ProblemFile& file() const { return file_; }

  // A drawing; format: svg, dxf or stl.
  virtual std::string drawn(const std::string& title, int topology, std::span<const double> values,
                            const Evaluation& evaluation, const std::string& format) const = 0;
  // Into the page's `problem`: what was asked for. values: the variables' starting values.
  virtual void add_asked(Json& asked, std::span<const double> values) const = 0;
  // Into a design of the page: its picture. order: 0 for the knee, then 1, 2, ...: pages hold large ones of few.
  virtual void add_picture(Json& design, const Judged& judged, int order) const = 0;

 private:
  Judged judged(const Evaluated& design) const {
    std::vector<double> values = all_values(problem_, design.candidate);
    Evaluation evaluation = problem_.evaluate(design.candidate.topology, values);
    return {design, std::move(values), std::move(evaluation)};
  }
  std::vector<Judged> judged(const RunSummary& run) const {
    std::vector<Judged> all;
    for (const Evaluated& design : run.front) all.push_back(judged(design));
    return all;
  }

  std::string text_of(const Judged& one, const std::string& format) const {
    if (format == "json") return entry(one).dump(1) + "\n";
    return drawn(file_.name + ", design " + design_id(one.design), one.design.candidate.topology, one.values,
                 one.evaluation, format);
  }

  // A valid design file that also says where it comes from and what it scored.
  Json entry(const Judged& one) const {
    const int topology = one.design.candidate.topology;
    const Json answer = evaluation_json(problem_, topology, one.values, one.evaluation);
    Json json{{"id", design_id(one.design)}, {"topology", topology}};
    json["label"] = problem_.topologies()[static_cast<std::size_t>(topology)].label;
    json["feasible"] = answer["feasible"];
    json.update(shapes_json(problem_.literal_design(topology, one.values)));
    for (const char* key : {"values", "metrics", "worst_case", "violations"}) json[key] = answer[key];
    json["provenance"] = one.design.provenance;
    return json;
  }

  Json page(const RunSummary& run, const ComparedRun* other, const std::vector<Judged>& front) const {
    Json json{{"formotion", 1}, {"program", "formotion " + run.program_version}};
    Json asked{{"name", file_.name}, {"slug", file_.slug}, {"path", file_.path}, {"kind", file_.kind}};
    std::vector<double> start;
    for (const Variable& v : problem_.variables()) start.push_back(v.start());
    add_asked(asked, start);
    asked["uncertainty"] = nullptr;
    add_search_space(asked, file_, problem_, run);
    json["problem"] = std::move(asked);
    add_run(json, problem_, run, other);
    json["designs"] = Json::array();
    int order = 1;
    for (const Judged& one : front) {
      const int topology = one.design.candidate.topology;
      Json answer = evaluation_json(problem_, topology, one.values, one.evaluation);
      round_all(answer);
      Json design = design_head(problem_, one.design, run.stamps);
      for (const char* key : {"feasible", "metrics", "worst_case", "violations"}) design[key] = answer[key];
      design["values"] = values_json(problem_, topology, one.values);
      design["shapes"] = shapes_json(problem_.literal_design(topology, one.values));
      const bool is_knee = !json["knee"].is_null() && json["knee"]["id"] == design_id(one.design);
      add_picture(design, one, is_knee ? 0 : order++);
      design["commands"] = commands_json(file_, design_id(one.design));
      json["designs"].push_back(std::move(design));
    }
    json["parts"] = Json::array();
    return json;
  }

  ProblemFile file_;
  P problem_;
};

}  // namespace formotion
