// What every thread is scoring, in a mapped file that outlives the process: who ended it can be told afterwards.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "optimize/quarantine.hpp"

namespace formotion {

struct MarkSlot;
struct MarkHeader;

// One thread's mark, as somebody else reads it.
struct Mark {
  Subject subject;
  int signal = 0;            // the fatal signal that ended its scoring; 0: none so far
  std::uint64_t number = 0;  // rises with everything that this slot scores
};

class CrashMarks {
 public:
  // A fresh file for the marks of one process. Its pages are allocated here: a full disk is a StoreError now, not a
  // SIGBUS later. The generation tells readers which process wrote it.
  CrashMarks(const std::string& path, std::int64_t generation);
  // Without a file: shared with the children of this process.
  CrashMarks();
  CrashMarks(const CrashMarks&) = delete;
  CrashMarks& operator=(const CrashMarks&) = delete;
  ~CrashMarks();

  // The marks that another process left: those that a fatal signal ended. None if the file is not of this generation.
  static std::vector<Mark> ended_by_signal(const std::string& path, std::int64_t generation);

  std::vector<Mark> marks() const;  // of all that is being scored now, or was when its process ended

  // Marks what this thread scores for as long as it lives. Subjects with too many values, or of more threads than there
  // are slots, go unmarked.
  class Scoring {
   public:
    Scoring(CrashMarks* marks, const Subject& subject);  // null: marks nothing
    Scoring(const Scoring&) = delete;
    Scoring& operator=(const Scoring&) = delete;
    ~Scoring();

   private:
    MarkSlot* slot_ = nullptr;
    MarkSlot* outer_ = nullptr;
  };

 private:
  MarkSlot* claim();
  MarkHeader* memory_ = nullptr;
};

// From here on SIGSEGV, SIGABRT, SIGFPE, SIGBUS and SIGILL that a thread brings on itself while it scores are noted in
// its mark, also when its stack is exhausted; then the signal ends the process as ever. Signals from outside, kill -9
// among them, are not noted.
void note_fatal_signals();

}  // namespace formotion
