// The workers of a Work Queue (CCTools), on this machine or on many. docs/many-machines.md says how to start them.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "optimize/engine.hpp"
#include "optimize/quarantine.hpp"

namespace formotion {

struct WorkQueueOptions {
  std::string program;        // this program: sent to every worker
  std::string problem_file;   // sent to every worker
  std::string folder;         // the run's: the password and what workers leave go there
  std::string password_file;  // empty: FOLDER/workers.password, made where there is none
  int port = 0;               // 0: any that is free
  int spawn_local = 0;        // workers on this machine, started again when they die and ended with the engine
  int chunk = 1;              // search tasks that are sent together
  double candidate_seconds = 0;
  std::function<void(const std::string& text)> say;  // messages for the user
};

// Begins to listen; ends all workers when it is destroyed. The quarantine grows by what ends tasks; on_incident sees
// every such incident before the tasks are sent again. Throws EngineError, also where the program was built without
// Work Queue.
std::unique_ptr<Engine> make_work_queue_engine(const WorkQueueOptions& options, Quarantine& quarantine,
                                               const std::function<void(const Incident&)>& on_incident);

}  // namespace formotion
