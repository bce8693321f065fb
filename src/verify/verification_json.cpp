#include "verify/verification_json.hpp"

namespace formotion {

nlohmann::ordered_json verification_json(const Verification& verification, const VerifyOptions& options,
                                         const std::string& program_version) {
  nlohmann::ordered_json json{{"id", verification.id},
                              {"holds", verification.holds},
                              {"program", "formotion " + program_version},
                              {"perturbations", options.perturbations},
                              {"seed", options.seed}};
  json["checks"] = nlohmann::ordered_json::array();
  for (const Check& check : verification.checks) {
    nlohmann::ordered_json one{{"name", check.name},   {"holds", check.holds},     {"says", says(check)},
                               {"count", check.count}, {"skipped", check.skipped}, {"unit", check.unit}};
    one["worst"] = check.worst ? nlohmann::ordered_json(*check.worst) : nlohmann::ordered_json(nullptr);
    one["worst_of"] = check.worst_of;
    one["note"] = check.note;
    if (check.design) one["design"] = *check.design;
    json["checks"].push_back(std::move(one));
  }
  return json;
}

std::string verification_text(const Verification& verification) {
  std::string text;
  if (verification.holds) {
    text = verification.id + " holds: " + std::to_string(verification.checks.size()) + " checks";
    for (const Check& check : verification.checks) {
      if (check.count > 0) text += ", " + std::to_string(check.count) + " " + check.unit;
    }
    return text + "\n";
  }
  for (const Check& check : verification.checks) {
    if (!check.holds) text += verification.id + " FAILS: " + check.name + ": " + check.failure + "\n";
  }
  return text;
}

}  // namespace formotion
