// A design checked again, by other means than those that scored it: exact arithmetic, finer steps, shapes that are a
// little off, other starts. docs/verify.md says what each check shows and what it does not.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "applications/assembly/assembly_problem.hpp"
#include "applications/feeder/feeder_problem.hpp"
#include "applications/nest/nest_problem.hpp"
#include "io/problem_file.hpp"
#include "optimize/evaluated.hpp"

namespace formotion {

struct VerifyOptions {
  int perturbations = 64;
  std::uint64_t seed = 1;  // of the perturbations
};

struct Check {
  std::string name;  // "exact", "drawn", "finer", "perturbed", "starts", "shaken", "repeatable"
  bool holds = true;
  std::int64_t count = 0;    // what was looked at
  std::string unit = {};     // in words: "positions"
  std::int64_t skipped = 0;  // of these: could not be judged
  std::optional<double> worst = {};
  std::string worst_of = {};                          // what that figure is, with its unit
  std::string failure = {};                           // the first one, in words
  std::optional<nlohmann::ordered_json> design = {};  // design file of what fails, where it is not the design itself
  std::string note = {};                              // what was not looked at, what else was found

  void fail(const std::string& text) {
    if (holds) failure = text;
    holds = false;
  }
};

struct Verification {
  std::string id;
  bool holds = true;
  std::vector<Check> checks = {};

  void add(Check check) {
    holds = holds && check.holds;
    checks.push_back(std::move(check));
  }
};

// stored: the design and the score that the run keeps of it; what it claims is what is checked. same_program: whether
// this program is the version that scored it (else its bits are not promised). Pure. A few seconds for a passive track
// or a joint, more where parts of a feeder turn.
using Verifier = std::function<Verification(const Evaluated& stored, bool same_program, const VerifyOptions& options)>;
// For a problem of any kind, which it keeps.
Verifier verifier_of(const ProblemFile& file);

Verification verify_design(const feeder::FeederProblem& problem, const Evaluated& stored, bool same_program,
                           const VerifyOptions& options = {});
Verification verify_design(const assembly::AssemblyProblem& problem, const Evaluated& stored, bool same_program,
                           const VerifyOptions& options = {});
Verification verify_design(const nest::NestProblem& problem, const Evaluated& stored, bool same_program,
                           const VerifyOptions& options = {});

// One sentence about a check: what was looked at, or how it fails.
std::string says(const Check& check);

}  // namespace formotion
