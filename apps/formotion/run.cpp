// optimize and resume: a search with progress, that a signal stops cleanly.
#include <atomic>
#include <csignal>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>

#include "cluster/work_queue_engine.hpp"
#include "commands.hpp"
#include "optimize/guarded_problem.hpp"
#include "optimize/run_watch.hpp"
#include "optimize/search.hpp"
#include "progress.hpp"
#include "quarantine_files.hpp"
#include "report/kind.hpp"
#include "report/run_files.hpp"

namespace formotion {
namespace {

constexpr int kWorkQueuePort = 9123;  // as Work Queue's own tools have it

std::atomic<bool> stop_asked{false};

void on_signal(int signal) {
  stop_asked = true;
  std::signal(signal, SIG_DFL);  // a second one ends the process at once
}

std::unique_ptr<Engine> engine_for(const RunOptions& options, const Problem& guarded, const std::string& folder,
                                   Quarantine& quarantine, const std::function<void(const Incident&)>& on_incident,
                                   Progress& progress) {
  if (options.engine == "local") return std::make_unique<LocalEngine>(guarded, options.threads);
  WorkQueueOptions queue;
  queue.program = std::filesystem::read_symlink("/proc/self/exe").string();
  queue.problem_file = (std::filesystem::path(folder) / "problem.json").string();
  queue.folder = folder;
  queue.password_file = options.password_file;
  queue.port = options.port.value_or(options.spawn_local > 0 ? 0 : kWorkQueuePort);
  queue.spawn_local = options.spawn_local;
  queue.chunk = options.chunk;
  queue.candidate_seconds = options.candidate_seconds;
  queue.say = [&progress](const std::string& text) { progress.say(text); };
  return make_work_queue_engine(queue, quarantine, on_incident);
}

int search_and_write(RunStore& store, RunState& state, const Kind& kind, const std::string& folder,
                     const RunOptions& options) {
  const Problem& problem = kind.problem();
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  Progress progress(problem, store.identity().budget, state, options.json_log);
  SearchOptions search_options;
  search_options.budget = {store.identity().budget, store.identity().seed};
  search_options.stop = &stop_asked;
  search_options.after_batch = [&](const RunState& now) { progress.show(now); };
  RunWatch watch(store, folder);
  note_fatal_signals();
  const GuardedProblem guarded(problem, watch.quarantine, &watch.marks);
  write_quarantine(folder, kind, watch.quarantine, state);
  SearchEnd end;
  {
    const auto on_incident = [&](const Incident& incident) {
      store.save(incident);
      write_quarantine(folder, kind, watch.quarantine, state);
    };
    const auto engine = engine_for(options, guarded, folder, watch.quarantine, on_incident, progress);
    end = search(guarded, state, &store, *engine, search_options);
  }
  write_quarantine(folder, kind, watch.quarantine, state);
  if (end == SearchEnd::Stopped) {
    progress.say("stopped after " + std::to_string(state.spent()) + " evaluations; go on with: formotion resume " +
                 folder);
    return kStopped;
  }
  const RunSummary run = summary(state, store.identity(), true);
  kind.write_files(folder, run);
  const bool feasible = run.feasible > 0;
  std::string last = std::to_string(run.evaluations) + " evaluations, " + std::to_string(run.feasible) + " feasible; ";
  last += feasible ? std::to_string(run.front.size()) + " designs on the front"
                   : "no feasible design: the nearest ones and what is wrong with them are in the report";
  if (end == SearchEnd::NothingNew) last += "; ended early, since no new candidate was found";
  progress.say(last);
  progress.say("report: " + (std::filesystem::path(folder) / "report.html").string());
  return feasible ? kDone : kNotFeasible;
}

}  // namespace

int run_optimize(const RunOptions& options) {
  const ProblemFile file = read_problem_file(options.problem);
  const std::unique_ptr<Kind> kind = kind_of(file);
  const std::string folder = options.out.empty() ? default_folder(file) : options.out;
  const RunIdentity identity{file.canonical, options.problem, FORMOTION_VERSION,
                             options.evaluations.value_or(file.search.evaluations),
                             options.seed.value_or(file.search.seed)};
  RunStore store = RunStore::create(folder, identity, options.overwrite);
  write_file((std::filesystem::path(folder) / "problem.json").string(), problem_json_text(file, identity));
  RunState state(kind->problem());
  return search_and_write(store, state, *kind, folder, options);
}

int run_resume(const std::string& folder, const RunOptions& options) {
  RunStore store = RunStore::open_for_writing(folder, FORMOTION_VERSION);
  const ProblemFile file = parse_problem(store.identity().problem_text, store.identity().problem_path);
  const std::unique_ptr<Kind> kind = kind_of(file);
  RunState state(kind->problem());
  store.load(state);
  write_file((std::filesystem::path(folder) / "problem.json").string(), problem_json_text(file, store.identity()));
  return search_and_write(store, state, *kind, folder, options);
}

}  // namespace formotion
