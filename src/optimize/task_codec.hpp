// What goes to a worker and what comes back, as bytes.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "optimize/quarantine.hpp"
#include "optimize/search_task.hpp"

namespace formotion {

// Some tasks for one worker.
struct WorkOrder {
  std::vector<SearchTask> tasks;
  std::vector<Incident> quarantine;  // what is known so far
  double candidate_seconds = 0;      // how long one candidate may take
};

struct WorkReport {
  std::vector<TaskResult> results;  // of every task, unless something ended them
  std::vector<Incident> incidents;  // what was being scored when the tasks were ended, at most one
  std::string error;                // else: why there are no results
};

// Doubles keep their bits. The text begins with a format number and ends with a checksum.
std::string encoded(const WorkOrder& order);
std::string encoded(const WorkReport& report);

// Bytes that are cut short, changed, or of another format.
struct DamagedBytes : std::runtime_error {
  using std::runtime_error::runtime_error;
};
WorkOrder decoded_order(std::string_view bytes);
WorkReport decoded_report(std::string_view bytes);

}  // namespace formotion
