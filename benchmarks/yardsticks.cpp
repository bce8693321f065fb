// The program's search beside other methods, at equal work, over many seeds. docs/yardsticks.md explains the table.
#include <time.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <charconv>
#include <cstdio>
#include <fstream>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <thread>

#include "applications/feeder/feeder_problem.hpp"
#include "io/problem_file.hpp"
#include "yardstick_table.hpp"

namespace {

using namespace formotion;
using namespace formotion::bench;

struct Arguments {
  std::vector<std::string> problems;
  int seeds = 20, threads = 1;
  std::int64_t work = 0;
  std::string without, json;
};

double thread_cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Plain threads: each search limits TBB to the thread that it runs on.
void run_all(const std::vector<std::function<void()>>& pieces, int threads) {
  std::atomic<std::size_t> next{0};
  std::vector<std::jthread> pool;
  for (int t = 0; t < threads; ++t) {
    pool.emplace_back([&] {
      for (std::size_t i = next++; i < pieces.size(); i = next++) pieces[i]();
    });
  }
}

void search_all(Comparison& comparison, std::size_t first, std::size_t count, std::int64_t work, int threads) {
  std::vector<std::function<void()>> pieces;
  for (std::size_t m = first; m < first + count; ++m) {
    MethodRuns& method = comparison.methods[m];
    for (std::size_t i = 0; i < method.runs.size(); ++i) {
      pieces.push_back([&comparison, &method, i, work] {
        const double begin = thread_cpu_s();
        method.runs[i] = method.method->search(*comparison.problem, work, comparison.evaluations, i + 1);
        method.runs[i].cpu_s = thread_cpu_s() - begin;
      });
    }
  }
  run_all(pieces, threads);
}

// Where no work is given, the others may do as much as the engine did in its dearest seed.
nlohmann::ordered_json compare(const std::string& argument, const Arguments& arguments) {
  const std::size_t mark = argument.find('=');
  ProblemFile file = read_problem_file(argument.substr(0, mark));
  std::erase_if(file.feeder.objectives,
                [&](const Objective& objective) { return objective.name == arguments.without; });
  if (file.feeder.objectives.empty()) throw std::runtime_error("error: " + argument + ": no objective is left");
  const feeder::FeederProblem problem(file.feeder);
  Comparison comparison{file.name, &problem, arguments.work, file.search.evaluations, {}};
  if (mark != std::string::npos) {
    const char *from = argument.data() + mark + 1, *to = argument.data() + argument.size();
    if (std::from_chars(from, to, comparison.evaluations).ptr != to || comparison.evaluations < 1)
      throw std::runtime_error("error: " + argument + ": after '=' a number of evaluations is expected");
  }
  for (const Method& method : methods())
    comparison.methods.push_back({&method, std::vector<YardstickRun>(static_cast<std::size_t>(arguments.seeds))});
  const std::int64_t most = arguments.work > 0 ? arguments.work : std::numeric_limits<std::int64_t>::max();
  search_all(comparison, 0, 1, most, arguments.threads);
  if (comparison.work == 0) {
    for (const YardstickRun& run : comparison.methods.front().runs)
      comparison.work = std::max(comparison.work, run.work);
  }
  search_all(comparison, 1, comparison.methods.size() - 1, comparison.work, arguments.threads);
  return compared(comparison);
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app{"Compares the search with other methods at equal work"};
  app.add_option("problems", arguments.problems, "problem files; FILE=N: the engine plans with N evaluations")
      ->required();
  app.add_option("--seeds", arguments.seeds, "searches of every method")->check(CLI::PositiveNumber);
  app.add_option("--work", arguments.work, "of every search; default: what the engine's evaluations come to");
  app.add_option("--without", arguments.without, "an objective to leave out");
  app.add_option("--threads", arguments.threads, "searches side by side")->check(CLI::PositiveNumber);
  app.add_option("--json", arguments.json, "file to write");
  CLI11_PARSE(app, argc, argv);
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  try {
    for (const std::string& problem : arguments.problems) {
      all.push_back(compare(problem, arguments));
      std::fputs(as_text(all.back()).c_str(), stdout);
      std::fflush(stdout);
      if (!arguments.json.empty()) std::ofstream(arguments.json) << all.dump(1) << '\n';
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
