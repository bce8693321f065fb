#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <functional>
#include <iostream>

#include "commands.hpp"
#include "io/input_error.hpp"
#include "io/suggestion.hpp"
#include "optimize/engine.hpp"
#include "optimize/run_store.hpp"

namespace {

using namespace formotion;

void add_run_options(CLI::App& command, RunOptions& options, std::string& log_format) {
  command.add_option("--threads", options.threads, "threads (0: one per core)")->check(CLI::Range(0, 4096));
  command.add_option("--log-format", log_format, "progress on stderr: text or json")
      ->check(CLI::IsMember({"text", "json"}));
  command.add_option("--engine", options.engine, "where designs are scored: local (threads) or work-queue (workers)")
      ->check(CLI::IsMember({"local", "work-queue"}));
  const std::string group = "Work queue";
  command.add_option("--spawn-local", options.spawn_local, "workers to start on this machine (default: 0)")
      ->check(CLI::Range(0, 1000))
      ->group(group);
  command.add_option("--port", options.port, "where workers join (default: 9123; any free one with --spawn-local)")
      ->check(CLI::Range(1, 65535))
      ->group(group);
  command.add_option("--password-file", options.password_file, "what workers must know (default: made in the folder)")
      ->check(CLI::ExistingFile)
      ->group(group);
  command.add_option("--chunk", options.chunk, "search tasks sent together (default: 1)")
      ->check(CLI::Range(1, 10000))
      ->group(group);
  command
      .add_option("--candidate-seconds", options.candidate_seconds,
                  "a design that takes longer is given up after a second try (default: 600)")
      ->check(CLI::Range(0.01, 1e6))
      ->group(group);
}

void add_design_options(CLI::App& command, DesignChoice& choice) {
  command.add_option("problem", choice.problem, "problem file")->required();
  command.add_option("--design", choice.design, "design file: takes the place of the problem's designs");
  command.add_option("--set", choice.settings, "NAME=VALUE: a variable's value")->expected(1)->take_all();
  command.add_option("--topology", choice.topology, "which of the problem's topologies (default: 0)")
      ->check(CLI::Range(0, 1000000));
}

// The error for a first word that is no command, or nothing (CLI11 would call the command missing).
std::string unknown_command(const CLI::App& app, const std::string& word) {
  std::vector<std::string> known;
  for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
  if (word.rfind('-', 0) == 0 || std::find(known.begin(), known.end(), word) != known.end()) return "";
  return "the unknown command '" + word + "'" + did_you_mean(word, known);
}

int usage_error(const CLI::ParseError& error) {
  std::string text = error.what();
  for (char& c : text) {
    if (c == '\n') c = ' ';
  }
  std::cerr << "error: " << text << " (formotion --help lists the commands)\n";
  return kBadInput;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Formotion designs tracks that let one pose of a part through, and joints that go together.\n"
      "Exit codes: 0 done, 2 bad input, 3 no feasible design (or verify found one that fails), 4 stopped by a signal "
      "(resume goes on), 1 a bug.",
      "formotion"};
  app.set_version_flag("--version", "formotion " FORMOTION_VERSION);
  app.require_subcommand(1);

  RunOptions run;
  WorkFiles work;
  VerifyCommand verification;
  DesignChoice choice;
  std::string folder, compared_folder, design_id, status_format = "text", report_format = "html",
                                                  export_format = "json", evaluate_format = "json", log_format = "text";
  bool folder_only = false;
  std::function<int()> command;

