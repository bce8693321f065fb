// The files of a run, when their writing is ended at any point.
#include "report/run_files.hpp"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>

#include "optimize/search.hpp"

using namespace formotion;
namespace fs = std::filesystem;

namespace {

struct Folder {
  std::string path = (fs::temp_directory_path() / ("formotion_files_" + std::to_string(::getpid()))).string();
  Folder() {
    fs::remove_all(path);
    fs::create_directories(path);
  }
  ~Folder() { fs::remove_all(path); }
};

// Every file of the folder, by its name in it.
std::map<std::string, std::string> contents(const std::string& folder) {
  std::map<std::string, std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream stream(entry.path(), std::ios::binary);
    files[fs::relative(entry.path(), folder).string()] = {std::istreambuf_iterator<char>(stream), {}};
  }
  return files;
}

}  // namespace

TEST_CASE("report files are whole or as before at every kill, and are the same after the next writing") {
  const ProblemFile file = read_problem_file(FORMOTION_SOURCE_DIR "/problems/feeder/el_bracket.json");
  const feeder::FeederProblem problem(file.feeder);
  RunState state(problem);
  LocalEngine engine(problem, 1);
  SearchOptions options;
  options.budget = {300, 1};
  search(problem, state, nullptr, engine, options);
  RunSummary run = summary(state, {file.canonical, file.path, "1.2.3", 300, 1}, true);
  if (run.front.size() > 2) run.front.resize(2);

  std::map<std::string, int> points;
  std::map<std::string, std::string> expected;
  {
    const Folder calm;
    write_run_files(calm.path, file, problem, run, [&](const char* point) { ++points[point]; });
    expected = contents(calm.path);
  }
  REQUIRE(points.size() == 4);
  for (const auto& [point, times] : points) {
    CAPTURE(point);
    const Folder folder;
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
      write_run_files(folder.path, file, problem, run, [&, name = point, left = times](const char* passed) mutable {
        if (passed == name && --left == 0) ::kill(::getpid(), SIGKILL);
      });
      ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    REQUIRE(WIFSIGNALED(status));
    for (const auto& [name, text] : contents(folder.path)) {
      if (name.ends_with(".new")) continue;
      CAPTURE(name);
      REQUIRE(expected.at(name) == text);
    }
    write_run_files(folder.path, file, problem, run);
    REQUIRE(contents(folder.path) == expected);
  }
}
