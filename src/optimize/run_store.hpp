// A run on disk: every evaluation, the front and how far the search is, in one SQLite file. One writer; readers may
// look at any time. A transaction a batch holds everything that the batch changed, so a kill loses the current batch at
// most. (Tested against kills of the process, not against power cuts.)
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>

#include "optimize/named_point.hpp"
#include "optimize/quarantine.hpp"
#include "optimize/run_state.hpp"

namespace formotion {

// The folder or its store cannot be used; the text is one line for the user.
struct StoreError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// What a run is of.
struct RunIdentity {
  std::string problem_text;  // canonical
  std::string problem_path;  // as given, for the commands in reports
  std::string program_version;
  std::int64_t budget = 0;
  std::uint64_t seed = 0;
};

class RunStore {
 public:
  static bool exists(const std::string& folder);

  // Makes folder/run.sqlite, complete or not at all (by rename). StoreError if there is one unless overwrite.
  static RunStore create(const std::string& folder, const RunIdentity& identity, bool overwrite,
                         const NamedPoint& at_point = {});
  // For going on: takes the folder's lock. StoreError if another process has it, or if another version wrote it.
  static RunStore open_for_writing(const std::string& folder, const std::string& program_version,
                                   const NamedPoint& at_point = {});
  // For looking: while another process runs it, too.
  static RunStore open_for_reading(const std::string& folder);

  RunStore(RunStore&&) noexcept;
  ~RunStore();

  const RunIdentity& identity() const;
  bool complete() const;
  bool locked_by_another() const;  // a process is running it now

  // Fills an empty state with all that was committed.
  void load(RunState& state) const;
  // Everything that state has beyond what is stored, its front, and whether the search is over; in one transaction.
  void commit(const RunState& state, bool complete);

  // How many processes have written to this run so far: a number for each (optimize/run_watch.hpp uses it).
  std::int64_t generation() const;
  // One more of them, and all incidents that are known to it, in one transaction.
  void begin_generation(const Quarantine& quarantine);
  Quarantine quarantine() const;
  void save(const Incident& incident);  // new or happened again

  // What later checks of designs said: JSON by the design's id. They are no part of the search.
  std::map<std::string, std::string> stamps() const;
  void stamp(const std::map<std::string, std::string>& said);  // in place of earlier ones of the same designs

 private:
  struct Impl;
  explicit RunStore(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace formotion
