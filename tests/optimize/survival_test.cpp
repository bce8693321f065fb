// Runs that are ended by kills at named places, and by candidates that crash.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <bit>
#include <catch2/catch.hpp>
#include <filesystem>
#include <functional>
#include <map>
#include <set>

#include "local_search.hpp"
#include "optimize/guarded_problem.hpp"
#include "optimize/run_watch.hpp"
#include "toy_problem.hpp"

using namespace formotion;
namespace fs = std::filesystem;

namespace {

struct Folder {
  std::string path = (fs::temp_directory_path() / ("formotion_survival_" + std::to_string(::getpid()))).string();
  Folder() { fs::remove_all(path); }
  ~Folder() { fs::remove_all(path); }
};

const RunIdentity kIdentity{"{}", "toy.json", "1.2.3", 600, 4};

std::string bits(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) text += " " + std::to_string(std::bit_cast<std::uint64_t>(number));
  return text;
}

// Evaluations and front as text, for comparison.
std::string told(const RunState& state) {
  std::string text;
  for (const Evaluated& e : state.evaluations()) {
    text += std::to_string(e.number) + " " + std::to_string(e.candidate.topology) + " " + e.provenance;
    text += bits(e.candidate.values) + bits(e.score.objectives) + " " + name(e.score.failure) + "\n";
  }
  for (const Archive::Member& m : state.front().members()) text += std::to_string(m.number) + " ";
  return text;
}

std::string stored(const std::string& folder) {
  const ToyProblem problem;
  RunState state(problem);
  RunStore::open_for_reading(folder).load(state);
  return told(state);
}

// A toy that does something at one candidate.
class Trapped final : public Problem {
 public:
  Trapped(Candidate trap, std::function<void()> act) : trap_(std::move(trap)), act_(std::move(act)) {}
  std::span<const Variable> variables() const override { return toy_.variables(); }
  std::span<const Topology> topologies() const override { return toy_.topologies(); }
  std::span<const Objective> objectives() const override { return toy_.objectives(); }
  Score score(const Candidate& candidate, Memory*) const override {
    if (candidate.topology == trap_.topology && candidate.values == trap_.values) act_();
    return toy_.score(candidate);
  }

 private:
  ToyProblem toy_;
  Candidate trap_;
  std::function<void()> act_;
};

// Begins the run in the folder or goes on with it, as the program does.
void go_on(const Problem& problem, const std::string& folder, const NamedPoint& at_point = {}, int threads = 1) {
  RunState state(problem);
  RunStore store = RunStore::exists(folder) ? RunStore::open_for_writing(folder, "1.2.3", at_point)
                                            : RunStore::create(folder, kIdentity, false, at_point);
  store.load(state);
  RunWatch watch(store, folder);
  note_fatal_signals();
  const GuardedProblem guarded(problem, watch.quarantine, &watch.marks);
  SearchOptions how;
  how.budget = {kIdentity.budget, kIdentity.seed};
  how.at_point = at_point;
  search_here(guarded, state, &store, how, threads);
}

// Runs work in a child process; the signal that ended it, or 0.
int signal_of_child(const std::function<void()>& work) {
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL}) ::signal(signal, SIG_DFL);  // not Catch's
    work();
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  if (WIFEXITED(status)) REQUIRE(WEXITSTATUS(status) == 0);
  return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

std::string calm_run(const Problem& problem) {
  RunState state(problem);
  SearchOptions how;
  how.budget = {kIdentity.budget, kIdentity.seed};
  search_here(problem, state, nullptr, how);
  return told(state);
}

// A candidate that a calm run meets late.
Candidate late_candidate() {
  const ToyProblem problem;
  RunState state(problem);
  SearchOptions how;
  how.budget = {kIdentity.budget, kIdentity.seed};
  search_here(problem, state, nullptr, how);
  return state.evaluation(kIdentity.budget - 200).candidate;
}

// What a run ends with when this candidate counts as crashed from the beginning.
std::string run_without(const Candidate& candidate) {
  const ToyProblem problem;
  Quarantine quarantine;
  for (int i = 0; i < Quarantine::kTimes; ++i)
    quarantine.note({false, candidate.topology, candidate.values}, Failure::Crash, "known");
  return calm_run(GuardedProblem(problem, quarantine, nullptr));
}

int overflow_the_stack(int depth) {
  volatile char page[4096];
  page[0] = static_cast<char>(depth);
  return depth < 0 ? 0 : overflow_the_stack(depth + 1) + page[0];
}

}  // namespace

TEST_CASE("killed at any named point, a run goes on and ends with the same bytes") {
  const ToyProblem problem;
  const std::string calm = calm_run(problem);
  std::map<std::string, int> points;  // how often a calm run passes them
  {
    const Folder folder;
    go_on(problem, folder.path, [&](const char* point) { ++points[point]; });
    REQUIRE(stored(folder.path) == calm);
  }
  REQUIRE(points.size() >= 12);
  for (const auto& [point, times] : points) {
    for (const int when : std::set<int>{1, (times + 1) / 2, times}) {
      CAPTURE(point, when);
      const Folder folder;
      const int signal = signal_of_child([&, name = point, left = when]() mutable {
        go_on(problem, folder.path, [&](const char* passed) {
          if (passed == name && --left == 0) ::kill(::getpid(), SIGKILL);
        });
      });
      REQUIRE(signal == SIGKILL);
      if (RunStore::exists(folder.path)) REQUIRE_NOTHROW(stored(folder.path));
      REQUIRE(signal_of_child([&] { go_on(problem, folder.path); }) == 0);
      REQUIRE(stored(folder.path) == calm);
      REQUIRE(RunStore::open_for_reading(folder.path).quarantine().incidents().empty());
    }
  }
}

