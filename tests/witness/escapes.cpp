// Escape heights beside a planner that looks for lower ways, for many random nests: witness_escapes [nests] [samples]
// [first seed] [gap]. Fails if one is found below a lower bound.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "witness/escape_attack.hpp"

using namespace formotion;
using namespace formotion::witness;

namespace {

double share_of(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

}  // namespace

int main(int argc, char** argv) {
  const auto argument = [&](int k, double otherwise) { return argc > k ? std::atof(argv[k]) : otherwise; };
  const int nests = static_cast<int>(argument(1, 60));
  const long samples = static_cast<long>(argument(2, 20000));
  const auto first = static_cast<std::uint64_t>(argument(3, 0));
  const double gap = argument(4, 0.1);
  int attacked = 0, below = 0, enclosed = 0, out = 0;
  long free_samples = 0;
  std::vector<double> alone, pushed;
  for (std::uint64_t seed = first; attacked < nests && seed < first + 100 * static_cast<std::uint64_t>(nests); ++seed) {
    const Attack attack = attacked_nest(seed, samples, gap);
    if (attack.why_not != nullptr) continue;
    ++attacked;
    free_samples += attack.free_samples;
    enclosed += attack.is_enclosed;
    below += attack.got_below;
    std::printf("seed %4llu  lower %8.4f  width %7.4f  alone %+9.4f  pushed %+9.4f  free %ld%s\n",
                static_cast<unsigned long long>(seed), attack.lower_mm, attack.upper_mm - attack.lower_mm,
                attack.alone_mm - attack.upper_mm, attack.pushed_mm - attack.upper_mm, attack.free_samples,
                attack.got_below     ? "  BELOW THE LOWER BOUND"
                : attack.is_enclosed ? "  enclosed"
                                     : "");
    std::fflush(stdout);
    if (attack.is_enclosed) continue;
    if (std::isfinite(attack.alone_mm)) {
      ++out;
      alone.push_back(attack.alone_mm - attack.upper_mm);
    }
    if (std::isfinite(attack.pushed_mm)) pushed.push_back(attack.pushed_mm - attack.upper_mm);
  }
  std::printf("%d nests (%d enclosed), %ld free configurations, %d below a lower bound\n", attacked, enclosed,
              free_samples, below);
  std::printf("planner alone: out of %d of %d, over the upper bound by %.4f (median) %.4f (nine in ten) %.4f (all)\n",
              out, attacked - enclosed, share_of(alone, 0.5), share_of(alone, 0.9), share_of(alone, 1));
  std::printf("pushing the way of the upper bound down: %zu ways, by %.4f (least) %.4f (median) %.4f (most)\n",
              pushed.size(), share_of(pushed, 0), share_of(pushed, 0.5), share_of(pushed, 1));
  return below == 0 ? 0 : 1;
}
