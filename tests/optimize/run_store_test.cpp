#include "optimize/run_store.hpp"

#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <fstream>

#include "local_search.hpp"
#include "optimize/search.hpp"
#include "toy_problem.hpp"

using namespace formotion;
namespace fs = std::filesystem;

namespace {

// A folder of its own that goes with the test.
struct Folder {
  std::string path = (fs::temp_directory_path() / ("formotion_store_" + std::to_string(::getpid()))).string();
  Folder() { fs::remove_all(path); }
  ~Folder() { fs::remove_all(path); }
};

const RunIdentity kIdentity{"{\"a\": 1}", "toy.json", "1.2.3", 3000, 4};

SearchOptions options() {
  SearchOptions result;
  result.budget = {kIdentity.budget, kIdentity.seed};
  return result;
}

// Front and evaluations as text, for comparison.
std::string told(const RunState& state) {
  std::string text;
  for (const Evaluated& e : state.evaluations()) {
    text += std::to_string(e.number) + " " + std::to_string(e.candidate.topology) + " " + e.provenance;
    for (const double v : e.candidate.values) text += " " + std::to_string(std::bit_cast<std::uint64_t>(v));
    for (const double v : e.score.objectives) text += " " + std::to_string(std::bit_cast<std::uint64_t>(v));
    text += "\n";
  }
  for (const Archive::Member& m : state.front().members()) text += std::to_string(m.number) + " ";
  return text;
}

std::string whole_run() {
  const ToyProblem problem;
  RunState state(problem);
  search_here(problem, state, nullptr, options());
  return told(state);
}

std::string stored(const std::string& folder) {
  const ToyProblem problem;
  RunState state(problem);
  RunStore::open_for_reading(folder).load(state);
  return told(state);
}

}  // namespace

TEST_CASE("what is committed is what is loaded, bit for bit") {
  const Folder folder;
  const ToyProblem problem;
  RunState state(problem);
  {
    RunStore store = RunStore::create(folder.path, kIdentity, false);
    search_here(problem, state, &store, options());
  }
  CHECK(stored(folder.path) == told(state));
  const RunStore again = RunStore::open_for_reading(folder.path);
  CHECK(again.complete());
  CHECK(again.identity().problem_text == kIdentity.problem_text);
  CHECK(again.identity().budget == kIdentity.budget);
  CHECK(again.identity().seed == kIdentity.seed);
}

TEST_CASE("killed at any moment, a run goes on and ends with the same bytes: 25 kills") {
  const std::string whole = whole_run();
  const Folder folder;
  const auto go_on = [&] {
    const ToyProblem problem;
    RunState state(problem);
    RunStore store = RunStore::exists(folder.path) ? RunStore::open_for_writing(folder.path, "1.2.3")
                                                   : RunStore::create(folder.path, kIdentity, false);
    store.load(state);
    SearchOptions how = options();
    how.after_batch = [](const RunState&) { ::usleep(1000); };
    search_here(problem, state, &store, how);
  };
  int kills = 0, with_progress = 0;
  double delay_us = 2000;
  std::size_t before = 0;
  for (int round = 0; (kills < 25 || with_progress <= 3) && round < 300; ++round) {
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
      go_on();
      ::_exit(0);
    }
    ::usleep(static_cast<useconds_t>(delay_us));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    kills += WIFSIGNALED(status);
    const std::size_t now = RunStore::exists(folder.path) ? stored(folder.path).size() : 0;
    with_progress += now > before;
    delay_us *= now > before ? 0.8 : 1.4;  // a busy machine needs longer to get anywhere
    before = now;
    if (now == 0 || !RunStore::open_for_reading(folder.path).complete()) continue;
    REQUIRE(stored(folder.path) == whole);
    fs::remove_all(folder.path);
    before = 0;
  }
  CHECK(kills >= 25);
  CHECK(with_progress > 3);
  go_on();
  CHECK(stored(folder.path) == whole);
}

TEST_CASE("a run can be looked at while it is written, and shows whole batches") {
  const Folder folder;
  const ToyProblem problem;
  RunState state(problem);
  RunStore store = RunStore::create(folder.path, kIdentity, false);
  SearchOptions how = options();
  how.after_batch = [&](const RunState& now) {
    RunState seen(problem);
    const RunStore reader = RunStore::open_for_reading(folder.path);
    reader.load(seen);
    REQUIRE(seen.batches() == now.batches());
    REQUIRE(seen.evaluations().size() == now.evaluations().size());
    REQUIRE_FALSE(reader.complete());
    REQUIRE(reader.locked_by_another());
  };
  search_here(problem, state, &store, how);
}

TEST_CASE("a folder with a run is not begun again unless told to, a run that is under way never") {
  const Folder folder;
  {
    const RunStore store = RunStore::create(folder.path, kIdentity, false);
    CHECK_THROWS_AS(RunStore::create(folder.path, kIdentity, true), StoreError);
    CHECK_THROWS_AS(RunStore::open_for_writing(folder.path, "1.2.3"), StoreError);
  }
  CHECK_THROWS_WITH(RunStore::create(folder.path, kIdentity, false), Catch::Contains("holds a run already"));
  CHECK_NOTHROW(RunStore::create(folder.path, kIdentity, true));
}

TEST_CASE("stores that cannot be trusted are refused in words") {
  const Folder folder;
  CHECK_THROWS_WITH(RunStore::open_for_reading(folder.path), Catch::Contains("holds no run"));
  { const RunStore store = RunStore::create(folder.path, kIdentity, false); }
  CHECK_THROWS_WITH(RunStore::open_for_writing(folder.path, "9.9.9"), Catch::Contains("was begun by version 1.2.3"));

  const std::string path = folder.path + "/run.sqlite";
  sqlite3* database = nullptr;
  REQUIRE(sqlite3_open(path.c_str(), &database) == SQLITE_OK);
  REQUIRE(sqlite3_exec(database, "PRAGMA user_version = 77", nullptr, nullptr, nullptr) == SQLITE_OK);
  sqlite3_close(database);
  CHECK_THROWS_WITH(RunStore::open_for_reading(folder.path), Catch::Contains("format is number 77"));

  for (const char* suffix : {"-wal", "-shm"}) fs::remove(path + suffix);
  std::ofstream(path, std::ios::trunc) << "not a database, but long enough to look like one: "
                                       << std::string(4096, 'x');
  CHECK_THROWS_WITH(RunStore::open_for_reading(folder.path), Catch::Contains("damaged"));
}

TEST_CASE("a folder that cannot be made is an error, and nothing is written") {
  const Folder folder;
  std::ofstream(folder.path) << "a file where the folder should be";
  CHECK_THROWS_AS(RunStore::create(folder.path, kIdentity, false), StoreError);
  CHECK(fs::is_regular_file(folder.path));
}