TEST_CASE("a candidate that crashes twice is left out, and the run ends as if that had been known before") {
  const Candidate trap = late_candidate();
  const std::string expected = run_without(trap);
  const std::vector<std::pair<int, std::function<void()>>> ends{
      {SIGSEGV, [] { ::raise(SIGSEGV); }},
      {SIGSEGV,
       [] {
         volatile int* nowhere = nullptr;
         *nowhere = 1;
       }},
      {SIGSEGV, [] { overflow_the_stack(0); }},
      {SIGABRT, [] { std::abort(); }},
      {SIGABRT, [] { std::terminate(); }},
      {SIGFPE, [] { ::raise(SIGFPE); }},
      {SIGBUS, [] { ::raise(SIGBUS); }},
      {SIGILL, [] { __builtin_trap(); }},
  };
  for (const int threads : {1, 3}) {
    for (std::size_t i = 0; i < (threads == 1 ? ends.size() : 2); ++i) {
      CAPTURE(i, threads);
      const Folder folder;
      const Trapped problem(trap, ends[i].second);
      const auto run = [&] { go_on(problem, folder.path, {}, threads); };
      for (int time = 1; time <= Quarantine::kTimes; ++time) REQUIRE(signal_of_child(run) == ends[i].first);
      REQUIRE(signal_of_child(run) == 0);
      CHECK(stored(folder.path) == expected);
      const Quarantine quarantine = RunStore::open_for_reading(folder.path).quarantine();
      REQUIRE(quarantine.incidents().size() == 1);
      CHECK(quarantine.incidents()[0].subject == Subject{false, trap.topology, trap.values});
      CHECK(quarantine.incidents()[0].times == 2);
      CHECK(quarantine.incidents()[0].text ==
            "signal " + std::to_string(ends[i].first) + " ended the process that scored it");
    }
  }
}

TEST_CASE("killed while crash notes are taken in, a run takes each of them in once") {
  const Candidate trap = late_candidate();
  const Trapped problem(trap, [] { std::abort(); });
  for (const std::string point : {"generation: before it", "generation: all written", "generation: done"}) {
    CAPTURE(point);
    const Folder folder;
    REQUIRE(signal_of_child([&] { go_on(problem, folder.path); }) == SIGABRT);
    for (int kill = 0; kill < 3; ++kill) {
      const int signal = signal_of_child([&] {
        go_on(problem, folder.path, [&](const char* passed) {
          if (passed == point) ::kill(::getpid(), SIGKILL);
        });
      });
      REQUIRE(signal == SIGKILL);
    }
    REQUIRE(signal_of_child([&] { go_on(problem, folder.path); }) == SIGABRT);
    REQUIRE(signal_of_child([&] { go_on(problem, folder.path); }) == 0);
    CHECK(RunStore::open_for_reading(folder.path).quarantine().incidents()[0].times == 2);
  }
}

TEST_CASE("signals from outside never count against the candidate that was being scored") {
  const Candidate trap = late_candidate();
  for (const int signal : {SIGKILL, SIGTERM, SIGSEGV, SIGABRT}) {
    const Folder folder;
    const Trapped waits(trap, [] { ::pause(); });
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
      for (const int s : {SIGSEGV, SIGABRT, SIGTERM}) ::signal(s, SIG_DFL);
      go_on(waits, folder.path);
      ::_exit(0);
    }
    // Until it waits at the trap: the store then holds the batches before and its marks say so.
    for (int i = 0; i < 1000; ++i) {
      ::usleep(10000);
      char state = 0;
      FILE* stat = std::fopen(("/proc/" + std::to_string(child) + "/stat").c_str(), "r");
      REQUIRE(stat);
      const int read = std::fscanf(stat, "%*d %*s %c", &state);
      std::fclose(stat);
      if (read == 1 && state == 'S' && RunStore::exists(folder.path) && stored(folder.path).size() > 1000) break;
    }
    ::kill(child, signal);
    int status = 0;
    ::waitpid(child, &status, 0);
    REQUIRE(WIFSIGNALED(status));
    REQUIRE(signal_of_child([&] { go_on(ToyProblem(), folder.path); }) == 0);
    CHECK(RunStore::open_for_reading(folder.path).quarantine().incidents().empty());
    CHECK(stored(folder.path) == calm_run(ToyProblem()));
  }
}

TEST_CASE("a candidate whose scoring throws is a failed design, and the run goes on") {
  const Candidate trap = late_candidate();
  const Trapped problem(trap, [] { throw std::logic_error("a bug"); });
  const Folder folder;
  go_on(problem, folder.path);
  RunState state(problem);
  const RunStore store = RunStore::open_for_reading(folder.path);
  store.load(state);
  const Score* score = state.find(trap);
  REQUIRE(score);
  CHECK(score->failure == Failure::Error);
  CHECK(score->failure_text == "a bug");
  CHECK_FALSE(score->feasible);
  CHECK(summary(state, store.identity(), true).failures == std::map<std::string, std::int64_t>{{"error", 1}});
}
