// What a task costs on a Work Queue beside its own work: tasks of one design each, as fast as they go.
//   bench_work_queue PROGRAM PROBLEM.json [TASKS] [WORKERS] [CHUNK]
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "applications/feeder/feeder_problem.hpp"
#include "cluster/work_queue_engine.hpp"
#include "io/problem_file.hpp"
#include "optimize/task_codec.hpp"

namespace {

using namespace formotion;

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

// Processor time of this process alone: the coordinator.
double own_seconds() {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: bench_work_queue PROGRAM PROBLEM.json [TASKS] [WORKERS] [CHUNK]\n");
    return 2;
  }
  const auto number = [&](int at, int otherwise) { return argc > at ? std::atoi(argv[at]) : otherwise; };
  const int count = number(3, 300), workers = number(4, 1), chunk = number(5, 1);
  const feeder::FeederProblem problem(read_problem_file(argv[2]).feeder);
  std::vector<SearchTask> tasks;
  for (int i = 0; i < count; ++i) {
    SearchTask& task = tasks.emplace_back();
    task.evaluations = 1;
    task.first_point = static_cast<std::uint64_t>(i);
    task.merit = {0, std::vector<std::optional<double>>(problem.objectives().size()),
                  std::vector<double>(problem.objectives().size(), 1)};
  }
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "formotion_bench_work_queue";
  std::filesystem::create_directories(folder);
  WorkQueueOptions options;
  options.program = std::filesystem::absolute(argv[1]).string();
  options.problem_file = std::filesystem::absolute(argv[2]).string();
  options.folder = folder.string();
  options.spawn_local = workers;
  options.chunk = chunk;
  options.candidate_seconds = 600;
  options.say = [](const std::string& text) { std::fprintf(stderr, "%s\n", text.c_str()); };
  Quarantine quarantine;
  const std::atomic<bool> go_on{false};
  {
    const auto engine = make_work_queue_engine(options, quarantine, [](const Incident&) {});
    engine->run({tasks.front()}, go_on);  // the program and the problem arrive at one worker at least
    const double cpu = own_seconds();
    const auto begin = std::chrono::steady_clock::now();
    engine->run(tasks, go_on);
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const double pieces = static_cast<double>((count + chunk - 1) / chunk);
    std::printf("%d tasks in pieces of %d on %d workers: %.2f s, %.0f pieces/s, %.2f ms of the coordinator a piece\n",
                count, chunk, workers, wall, pieces / wall, 1000 * (own_seconds() - cpu) / pieces);
  }
  for (const int designs : {1, 150}) {
    SearchTask task = tasks.front();
    task.evaluations = designs;
    WorkReport report;
    report.results.push_back(run_task(problem, task, go_on));
    std::printf("a task of %d designs: %zu bytes to the worker, %zu bytes back\n", designs,
                encoded(WorkOrder{{task}, {}, 600}).size(), encoded(report).size());
  }
  std::filesystem::remove_all(folder);
}
