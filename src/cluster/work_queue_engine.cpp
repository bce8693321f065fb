#include "cluster/work_queue_engine.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>

#include "cluster/local_workers.hpp"
#include "cluster/password_file.hpp"
#include "optimize/task_codec.hpp"

extern "C" {
#include <work_queue.h>
}

namespace formotion {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr int kMostFailures = 3;     // of one piece that does not run at all: then something is wrong with the program
constexpr int kMostLosses = 5;       // of one candidate whose process was killed from outside each time
constexpr auto kPatience = 5s;       // without workers, until the user is told, and told again
constexpr double kKeepalive_s = 30;  // a machine that vanished is noticed after twice this time

// Search tasks that travel together.
struct Piece {
  std::size_t first = 0, count = 0;
  int failures = 0;  // times that it came back without a report
};

std::string whole_file(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string one_line(const char* text) {
  std::string line = text ? text : "";
  for (char& c : line) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  return line.substr(0, 300);
}

std::string host_name() {
  char name[256] = "";
  return ::gethostname(name, sizeof name - 1) == 0 ? name : "localhost";
}

class WorkQueueEngine final : public Engine {
 public:
  WorkQueueEngine(const WorkQueueOptions& how, Quarantine& known, const std::function<void(const Incident&)>& tell)
      : options_(how), quarantine_(known), on_incident_(tell) {
    scratch_ = (fs::path(options_.folder) / "reports").string();
    std::error_code error;
    fs::remove_all(scratch_, error);
    fs::create_directories(scratch_, error);
    if (error) throw EngineError(scratch_ + ": cannot be made: " + error.message());
    if (options_.password_file.empty()) {
      options_.password_file = fs::absolute(fs::path(options_.folder) / "workers.password").string();
      make_password_file(options_.password_file);
    }
    queue_.reset(work_queue_create(options_.port == 0 ? -1 : options_.port));
    if (!queue_)
      throw EngineError("port " + std::to_string(options_.port) + " cannot be listened to: in use, or not allowed");
    if (!work_queue_specify_password_file(queue_.get(), options_.password_file.c_str()))
      throw EngineError(options_.password_file + ": no password can be read from it");
    work_queue_tune(queue_.get(), "keepalive-interval", kKeepalive_s);
    work_queue_tune(queue_.get(), "keepalive-timeout", kKeepalive_s);
    const std::string port = std::to_string(work_queue_port(queue_.get()));
    if (options_.spawn_local > 0) {
      local_ = std::make_unique<LocalWorkers>(
          options_.spawn_local,
          std::vector<std::string>{"work_queue_worker", "--cores", "1", "--password", options_.password_file,
                                   "--workdir", fs::absolute(scratch_).string(), "--min-backoff", "1", "--max-backoff",
                                   "2", "--connect-timeout", "60", "127.0.0.1", port});
    }
    options_.say("work queue: listening on port " + port + "; more workers: " + how_to_join());
  }

  ~WorkQueueEngine() override {
    cancel_all();
    work_queue_shut_down_workers(queue_.get(), 0);
    work_queue_stats stats;
    work_queue_get_stats(queue_.get(), &stats);
    options_.say("work queue: " + std::to_string(stats.tasks_done) + " tasks done, " +
                 std::to_string(stats.workers_joined) + " workers joined, " + std::to_string(stats.workers_lost) +
                 " lost, " + std::to_string(stats.bytes_sent / 1024) + " kB sent, " +
                 std::to_string(stats.bytes_received / 1024) + " kB received");
    queue_.reset();
    local_.reset();
    std::error_code ignored;
    fs::remove_all(scratch_, ignored);
  }

  std::vector<TaskResult> run(const std::vector<SearchTask>& tasks, const std::atomic<bool>& stop) override {
    std::vector<TaskResult> results(tasks.size());
    const auto chunk = static_cast<std::size_t>(options_.chunk);
    for (std::size_t first = 0; first < tasks.size(); first += chunk)
      submit({first, std::min(chunk, tasks.size() - first)}, tasks);
    while (!pieces_.empty()) {
      if (stop) {
        cancel_all();
        throw SearchStopped();
      }
      work_queue_task* task = work_queue_wait(queue_.get(), 1);
      if (local_) local_->look_after();
      tell_if_alone();
      if (!task) continue;
      const std::unique_ptr<work_queue_task, void (*)(work_queue_task*)> owned(task, work_queue_task_delete);
      Piece piece = pieces_.at(task->taskid);
      pieces_.erase(task->taskid);
      WorkReport report;
      const bool came = read_report(task, report, piece);
      std::error_code ignored;
      fs::remove(task->tag, ignored);
      for (const Incident& incident : report.incidents) take(incident);
      if (came && report.incidents.empty()) {
        std::move(report.results.begin(), report.results.end(),
                  results.begin() + static_cast<std::ptrdiff_t>(piece.first));
      } else {
        submit(piece, tasks);
      }
    }
    return results;
  }

 private:
  std::string how_to_join() const {
    return "work_queue_worker --password " + options_.password_file + " " + host_name() + " " +
           std::to_string(work_queue_port(queue_.get()));
  }

  void submit(const Piece& piece, const std::vector<SearchTask>& tasks) {
    WorkOrder order;
    const auto first = tasks.begin() + static_cast<std::ptrdiff_t>(piece.first);
    order.tasks.assign(first, first + static_cast<std::ptrdiff_t>(piece.count));
    order.quarantine = quarantine_.incidents();
    order.candidate_seconds = options_.candidate_seconds;
    const std::string bytes = encoded(order), report = scratch_ + "/" + std::to_string(++reports_);
    work_queue_task* task = work_queue_task_create("./formotion work problem.json order report 2>&1");
    work_queue_task_specify_file(task, options_.program.c_str(), "formotion", WORK_QUEUE_INPUT, WORK_QUEUE_CACHE);
    work_queue_task_specify_file(task, options_.problem_file.c_str(), "problem.json", WORK_QUEUE_INPUT,
                                 WORK_QUEUE_CACHE);
    work_queue_task_specify_buffer(task, bytes.data(), static_cast<int>(bytes.size()), "order", WORK_QUEUE_NOCACHE);
    work_queue_task_specify_file(task, report.c_str(), "report", WORK_QUEUE_OUTPUT, WORK_QUEUE_NOCACHE);
    work_queue_task_specify_tag(task, report.c_str());
    work_queue_task_specify_cores(task, 1);
    pieces_[work_queue_submit(queue_.get(), task)] = piece;
  }

  void cancel_all() {
    for (const auto& [number, piece] : pieces_) {
      if (work_queue_task* task = work_queue_cancel_by_taskid(queue_.get(), number)) work_queue_task_delete(task);
    }
    pieces_.clear();
  }

  // Notes what ended a piece; it is sent again by the caller.
  void take(Incident incident) {
    if (incident.failure == Failure::Lost) {
      auto known = std::find_if(losses_.begin(), losses_.end(),
                                [&](const auto& loss) { return loss.first == incident.subject; });
      if (known == losses_.end()) known = losses_.insert(losses_.end(), {incident.subject, 0});
      if (++known->second < kMostLosses) return;
      incident.failure = Failure::Crash;
      incident.text =
          "the process that scored it was killed " + std::to_string(kMostLosses) + " times, perhaps for its memory";
      while (!quarantine_.find(incident.subject)) quarantine_.note(incident.subject, incident.failure, incident.text);
      known->second = 0;
      on_incident_(*quarantine_.find(incident.subject));
      return;
    }
    const Incident& now = quarantine_.note(incident.subject, incident.failure, incident.text);
    on_incident_(now);
    options_.say(std::string(name(now.failure)) + " of a " + (now.subject.stage ? "stage" : "candidate") + ": " +
                 now.text +
                 (now.times < Quarantine::kTimes ? "; it is tried once more" : "; it is left out from now on"));
  }

  // The report of a task that came back, or none: then the piece failed.
  bool read_report(work_queue_task* task, WorkReport& report, Piece& piece) {
    std::string why = "its result is missing or damaged";
    if (task->result == WORK_QUEUE_RESULT_SUCCESS && task->return_status == 0) {
      const std::string bytes = whole_file(task->tag);
      try {
        report = decoded_report(bytes);
        if (!report.error.empty()) throw std::runtime_error(report.error);
        return true;
      } catch (const DamagedBytes& damaged) { why = damaged.what(); }
    } else if (task->result == WORK_QUEUE_RESULT_INPUT_MISSING) {
      why = "the program or the problem cannot be sent: " + options_.program + ", " + options_.problem_file;
    } else if (task->result == WORK_QUEUE_RESULT_SUCCESS || task->result == WORK_QUEUE_RESULT_OUTPUT_MISSING) {
      why = "exit code " + std::to_string(task->return_status) + ", " + one_line(task->output);
    } else {
      why = work_queue_result_str(task->result);
    }
    const std::string where = task->hostname ? std::string(" on ") + task->hostname : "";
    if (++piece.failures >= kMostFailures) throw EngineError("tasks cannot be run" + where + ": " + why);
    options_.say("a task came back without a result" + where + " (" + why + "); it is sent again");
    return false;
  }

  void tell_if_alone() {
    work_queue_stats stats;
    work_queue_get_stats(queue_.get(), &stats);
    if (stats.workers_connected > 0) alone_since_ = Clock::now();
    if (Clock::now() - alone_since_ < kPatience) return;
    alone_since_ = Clock::now();
    options_.say("no worker is connected; waiting. To start one: " + how_to_join());
  }

  WorkQueueOptions options_;
  Quarantine& quarantine_;
  std::function<void(const Incident&)> on_incident_;
  std::string scratch_;  // where reports_ arrive
  struct Delete {
    void operator()(work_queue* queue) const { work_queue_delete(queue); }
  };
  std::unique_ptr<work_queue, Delete> queue_;
  std::unique_ptr<LocalWorkers> local_;
  std::map<int, Piece> pieces_;                   // by Work Queue's number: those that are out
  std::vector<std::pair<Subject, int>> losses_;   // by subject: how often its process was killed
  Clock::time_point alone_since_ = Clock::now();  // no worker since then
  std::int64_t reports_ = 0;                      // names of report files
};

}  // namespace

std::unique_ptr<Engine> make_work_queue_engine(const WorkQueueOptions& options, Quarantine& quarantine,
                                               const std::function<void(const Incident&)>& on_incident) {
  return std::make_unique<WorkQueueEngine>(options, quarantine, on_incident);
}

}  // namespace formotion
