#include "cluster/local_workers.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "optimize/engine.hpp"

namespace formotion {
namespace {

using namespace std::chrono_literals;

constexpr auto kBetweenStarts = 1s;

// Also true for children that somebody else has waited for (Work Queue waits for any).
bool has_ended(pid_t worker) {
  const pid_t found = ::waitpid(worker, nullptr, WNOHANG);
  return found == worker || (found < 0 && errno == ECHILD);
}

}  // namespace

LocalWorkers::LocalWorkers(int count, std::vector<std::string> command)
    : command_(std::move(command)), workers_(static_cast<std::size_t>(count), 0) {
  for (pid_t& worker : workers_) start(worker);
}

LocalWorkers::~LocalWorkers() {
  for (const pid_t worker : workers_) {
    if (worker != 0) ::kill(worker, SIGTERM);
  }
  // A worker that is asked to end kills its task and removes its files first.
  const auto until = std::chrono::steady_clock::now() + 5s;
  for (const pid_t worker : workers_) {
    if (worker == 0) continue;
    bool ended = has_ended(worker);
    for (; !ended && std::chrono::steady_clock::now() < until; ended = has_ended(worker)) ::usleep(10000);
    if (ended) continue;
    ::kill(worker, SIGKILL);
    ::waitpid(worker, nullptr, 0);
  }
}

void LocalWorkers::look_after() {
  for (pid_t& worker : workers_) {
    if (worker != 0 && has_ended(worker)) worker = 0;
    if (worker == 0 && std::chrono::steady_clock::now() - last_start_ > kBetweenStarts) start(worker);
  }
}

// A pipe that exec closes tells whether it worked: nothing comes, or why not.
void LocalWorkers::start(pid_t& worker) {
  last_start_ = std::chrono::steady_clock::now();
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) throw EngineError(std::string("no pipe: ") + std::strerror(errno));
  const pid_t parent = ::getpid();
  worker = ::fork();
  if (worker == 0) {
    ::setpgid(0, 0);  // Ctrl-C is for the coordinator alone
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != parent) ::_exit(1);
    const int nowhere = ::open("/dev/null", O_RDWR);
    for (int to = 0; to < 3; ++to) ::dup2(nowhere, to);
    std::vector<char*> words;
    for (const std::string& word : command_) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    ::execvp(words[0], words.data());
    const int error = errno;
    (void)!::write(ends[1], &error, sizeof error);
    ::_exit(127);
  }
  ::close(ends[1]);
  int error = worker < 0 ? errno : 0;
  if (worker > 0 && ::read(ends[0], &error, sizeof error) <= 0) error = 0;
  ::close(ends[0]);
  if (error == 0) return;
  if (worker > 0) ::waitpid(worker, nullptr, 0);
  worker = 0;
  throw EngineError(command_[0] + " cannot be started: " + std::strerror(error) +
                    " (it is part of the package coop-computing-tools)");
}

}  // namespace formotion
