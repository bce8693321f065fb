// Candidates and stages that ended the process that scored them, or took too long: after the second time they are no
// longer scored.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "problem/problem.hpp"

namespace formotion {

// What was being scored: a candidate of a topology, or a stage of a kind.
struct Subject {
  bool stage = false;
  int place = 0;  // the topology, or the kind
  std::vector<double> values;
  bool operator==(const Subject&) const = default;
};

struct Incident {
  Subject subject;
  Failure failure = Failure::Crash;  // or TimeOut
  std::string text;                  // of the last time
  int times = 1;
};

class Quarantine {
 public:
  static constexpr int kTimes = 2;  // the first time may be the machine's fault

  // The incident of a subject that is not to be scored again, or null.
  const Incident* find(const Subject& subject) const;
  // One more time; the incident as it then is.
  const Incident& note(const Subject& subject, Failure failure, const std::string& text);
  void restore(Incident incident) { incidents_.push_back(std::move(incident)); }
  const std::vector<Incident>& incidents() const { return incidents_; }  // in the order of their first times

 private:
  std::vector<Incident> incidents_;
};

}  // namespace formotion
