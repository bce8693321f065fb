#include "optimize/task_codec.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "toy_problem.hpp"

using namespace formotion;

namespace {

SearchTask filled_task() {
  SearchTask task;
  task.driver = Driver::Listed;
  task.stage = StageAim{3, {1, 2}, {-1}, 0.25};
  task.topology = 2;
  task.evaluations = 123456789012;
  task.seed = 0xfedcba9876543210u;
  task.first_point = 17;
  task.start = Candidate{1, {0.1, -0.0, 5e-324}};
  task.listed = {{0, {1}}, {2, {}}};
  task.step = 0.3;
  task.merit = {1, {std::nullopt, 5.5}, {1, 2}};
  task.provenance = "by hand, \"quoted\"\n\0 and more";
  return task;
}

TaskResult filled_result() {
  TaskResult result;
  Trial& trial = result.trials.emplace_back();
  trial.candidate = {1, {0.1, 1.0 / 3}};
  trial.score = {true, 0.5, {1, 2}, {3}, "gravity", 42};
  trial.score.failure = Failure::Error;
  trial.score.failure_text = "why";
  StageTrial& stage = result.stages.emplace_back();
  stage.kind = 2;
  stage.values = {1.5};
  stage.result = {true, 0.25, {{1, 2, 3}, {kLostState, 4, 5}}, 60, 7};
  stage.demanded = {true, false, true};
  stage.tolerance_mm = 0.75;
  stage.work = 9;
  return result;
}

WorkOrder filled_order() {
  WorkOrder order;
  order.tasks.push_back(filled_task());
  Incident& incident = order.quarantine.emplace_back();
  incident.subject = {true, 4, {2.5}};
  incident.failure = Failure::TimeOut;
  incident.text = "slow";
  incident.times = 2;
  order.candidate_seconds = 600;
  return order;
}

WorkReport filled_report() {
  WorkReport report;
  report.results.push_back(filled_result());
  Incident& incident = report.incidents.emplace_back();
  incident.subject = {false, 1, {0.5}};
  incident.text = "signal 11";
  report.error = "e";
  return report;
}

// Changes a field, looks, and puts it back.
template <class T, class Look, class Change>
void changed(T& field, const Look& look, const Change& change) {
  const T before = field;
  change(field);
  look();
  field = before;
}
template <class T, class Look>
requires std::is_arithmetic_v<T>
void touch(T& field, const Look& look) {
  changed(field, look, [](T& value) { value = static_cast<T>(value == T{} ? 1 : 0); });
}
template <class T, class Look>
requires std::is_enum_v<T>
void touch(T& field, const Look& look) {
  changed(field, look, [](T& value) { value = static_cast<T>(static_cast<int>(value) == 0); });
}
template <class Look>
void touch(std::string& field, const Look& look) {
  changed(field, look, [](std::string& text) { text += "x"; });
}
template <class T, class Look>
void touch(std::vector<T>& field, const Look& look) {
  changed(field, look, [](std::vector<T>& items) { items.emplace_back(); });
}
template <class T, class Look>
void touch(std::optional<T>& field, const Look& look) {
  changed(field, look, [](std::optional<T>& item) { item ? item.reset() : static_cast<void>(item.emplace()); });
}
template <class Look, class... Fields>
void touch_all(const Look& look, Fields&... all) {
  (touch(all, look), ...);
}

}  // namespace

// The structured bindings below do not compile when a struct has got a field that is not named here.
TEST_CASE("no field of a task can change without changing its bytes") {
  WorkOrder order = filled_order();
  const std::string before = encoded(order);
  int looks = 0;
  const auto look = [&] {
    ++looks;
    CHECK(encoded(order) != before);
  };
  SearchTask& task = order.tasks[0];
  {
    auto& [driver, stage, topology, evaluations, seed, first_point, start, listed, step, merit, provenance] = task;
    touch_all(look, driver, stage, topology, evaluations, seed, first_point, start, listed, step, provenance);
    auto& [focus, at_most, scale] = merit;
    touch_all(look, focus, at_most, scale);
    auto& [kind, keep, lose, length_weight] = *stage;
    touch_all(look, kind, keep, lose, length_weight);
    auto& [at, values] = *start;
    touch_all(look, at, values);
  }
  auto& [subject, failure, text, times] = order.quarantine[0];
  touch_all(look, failure, text, times);
  auto& [is_stage, place, values] = subject;
  touch_all(look, is_stage, place, values);
  auto& [tasks, quarantine, candidate_seconds] = order;
  touch_all(look, tasks, quarantine, candidate_seconds);
  CHECK(looks > 25);
  CHECK(encoded(order) == before);
}

