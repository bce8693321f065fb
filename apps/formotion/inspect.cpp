// status, report and export: what a stored run says.
#include <algorithm>
#include <filesystem>
#include <iostream>

#include "commands.hpp"
#include "io/input_error.hpp"
#include "io/suggestion.hpp"
#include "loaded_run.hpp"
#include "report/report_page.hpp"
#include "report/run_files.hpp"

namespace formotion {

int run_status(const std::string& folder, const std::string& format) {
  const LoadedRun loaded(folder);
  const RunSummary run = loaded.run();
  const std::string phase = run.complete ? "complete" : loaded.store.locked_by_another() ? "running" : "stopped";
  nlohmann::ordered_json json{{"problem", loaded.file.name},
                              {"phase", phase},
                              {"evaluations", run.evaluations},
                              {"budget", run.budget},
                              {"seed", run.seed},
                              {"feasible", run.feasible},
                              {"front", loaded.state.front().members().size()},
                              {"failures", nlohmann::ordered_json::object()},
                              {"best", nlohmann::ordered_json::object()}};
  for (const Failure failure : {Failure::Error, Failure::Crash, Failure::TimeOut}) {
    const auto found = run.failures.find(name(failure));
    json["failures"][name(failure)] = found == run.failures.end() ? 0 : found->second;
  }
  if (!run.history.empty()) {
    const std::vector<double>& best = run.history.back().best;
    for (std::size_t k = 0; k < best.size(); ++k) json["best"][loaded.problem().objectives()[k].name] = best[k];
  }
  if (format == "json") {
    std::cout << json.dump(2) << "\n";
    return kDone;
  }
  std::cout << loaded.file.name << ": " << phase << ", " << run.evaluations << " of " << run.budget << " evaluations, "
            << run.feasible << " feasible, front " << loaded.state.front().members().size() << "\n";
  for (const auto& [name, value] : json["best"].items()) std::cout << "  best " << name << " " << value << "\n";
  for (const auto& [failure, count] : run.failures)
    std::cout << "  failed (" << failure << ") " << count << ", see " << folder << "/quarantine\n";
  if (phase == "stopped") std::cout << "  go on with: formotion resume " << folder << "\n";
  return kDone;
}

namespace {

// InputError unless the objectives are the same.
ComparedRun compared_with(const LoadedRun& loaded, const std::string& folder) {
  const LoadedRun other(folder);
  const auto names = [](const LoadedRun& of) {
    std::string list;
    for (const Objective& o : of.problem().objectives()) list += (list.empty() ? "" : ", ") + o.name;
    return list;
  };
  if (names(loaded) != names(other)) {
    throw InputError({{folder, "", false, "a run with the objectives " + names(other),
                       "one with those of the first run, " + names(loaded)}});
  }
  ComparedRun compared{other.file.name + " in " + folder, {}, other.run()};
  for (const Topology& topology : other.problem().topologies()) compared.labels.push_back(topology.label);
  return compared;
}

}  // namespace

int run_report(const std::string& folder, const std::string& format, const std::string& compare) {
  const LoadedRun loaded(folder);
  const RunSummary run = loaded.run();
  if (!compare.empty()) {
    const ComparedRun other = compared_with(loaded, compare);
    const nlohmann::ordered_json data = loaded.kind->report(run, &other);
    if (format == "json") {
      std::cout << data.dump(1) << "\n";
      return kDone;
    }
    const std::string path = (std::filesystem::path(folder) / "comparison.html").string();
    write_file(path, report_page(data));
    std::cout << path << "\n";
    return kDone;
  }
  if (format == "csv") {
    std::cout << loaded.kind->front_csv(run);
  } else if (format == "json") {
    std::cout << loaded.kind->report(run, nullptr).dump(1) << "\n";
  } else {
    loaded.kind->write_files(folder, run);
    std::cout << (std::filesystem::path(folder) / "report.html").string() << "\n";
  }
  return kDone;
}

int run_export(const std::string& folder, const std::string& design, const std::string& format) {
  const LoadedRun loaded(folder);
  const std::vector<Evaluated>& all = loaded.state.evaluations();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Evaluated& e) { return design_id(e) == design; });
  if (found == all.end()) {
    std::vector<std::string> ids;
    for (const Evaluated& e : loaded.run().front) ids.push_back(design_id(e));
    std::string list;
    for (std::size_t i = 0; i < ids.size() && i < 10; ++i) list += (i ? ", " : "") + ids[i];
    throw InputError({{folder, "", false, "no design '" + design + "'" + did_you_mean(design, ids),
                       "an id of the front: " + list + (ids.size() > 10 ? ", ..." : "")}});
  }
  std::cout << loaded.kind->design_file(*found, format);
  return kDone;
}

}  // namespace formotion