  CLI::App* optimize = app.add_subcommand("optimize", "search a problem's designs; writes a run's folder");
  optimize->add_option("problem", run.problem, "problem file")->required();
  optimize->add_option("--out", run.out, "the run's folder (default: results/NAME)");
  optimize->add_option("--evaluations", run.evaluations, "how many designs to score")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{1000000000}));
  optimize->add_option("--seed", run.seed, "seed of the search");
  optimize->add_flag("--overwrite", run.overwrite, "replace a run that is in the folder");
  add_run_options(*optimize, run, log_format);
  optimize->callback([&] { command = [&] { return run_optimize(run); }; });

  CLI::App* resume = app.add_subcommand("resume", "go on with a stopped run");
  resume->add_option("folder", folder, "the run's folder")->required();
  add_run_options(*resume, run, log_format);
  resume->callback([&] { command = [&] { return run_resume(folder, run); }; });

  CLI::App* worker = app.add_subcommand("work", "what a worker runs")->group("");  // hidden: the engine calls it
  worker->add_option("problem", work.problem)->required();
  worker->add_option("order", work.order)->required();
  worker->add_option("report", work.report)->required();
  worker->callback([&] { command = [&] { return run_work(work); }; });

  CLI::App* status = app.add_subcommand("status", "how far a run is, also while it runs");
  status->add_option("folder", folder, "the run's folder")->required();
  status->add_option("--format", status_format, "text or json")->check(CLI::IsMember({"text", "json"}));
  status->callback([&] { command = [&] { return run_status(folder, status_format); }; });

  CLI::App* report = app.add_subcommand("report", "what a run found: writes report.html, or prints json or csv");
  report->add_option("folder", folder, "the run's folder")->required();
  report->add_option("--format", report_format, "html, json or csv")->check(CLI::IsMember({"html", "json", "csv"}));
  report->add_option("--compare", compared_folder, "another run's folder: writes comparison.html (or prints json)");
  report->callback([&] {
    if (!compared_folder.empty() && report_format == "csv")
      throw CLI::ValidationError("--compare", "goes with the formats html and json");
    command = [&] { return run_report(folder, report_format, compared_folder); };
  });

  CLI::App* export_ = app.add_subcommand("export", "print one design of a run as a file");
  export_->add_option("folder", folder, "the run's folder")->required();
  export_->add_option("--design", design_id, "the design's id")->required();
  export_->add_option("--format", export_format, "json, svg, dxf or stl")
      ->check(CLI::IsMember({"json", "svg", "dxf", "stl"}));
  export_->callback([&] { command = [&] { return run_export(folder, design_id, export_format); }; });

  CLI::App* verify =
      app.add_subcommand("verify", "check a run's front again: exactly, finer, with shapes that are off");
  verify->add_option("folder", folder, "the run's folder")->required();
  verify->add_option("--design", verification.designs, "a design's id (default: all of the front)")
      ->expected(1)
      ->take_all();
  verify->add_option("--perturbations", verification.perturbations, "tracks with errors for each design (default: 64)")
      ->check(CLI::Range(0, 1000000));
  verify->add_option("--seed", verification.seed, "seed of these (default: 1)");
  verify->add_option("--threads", verification.threads, "threads (0: one per core)")->check(CLI::Range(0, 4096));
  verify->add_option("--format", verification.format, "text or json")->check(CLI::IsMember({"text", "json"}));
  verify->callback([&] { command = [&] { return run_verify(folder, verification); }; });

  CLI::App* evaluate = app.add_subcommand("evaluate", "score one design: JSON on stdout");
  add_design_options(*evaluate, choice);
  evaluate->add_option("--format", evaluate_format, "json, or the drawing: svg, dxf or stl")
      ->check(CLI::IsMember({"json", "svg", "dxf", "stl"}));
  evaluate->callback([&] { command = [&] { return run_evaluate(choice, evaluate_format); }; });

  CLI::App* query = app.add_subcommand("query", "answer questions about configurations: JSON lines in, JSON lines out");
  add_design_options(*query, choice);
  query->callback([&] { command = [&] { return run_query(choice); }; });

  CLI::App* validate = app.add_subcommand("validate", "check a problem file");
  validate->add_option("problem", run.problem, "problem file")->required();
  validate->add_flag("--folder", folder_only, "print the folder that optimize would use");
  validate->callback([&] { command = [&] { return run_validate(run.problem, folder_only); }; });

  if (const std::string unknown = argc > 1 ? unknown_command(app, argv[1]) : ""; !unknown.empty()) {
    std::cerr << "error: " << unknown << " (formotion --help lists the commands)\n";
    return kBadInput;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp& help) { return app.exit(help); } catch (const CLI::CallForVersion& version) {
    return app.exit(version);
  } catch (const CLI::ParseError& error) { return usage_error(error); }
  run.json_log = log_format == "json";

  try {
    return command();
  } catch (const InputError& error) {
    std::cerr << error.what() << "\n";
    return kBadInput;
  } catch (const StoreError& error) {
    std::cerr << "error: " << error.what() << "\n";
    return kBadInput;
  } catch (const EngineError& error) {
    std::cerr << "error: " << error.what() << "\n";
    return kBadInput;
  } catch (const std::exception& error) {
    std::cerr << "bug: " << error.what() << " (please report it with the problem file)\n";
    return kBug;
  }
}
