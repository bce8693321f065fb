// A design checked again, by other means than those that scored it: exact arithmetic, finer steps, shapes that are a
// little off, every start. docs/verify.md says what each check shows and what it does not.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "applications/feeder/feeder_problem.hpp"
#include "optimize/evaluated.hpp"

namespace formotion {

struct VerifyOptions {
  int perturbations = 64;
  std::uint64_t seed = 1;  // of the perturbations
};

struct Check {
  std::string name;  // "exact", "drawn", "finer", "perturbed", "starts", "repeatable"
  bool holds = true;
  std::int64_t count = 0;    // what was looked at
  std::string unit = {};     // in words: "positions"
  std::int64_t skipped = 0;  // of these: could not be judged
  std::optional<double> worst = {};
  std::string worst_of = {};                      // what that figure is, with its unit
  std::string failure = {};                       // the first one, in words
  std::optional<feeder::DesignSpec> design = {};  // the track that fails, where it is not the design itself
  std::string note = {};                          // what was not looked at

  void fail(const std::string& text) {
    if (holds) failure = text;
    holds = false;
  }
};

struct Verification {
  std::string id;
  bool holds = true;
  std::vector<Check> checks = {};
};

// stored: the design and the score that the run keeps of it; what it claims is what is checked. same_program: whether
// this program is the version that scored it (else its bits are not promised). Pure. A few seconds for a passive track,
// more where parts turn.
Verification verify_design(const feeder::FeederProblem& problem, const Evaluated& stored, bool same_program,
                           const VerifyOptions& options = {});

// One sentence about a check: what was looked at, or how it fails.
std::string says(const Check& check);

}  // namespace formotion
