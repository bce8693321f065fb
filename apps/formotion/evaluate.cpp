// evaluate and validate: one look at a problem file.
#include <iostream>

#include "chosen_design.hpp"
#include "report/kind.hpp"

namespace formotion {

int run_evaluate(const DesignChoice& choice, const std::string& format) {
  const ChosenDesign chosen = chosen_design(choice);
  const std::unique_ptr<Kind> kind = kind_of(chosen.file);
  if (format == "json") {
    std::cout << kind->evaluation(chosen.topology, chosen.values).dump(2) << "\n";
  } else {
    std::cout << kind->drawing(chosen.topology, chosen.values, format);
  }
  return kDone;
}

int run_validate(const std::string& problem, bool folder_only) {
  const ProblemFile file = read_problem_file(problem);
  if (folder_only) {
    std::cout << default_folder(file) << "\n";
    return kDone;
  }
  std::cout << problem << ": good: " << file.kind << ", " << aspects_in(file) << " aspects, " << topologies_in(file)
            << " topologies, " << variables_of(file).size() << " variables\n";
  if (!file.feeder.grammar) return kDone;
  std::int64_t pruned = 0;
  for (const feeder::PrunedSequences& entry : file.feeder.grammar->pruned) pruned += entry.count;
  std::cout << "grammar: " << file.feeder.grammar->sequences << " sequences, " << pruned << " pruned\n";
  for (const feeder::PrunedSequences& entry : file.feeder.grammar->pruned)
    std::cout << "pruned: " << entry.count << " sequences of " << entry.pattern << ": " << entry.reason << "\n";
  return kDone;
}

}  // namespace formotion
