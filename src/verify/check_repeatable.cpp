#include <algorithm>
#include <bit>
#include <sstream>

#include "verify/checks.hpp"

namespace formotion {
namespace {

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](double x, double y) {
           return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
         });
}

std::string listed(const std::vector<double>& numbers) {
  std::ostringstream out;
  out.precision(17);
  for (std::size_t i = 0; i < numbers.size(); ++i) out << (i ? ", " : "") << numbers[i];
  return out.str();
}

}  // namespace

Check check_repeatable(const Problem& problem, const Evaluated& evaluated, bool same_program) {
  Check check{"repeatable"};
  check.unit = "numbers";
  if (!same_program) {
    check.note = "scored by another version of the program";
    return check;
  }
  const Score &stored = evaluated.score, again = problem.score(evaluated.candidate);
  check.count = static_cast<std::int64_t>(2 + stored.objectives.size() + stored.worst_case.size());
  if (again.feasible != stored.feasible) {
    check.fail(std::string("stored as ") + (stored.feasible ? "feasible" : "infeasible") + ", which it is not");
  } else if (!same_bits(again.objectives, stored.objectives)) {
    check.fail("objectives stored as " + listed(stored.objectives) + ", now " + listed(again.objectives));
  } else if (!same_bits({again.violation}, {stored.violation})) {
    check.fail("violation stored as " + listed({stored.violation}) + ", now " + listed({again.violation}));
  } else if (!stored.worst_case.empty() &&
             (!same_bits(again.worst_case, stored.worst_case) || again.bites != stored.bites)) {
    check.fail("worst case stored as " + listed(stored.worst_case) + ", now " + listed(again.worst_case));
  }
  return check;
}

}  // namespace formotion
