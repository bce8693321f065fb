// The Work Queue engine with tasks that go wrong at one candidate.
#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

#include "cluster/work_queue_engine.hpp"
#include "command_line/program.hpp"
#include "optimize/guarded_problem.hpp"
#include "optimize/task_codec.hpp"
#include "work_queue/trapped_problem.hpp"

using namespace formotion;

namespace {

// Two ordinary tasks, and one that meets the trap.
std::vector<SearchTask> tasks() {
  std::vector<SearchTask> all(3);
  for (SearchTask& task : all) {
    task.topology = 1;
    task.evaluations = 20;
    task.merit = {0, {std::nullopt, std::nullopt}, {1, 1}};
  }
  all[0].seed = 7;
  all[1].driver = Driver::Listed;
  all[1].topology = 0;
  all[1].listed = {{0, {1}}, kTrap, {0, {2}}};
  return all;
}

struct Outcome {
  std::string bytes;  // of all results
  std::vector<Incident> incidents;
  std::string said;
};

Outcome on_workers(const std::string& act, double candidate_seconds, const std::atomic<bool>& stop) {
  const program::Folder folder;
  program::write_file(folder / "problem.json", act);
  Outcome outcome;
  WorkQueueOptions options;
  options.program = FORMOTION_TRAPPED_WORKER;
  options.problem_file = folder / "problem.json";
  options.folder = folder.path;
  options.spawn_local = 2;
  options.candidate_seconds = candidate_seconds;
  options.say = [&](const std::string& text) { outcome.said += text + "\n"; };
  Quarantine quarantine;
  const auto engine = make_work_queue_engine(options, quarantine,
                                             [&](const Incident& incident) { outcome.incidents.push_back(incident); });
  WorkReport all;
  all.results = engine->run(tasks(), stop);
  outcome.bytes = encoded(all);
  return outcome;
}

// The same on this thread, with the trap known to fail like this.
std::string here(Failure failure, const std::string& text) {
  Quarantine quarantine;
  for (int i = 0; i < Quarantine::kTimes; ++i) quarantine.note({false, kTrap.topology, kTrap.values}, failure, text);
  const TrappedProblem problem("crash");
  const GuardedProblem guarded(problem, quarantine, nullptr);
  const std::atomic<bool> go_on{false};
  WorkReport all;
  for (const SearchTask& task : tasks()) all.results.push_back(run_task(guarded, task, go_on));
  return encoded(all);
}

const std::atomic<bool> kGoOn{false};

}  // namespace

TEST_CASE("a candidate that crashes its worker twice is left out, and all else is as it would have been") {
  const Outcome outcome = on_workers("crash", 60, kGoOn);
  REQUIRE(outcome.incidents.size() == 2);
  CHECK(outcome.incidents[1].subject == Subject{false, kTrap.topology, kTrap.values});
  CHECK(outcome.incidents[1].failure == Failure::Crash);
  CHECK(outcome.incidents[1].times == 2);
  CHECK(outcome.said.find("it is tried once more") != std::string::npos);
  CHECK(outcome.bytes == here(Failure::Crash, "signal 11 ended the process that scored it"));
}

TEST_CASE("a candidate that takes too long twice is left out") {
  const Outcome outcome = on_workers("hang", 0.3, kGoOn);
  REQUIRE(outcome.incidents.size() == 2);
  CHECK(outcome.incidents[1].failure == Failure::TimeOut);
  CHECK(outcome.bytes == here(Failure::TimeOut, "it took more than 0.3 s"));
}

TEST_CASE("a candidate whose process is killed again and again is left out") {
  const Outcome outcome = on_workers("kill", 60, kGoOn);
  REQUIRE(outcome.incidents.size() == 1);
  CHECK(outcome.incidents[0].failure == Failure::Crash);
  CHECK(outcome.bytes == here(Failure::Crash, "the process that scored it was killed 5 times, perhaps for its memory"));
}

TEST_CASE("a program that does not run on the workers ends the search in one line") {
  CHECK_THROWS_WITH(on_workers("refuse", 60, kGoOn),
                    Catch::Contains("tasks cannot be run") && Catch::Contains("exit code 5"));
}

TEST_CASE("a search that is told to stop does not wait for tasks") {
  std::atomic<bool> stop{false};
  std::thread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    stop = true;
  });
  CHECK_THROWS_AS(on_workers("hang", 600, stop), SearchStopped);
  later.join();
}
