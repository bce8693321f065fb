// What a process that goes on with a run begins with: the notes of the one before it taken in, and marks of its own.
#pragma once

#include <string>

#include "optimize/crash_marks.hpp"
#include "optimize/quarantine.hpp"
#include "optimize/run_store.hpp"

namespace formotion {

struct RunWatch {
  // Every candidate whose scoring ended the process before this one by a fatal signal is noted in the store, once
  // however often this is killed on its way. The store must be open for writing.
  RunWatch(RunStore& store, const std::string& folder);

  Quarantine quarantine;
  CrashMarks marks;
};

}  // namespace formotion
