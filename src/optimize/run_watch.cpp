#include "optimize/run_watch.hpp"

#include <filesystem>

namespace formotion {
namespace {

std::string marks_file(const std::string& folder) { return (std::filesystem::path(folder) / "run.marks").string(); }

// The marks carry the generation of the process that made them. It is raised in the transaction that takes them in, so
// nobody takes them in again.
Quarantine taken_in(RunStore& store, const std::string& folder) {
  Quarantine quarantine = store.quarantine();
  for (const Mark& mark : CrashMarks::ended_by_signal(marks_file(folder), store.generation())) {
    quarantine.note(mark.subject, Failure::Crash,
                    "signal " + std::to_string(mark.signal) + " ended the process that scored it");
  }
  store.begin_generation(quarantine);
  return quarantine;
}

}  // namespace

RunWatch::RunWatch(RunStore& store, const std::string& folder)
    : quarantine(taken_in(store, folder)), marks(marks_file(folder), store.generation()) {}

}  // namespace formotion
