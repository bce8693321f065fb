// verify: a run's front checked again, design by design.
#include <algorithm>
#include <iostream>
#include <map>
#include <mutex>
#include <optional>

#include "commands.hpp"
#include "loaded_run.hpp"
#include "optimize/executor.hpp"
#include "verify/verification_json.hpp"

namespace formotion {
namespace {

std::vector<Evaluated> chosen_designs(const LoadedRun& loaded, const std::vector<std::string>& named) {
  const std::vector<Evaluated>& all = loaded.state.evaluations();
  const RunSummary run = loaded.run();
  std::vector<Evaluated> chosen;
  if (named.empty()) {
    std::copy_if(run.front.begin(), run.front.end(), std::back_inserter(chosen),
                 [](const Evaluated& e) { return e.score.feasible; });
    return chosen;
  }
  for (const std::string& id : named) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const Evaluated& e) { return design_id(e) == id; });
    if (found == all.end()) throw StoreError("no design '" + id + "' in this run");
    if (found->score.failure != Failure::None)
      throw StoreError(id + " has no score to verify: " + found->score.failure_text);
    chosen.push_back(*found);
  }
  return chosen;
}

// Beside the run's designs, for reports. A run that goes on, or is another version's, keeps none.
void keep_stamps(const std::string& folder, const std::map<std::string, std::string>& stamps) {
  try {
    RunStore::open_for_writing(folder, FORMOTION_VERSION).stamp(stamps);
  } catch (const StoreError& error) {
    std::cerr << "note: the run does not keep these results: " << error.what() << "\n";
  }
}

}  // namespace

int run_verify(const std::string& folder, const VerifyCommand& command) {
  const LoadedRun loaded(folder);
  const Verifier verify = verifier_of(loaded.file);
  const std::vector<Evaluated> designs = chosen_designs(loaded, command.designs);
  if (designs.empty()) {
    std::cerr << "no feasible design to verify\n";
    return kNotFeasible;
  }
  const bool same_program = loaded.store.identity().program_version == FORMOTION_VERSION;
  const VerifyOptions options{command.perturbations, command.seed};
  const bool as_json = command.format == "json";
  std::vector<std::optional<Verification>> results(designs.size());
  std::size_t printed = 0;
  std::mutex printing;
  run_parallel(static_cast<int>(designs.size()), command.threads, [&](int i) {
    Verification result = verify(designs[static_cast<std::size_t>(i)], same_program, options);
    const std::lock_guard lock(printing);
    results[static_cast<std::size_t>(i)] = std::move(result);
    // In the front's order, as soon as all before are done.
    for (; printed < results.size() && results[printed]; ++printed) {
      if (!as_json) std::cout << verification_text(*results[printed]) << std::flush;
    }
  });
  bool hold = true;
  std::map<std::string, std::string> stamps;
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < designs.size(); ++i) {
    const nlohmann::ordered_json json = verification_json(*results[i], options, FORMOTION_VERSION);
    stamps[results[i]->id] = json.dump();
    all.push_back(json);
    hold = hold && results[i]->holds;
  }
  if (as_json) std::cout << all.dump(1) << "\n";
  keep_stamps(folder, stamps);
  return hold ? kDone : kNotFeasible;
}

}  // namespace formotion
