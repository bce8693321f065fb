#include "cluster/supervised_work.hpp"

#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <exception>
#include <sstream>

#include "optimize/guarded_problem.hpp"

namespace formotion {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kLook_ms = 200;  // how often the child's marks are looked at

WorkReport run(const WorkOrder& order, const std::function<std::unique_ptr<Problem>()>& make_problem,
               CrashMarks& marks) {
  WorkReport report;
  try {
    const std::atomic<bool> go_on{false};
    Quarantine quarantine;
    for (const Incident& incident : order.quarantine) quarantine.restore(incident);
    const std::unique_ptr<Problem> problem = make_problem();
    const GuardedProblem guarded(*problem, quarantine, &marks);
    for (const SearchTask& task : order.tasks) report.results.push_back(run_task(guarded, task, go_on));
  } catch (const std::exception& error) {
    report.results.clear();
    report.error = *error.what() ? error.what() : "an error without a text";
  }
  return report;
}

[[noreturn]] void be_the_child(const WorkOrder& order, const std::function<std::unique_ptr<Problem>()>& make_problem,
                               CrashMarks& marks, int to_parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  note_fatal_signals();
  const std::string bytes = encoded(run(order, make_problem, marks));
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t count = ::write(to_parent, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno != EINTR) ::_exit(1);
    if (count > 0) done += static_cast<std::size_t>(count);
  }
  ::_exit(0);
}

// Kills a child that stays at one candidate for too long.
class Stopwatch {
 public:
  Stopwatch(const CrashMarks& marks, double seconds) : marks_(marks), seconds_(seconds) {}
  bool too_long() {
    const std::vector<Mark> now = marks_.marks();
    const std::uint64_t number = now.empty() ? 0 : now.front().number;
    if (number != number_) {
      number_ = number;
      since_ = Clock::now();
    }
    return number != 0 && std::chrono::duration<double>(Clock::now() - since_).count() > seconds_;
  }

 private:
  const CrashMarks& marks_;
  double seconds_;
  std::uint64_t number_ = 0;
  Clock::time_point since_ = Clock::now();
};

std::string text_of(double seconds) {
  std::ostringstream text;
  text << seconds;
  return text.str();
}

}  // namespace

WorkReport supervised(const WorkOrder& order, const std::function<std::unique_ptr<Problem>()>& make_problem) {
  WorkReport report;
  CrashMarks marks;
  int ends[2];
  if (::pipe(ends) != 0) {
    report.error = std::string("no pipe: ") + std::strerror(errno);
    return report;
  }
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(ends[0]);
    be_the_child(order, make_problem, marks, ends[1]);
  }
  ::close(ends[1]);
  std::string bytes;
  bool timed_out = false;
  Stopwatch stopwatch(marks, order.candidate_seconds);
  for (bool open = child > 0; open;) {
    pollfd wanted{ends[0], POLLIN, 0};
    if (::poll(&wanted, 1, kLook_ms) > 0) {
      char buffer[65536];
      const ssize_t count = ::read(ends[0], buffer, sizeof buffer);
      if (count > 0) bytes.append(buffer, static_cast<std::size_t>(count));
      open = count > 0 || (count < 0 && errno == EINTR);
    }
    if (!timed_out && stopwatch.too_long()) {
      timed_out = true;
      ::kill(child, SIGKILL);
    }
  }
  ::close(ends[0]);
  int status = 0;
  if (child < 0 || ::waitpid(child, &status, 0) != child) {
    report.error = std::string("no child process: ") + std::strerror(errno);
    return report;
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return decoded_report(bytes);
  const std::vector<Mark> left = marks.marks();
  if (left.empty()) {
    report.error = "the process ended outside of any candidate, " +
                   (WIFSIGNALED(status) ? "by signal " + std::to_string(WTERMSIG(status))
                                        : "with exit code " + std::to_string(WEXITSTATUS(status)));
    return report;
  }
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  const std::string ended = " ended the process that scored it";
  Incident incident{left.front().subject, Failure::Crash, "signal " + std::to_string(signal) + ended, 1};
  if (timed_out) {
    incident.failure = Failure::TimeOut;
    incident.text = "it took more than " + text_of(order.candidate_seconds) + " s";
  } else if (signal == 0) {
    incident.text = "exit code " + std::to_string(WEXITSTATUS(status)) + ended;
  } else if (left.front().signal == 0) {
    incident.failure = Failure::Lost;
  }
  report.incidents = {incident};
  return report;
}

}  // namespace formotion