TEST_CASE("no field of a result can change without changing its bytes") {
  WorkReport report = filled_report();
  const std::string before = encoded(report);
  const auto look = [&] { CHECK(encoded(report) != before); };
  auto& [candidate, score] = report.results[0].trials[0];
  {
    auto& [topology, values] = candidate;
    touch_all(look, topology, values);
    auto& [feasible, violation, objectives, worst_case, bites, work, failure, failure_text] = score;
    touch_all(look, feasible, violation, objectives, worst_case, bites, work, failure, failure_text);
  }
  auto& [kind, values, result, demanded, tolerance_mm, work] = report.results[0].stages[0];
  touch_all(look, kind, values, demanded, tolerance_mm, work);
  {
    auto& [valid, violation, ends, length_mm, pass_work] = result;
    touch_all(look, valid, violation, ends, length_mm, pass_work);
    auto& [to, nominal_mm, lacking_mm] = ends[1];
    touch_all(look, to, nominal_mm, lacking_mm);
  }
  auto& [trials, stages] = report.results[0];
  touch_all(look, trials, stages);
  auto& [results, incidents, error] = report;
  touch_all(look, results, incidents, error);
  CHECK(encoded(report) == before);
}

TEST_CASE("what is decoded is what was encoded, bit for bit") {
  const std::string order = encoded(filled_order()), report = encoded(filled_report());
  const WorkOrder again = decoded_order(order);
  CHECK(encoded(again) == order);
  CHECK(again.tasks[0].seed == 0xfedcba9876543210u);
  CHECK(std::signbit(again.tasks[0].start->values[1]));
  CHECK(again.tasks[0].start->values[2] == std::numeric_limits<double>::denorm_min());
  CHECK(again.tasks[0].provenance == filled_task().provenance);
  CHECK(again.quarantine[0].subject == Subject{true, 4, {2.5}});
  CHECK(encoded(decoded_report(report)) == report);
  CHECK(decoded_report(report).results[0].stages[0].demanded == StageDemand{true, false, true});
}

TEST_CASE("a task that went through bytes gives the same results as itself") {
  const ToyProblem problem;
  const std::atomic<bool> go_on{false};
  for (const Driver driver : {Driver::Spread, Driver::DirectL, Driver::Crs2, Driver::Sbplx}) {
    SearchTask task;
    task.driver = driver;
    task.topology = 1;
    task.evaluations = 100;
    task.seed = 5;
    task.merit = {0, {std::nullopt, std::nullopt}, {1, 1}};
    WorkOrder order{{task}, {}, 1};
    const WorkReport here{{run_task(problem, task, go_on)}, {}, ""};
    const WorkReport there{{run_task(problem, decoded_order(encoded(order)).tasks[0], go_on)}, {}, ""};
    CHECK(encoded(here) == encoded(there));
  }
}

TEST_CASE("bytes that are cut short or changed anywhere are refused") {
  const std::string good = encoded(filled_report());
  for (std::size_t length = 0; length < good.size(); ++length)
    REQUIRE_THROWS_AS(decoded_report(std::string_view(good).substr(0, length)), DamagedBytes);
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 0x40);
    REQUIRE_THROWS_AS(decoded_report(bad), DamagedBytes);
  }
  CHECK_THROWS_AS(decoded_order(good + "more"), DamagedBytes);
  CHECK_THROWS_AS(decoded_order(good), DamagedBytes);
}
