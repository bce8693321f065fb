#include "applications/feeder/feeder_problem.hpp"
#include "io/feeder_json.hpp"
#include "report/design_files.hpp"
#include "report/kind.hpp"
#include "report/report_data.hpp"
#include "report/run_files.hpp"

namespace formotion {
namespace {

class FeederKind final : public Kind {
 public:
  explicit FeederKind(ProblemFile file) : file_(std::move(file)), problem_(file_.feeder) {}

  const Problem& problem() const override { return problem_; }
  OrderedJson design_keys(int topology, std::span<const double> values) const override {
    OrderedJson json;
    json["features"] = features_json(problem_.literal_design(topology, values));
    json["values"] = values_json(problem_, topology, values);
    return json;
  }

  OrderedJson evaluation(int topology, std::span<const double> values) const override {
    OrderedJson json = evaluation_json(problem_, topology, values, problem_.evaluate(topology, values));
    if (const auto limits = feeder::uncertainty_limits(problem_, topology, values))
      json["uncertainty"] = limits_json(*limits);
    json["topology"] = topology;
    json["features"] = features_json(problem_.literal_design(topology, values));
    return json;
  }
  std::string drawing(int topology, std::span<const double> values, const std::string& format) const override {
    JudgedDesign judged{{}, {values.begin(), values.end()}, problem_.evaluate(topology, values)};
    judged.design.candidate.topology = topology;
    return drawn(judged, format);
  }

  std::string design_file(const Evaluated& design, const std::string& format) const override {
    const JudgedDesign chosen = judged(problem_, design);
    return format == "json" ? design_json(problem_, chosen).dump(1) + "\n" : drawn(chosen, format);
  }
  std::string front_csv(const RunSummary& run) const override {
    return designs_csv(problem_, judged(problem_, run.front));
  }
  OrderedJson report(const RunSummary& run, const ComparedRun* other) const override {
    return report_data(file_, problem_, run, judged(problem_, run.front), other);
  }
  void write_files(const std::string& folder, const RunSummary& run) const override {
    write_run_files(folder, file_, problem_, run);
  }

 private:
  std::string drawn(const JudgedDesign& judged, const std::string& format) const {
    const auto draw = format == "svg" ? design_svg : format == "dxf" ? design_dxf : design_stl;
    return draw(file_.name, problem_, judged);
  }

  ProblemFile file_;
  feeder::FeederProblem problem_;
};

}  // namespace

std::unique_ptr<Kind> feeder_kind(ProblemFile file) { return std::make_unique<FeederKind>(std::move(file)); }

}  // namespace formotion
