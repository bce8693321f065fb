#include "optimize/quarantine.hpp"

#include <algorithm>

namespace formotion {

const Incident* Quarantine::find(const Subject& subject) const {
  for (const Incident& incident : incidents_) {
    if (incident.times >= kTimes && incident.subject == subject) return &incident;
  }
  return nullptr;
}

const Incident& Quarantine::note(const Subject& subject, Failure failure, const std::string& text) {
  const auto known = std::find_if(incidents_.begin(), incidents_.end(),
                                  [&](const Incident& incident) { return incident.subject == subject; });
  if (known == incidents_.end()) return incidents_.emplace_back(Incident{subject, failure, text, 1});
  known->failure = failure;
  known->text = text;
  ++known->times;
  return *known;
}

}  // namespace formotion
