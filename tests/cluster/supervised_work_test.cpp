#include "cluster/supervised_work.hpp"

#include <signal.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "optimize/toy_problem.hpp"

using namespace formotion;

namespace {

// A toy that does something at x above 9, where one listed candidate is.
class Trapped final : public Problem {
 public:
  explicit Trapped(std::function<void()> act) : act_(std::move(act)) {}
  std::span<const Variable> variables() const override { return toy_.variables(); }
  std::span<const Topology> topologies() const override { return toy_.topologies(); }
  std::span<const Objective> objectives() const override { return toy_.objectives(); }
  Score score(const Candidate& candidate, Memory*) const override {
    if (candidate.values[0] > 9) act_();
    return toy_.score(candidate);
  }

 private:
  ToyProblem toy_;
  std::function<void()> act_;
};

WorkOrder order() {
  WorkOrder result;
  SearchTask& task = result.tasks.emplace_back();
  task.driver = Driver::Listed;
  task.listed = {{0, {1}}, {0, {9.5}}, {0, {2}}};
  task.merit = {0, {std::nullopt, std::nullopt}, {1, 1}};
  result.candidate_seconds = 60;
  return result;
}

const Subject kTrap{false, 0, {9.5}};

WorkReport report_of(const WorkOrder& what, const std::function<void()>& act) {
  return supervised(what, [&] { return std::make_unique<Trapped>(act); });
}

}  // namespace

TEST_CASE("supervised tasks give the results that they give here") {
  const std::atomic<bool> go_on{false};
  WorkReport here;
  here.results.push_back(run_task(ToyProblem(), order().tasks[0], go_on));
  CHECK(encoded(report_of(order(), [] {})) == encoded(here));
}

TEST_CASE("a candidate that ends its process is named, and left out when the quarantine says so") {
  for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL}) {
    const WorkReport report = report_of(order(), [&] { ::raise(signal); });
    CAPTURE(signal, report.error);
    CHECK(report.results.empty());
    REQUIRE(report.incidents.size() == 1);
    CHECK(report.incidents[0].subject == kTrap);
    CHECK(report.incidents[0].failure == Failure::Crash);
    CHECK(report.incidents[0].text == "signal " + std::to_string(signal) + " ended the process that scored it");
  }
  CHECK(report_of(order(), [] { ::_exit(3); }).incidents.at(0).failure == Failure::Crash);

  WorkOrder known = order();
  known.quarantine.push_back({kTrap, Failure::Crash, "known", 1});
  CHECK(report_of(known, [] { std::abort(); }).incidents.size() == 1);  // once is not enough
  known.quarantine[0].times = 2;
  const WorkReport report = report_of(known, [] { std::abort(); });
  CHECK(report.incidents.empty());
  REQUIRE(report.results.size() == 1);
  REQUIRE(report.results[0].trials.size() == 3);
  CHECK(report.results[0].trials[1].score.failure == Failure::Crash);
  CHECK(report.results[0].trials[1].score.failure_text == "known");
  CHECK(report.results[0].trials[2].score.failure == Failure::None);
}

TEST_CASE("a candidate that never ends is given up, one whose process is killed from outside is lost") {
  WorkOrder hasty = order();
  hasty.candidate_seconds = 0.3;
  const WorkReport slow = report_of(hasty, [] {
    for (;;) ::pause();
  });
  REQUIRE(slow.incidents.size() == 1);
  CHECK(slow.incidents[0].subject == kTrap);
  CHECK(slow.incidents[0].failure == Failure::TimeOut);
  CHECK(slow.incidents[0].text == "it took more than 0.3 s");

  const WorkReport lost = report_of(order(), [] { ::kill(::getpid(), SIGKILL); });
  REQUIRE(lost.incidents.size() == 1);
  CHECK(lost.incidents[0].subject == kTrap);
  CHECK(lost.incidents[0].failure == Failure::Lost);
}

TEST_CASE("what goes wrong outside of candidates is said, and nothing is blamed") {
  const WorkReport thrown =
      supervised(order(), []() -> std::unique_ptr<Problem> { throw std::runtime_error("no such problem"); });
  CHECK(thrown.error == "no such problem");
  CHECK(thrown.incidents.empty());
  const WorkReport ended = supervised(order(), []() -> std::unique_ptr<Problem> { std::abort(); });
  CHECK(ended.error == "the process ended outside of any candidate, by signal " + std::to_string(SIGABRT));
  CHECK(ended.incidents.empty());
}
