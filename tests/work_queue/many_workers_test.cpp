// Runs on the workers of a Work Queue: the same bytes as on threads, whatever happens to workers and coordinator.
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "command_line/program.hpp"
#include "command_line/run_contents.hpp"

using namespace formotion::program;
namespace fs = std::filesystem;

namespace {

const std::string kEl = shipped("el_bracket.json");

std::vector<std::string> optimize(const std::string& out, const std::string& evaluations,
                                  const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"optimize", kEl, "--evaluations", evaluations, "--out", out};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

std::vector<std::string> on_workers(int count) {
  return {"--engine", "work-queue", "--spawn-local", std::to_string(count)};
}

// The worker processes that were started by this process.
std::vector<pid_t> workers_of(pid_t parent) {
  std::vector<pid_t> found;
  for (const fs::directory_entry& entry : fs::directory_iterator("/proc")) {
    std::ifstream stat(entry.path() / "stat");
    pid_t pid = 0, its_parent = 0;
    std::string name, state;
    if (stat >> pid >> name >> state >> its_parent && its_parent == parent && state != "Z" &&
        name.rfind("(work_queue", 0) == 0)
      found.push_back(pid);
  }
  return found;
}

bool all_gone(const std::vector<pid_t>& processes) {
  for (int i = 0; i < 1000; ++i) {
    bool gone = true;
    for (const pid_t process : processes) {
      std::ifstream stat("/proc/" + std::to_string(process) + "/stat");
      std::string pid, name, state;
      if (stat >> pid >> name >> state && state != "Z") gone = false;
    }
    if (gone) return true;
    ::usleep(10000);
  }
  return false;
}

}  // namespace

TEST_CASE("one thread, two threads, one worker and three workers end with the same bytes") {
  const Folder folder;
  REQUIRE(run(optimize(folder / "t1", "1500", {"--threads", "1"})).code == 0);
  REQUIRE(run(optimize(folder / "t2", "1500", {"--threads", "2"})).code == 0);
  for (const int workers : {1, 3}) {
    std::vector<std::string> more = on_workers(workers);
    if (workers == 3) more.insert(more.end(), {"--chunk", "2"});
    const Said said = run(optimize(folder / "w" + std::to_string(workers), "1500", more));
    CAPTURE(said.err);
    REQUIRE(said.code == 0);
    CHECK(said.err.find(std::to_string(workers) + " workers joined, 0 lost") != std::string::npos);
  }
  for (const char* other : {"t2", "w1", "w3"}) {
    CAPTURE(other);
    CHECK(read_file(folder / "t1/pareto.json") == read_file(folder / other + "/pareto.json"));
    CHECK(run_contents(folder / "t1") == run_contents(folder / other));
  }
  struct stat info {};
  REQUIRE(::stat((folder / "w1/workers.password").c_str(), &info) == 0);
  CHECK((info.st_mode & 0777) == 0600);
  CHECK_FALSE(fs::exists(folder / "w1/reports"));
}

TEST_CASE("workers and coordinators that are killed change nothing but the time: a night in small") {
  const Folder folder;
  const std::string calm = folder / "calm", out = folder / "run";
  REQUIRE(run(optimize(calm, "3000", {})).code == 0);
  const auto seed = static_cast<unsigned>(::getpid());
  CAPTURE(seed);
  std::mt19937 random(seed);
  int killed_workers = 0, killed_coordinators = 0;
  bool ended = false;
  for (int round = 0; round < 4 && !ended; ++round) {
    std::vector<std::string> arguments = on_workers(3);
    if (fs::exists(out + "/run.sqlite")) {
      arguments.insert(arguments.begin(), {"resume", out});
    } else {
      arguments = optimize(out, "3000", arguments);
    }
    Running coordinator(arguments);
    std::vector<pid_t> seen;
    for (int blow = 0; blow < 4 && !coordinator.ended(); ++blow) {
      ::usleep(static_cast<useconds_t>(200000 + random() % 600000));
      seen = workers_of(coordinator.pid());
      if (seen.empty()) continue;
      ::kill(seen[random() % seen.size()], SIGKILL);
      ++killed_workers;
    }
    seen = workers_of(coordinator.pid());
    ended = coordinator.ended();
    if (ended) break;
    ::kill(coordinator.pid(), SIGKILL);
    killed_coordinators += coordinator.finish().code == -SIGKILL;
    CHECK(all_gone(seen));  // nobody's workers end
  }
  CHECK(killed_workers >= 2);
  CHECK(killed_coordinators >= 1);
  std::vector<std::string> last = on_workers(2);
  last.insert(last.begin(), {"resume", out});
  const Said said = run(last);
  CAPTURE(said.err);
  REQUIRE(said.code == 0);
  CHECK(read_file(out + "/pareto.json") == read_file(calm + "/pareto.json"));
  CHECK(run_contents(out) == run_contents(calm));
  CHECK_FALSE(fs::exists(out + "/quarantine"));
}

TEST_CASE("without workers a run says so and how to start one, and a signal ends it and its workers") {
  const Folder folder;
  const std::string out = folder / "run";
  {
    Running alone(
        optimize(out, "3000", {"--engine", "work-queue", "--port", std::to_string(20000 + ::getpid() % 10000)}));
    for (int i = 0; i < 3000 && alone.err().find("no worker is connected") == std::string::npos; ++i) ::usleep(10000);
    CHECK(alone.err().find("work_queue_worker --password " + out + "/workers.password") != std::string::npos);
    ::kill(alone.pid(), SIGTERM);
    CHECK(alone.finish().code == 4);
  }
  std::vector<std::string> arguments = on_workers(2);
  arguments.insert(arguments.begin(), {"resume", out});
  Running busy(arguments);
  std::vector<pid_t> workers;
  for (int i = 0; i < 3000 && workers.size() < 2; ++i) {
    ::usleep(1000);
    workers = workers_of(busy.pid());
  }
  REQUIRE(workers.size() == 2);
  ::kill(busy.pid(), SIGTERM);
  const int code = busy.finish().code;
  CHECK((code == 4 || code == 0));
  CHECK(all_gone(workers));
}

TEST_CASE("what a work queue cannot use is said in one line") {
  const Folder folder;
  write_file(folder / "empty", "");
  const std::string port = std::to_string(30000 + ::getpid() % 2000);
  Running first(optimize(folder / "1", "3000", {"--engine", "work-queue", "--port", port}));
  for (int i = 0; i < 3000 && first.err().find("listening") == std::string::npos; ++i) ::usleep(10000);
  REQUIRE(first.err().find("listening") != std::string::npos);
  const Said second = run(optimize(folder / "2", "3000", {"--engine", "work-queue", "--port", port}));
  CHECK(second.code == 2);
  CHECK(second.err.find("error: port " + port) != std::string::npos);
  const Said unknown = run(optimize(folder / "3", "300", {"--engine", "work-queue", "--password-file", folder / "no"}));
  CHECK(unknown.code == 2);
}

TEST_CASE("a worker's order or problem that cannot be read is an error of the command") {
  const Folder folder;
  write_file(folder / "order", "no order");
  CHECK(run({"work", kEl, folder / "nowhere", folder / "report"}).code == 2);
  CHECK(run({"work", kEl, folder / "order", folder / "report"}).code == 1);
  CHECK_FALSE(fs::exists(folder / "report"));
}
