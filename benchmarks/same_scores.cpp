// Prints a hash of the scores of 10,000 candidates of the el, a tenth of them feasible, and sums of what they say:
// whether a change of the code changed a result.
#include <cstdint>
#include <cstdio>
#include <cstring>

#include "cases.hpp"

int main() {
  using namespace formotion;
  const feeder::FeederProblem problem(bench::el_bracket({"efficiency", "tolerance_mm", "margin_mm", "length_mm"}));
  std::uint64_t hash = 14695981039346656037ull;  // FNV-1a
  double violations = 0;
  int feasible = 0;
  const auto take = [&hash](double value) {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    for (int i = 0; i < 64; i += 8) hash = (hash ^ (bits >> i & 0xff)) * 1099511628211ull;
  };
  double tolerances = 0;
  std::vector<Candidate> candidates = bench::random_candidates(problem, 9000, 7);
  for (Candidate& candidate : bench::feasible_candidates(problem, 1000, 7)) candidates.push_back(std::move(candidate));
  for (const Candidate& candidate : candidates) {
    const Score score = problem.score(candidate);
    feasible += score.feasible;
    violations += score.violation;
    tolerances += score.objectives[1];
    take(score.violation);
    for (const double value : score.objectives) take(value);
  }
  std::printf("%016llx: %d feasible, violations %.12g mm, tolerances %.12g mm\n", static_cast<unsigned long long>(hash),
              feasible, violations, tolerances);
}
