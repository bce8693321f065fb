// Compares the support test with the exact witnesses in as many configurations as asked for:
//   witness_million [COUNT] [SEED]
// Prints how many agree, the largest difference, and each disagreement.
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "witness/exact_support.hpp"
#include "witness/random_shapes.hpp"

int main(int argc, char** argv) {
  using namespace formotion;
  const long count = argc > 1 ? std::atol(argv[1]) : 1000000;
  witness::Random random(argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1);
  long wrong = 0, degenerate = 0, unsupported = 0;
  double largest = 0;
  for (long i = 0; i < count; ++i) {
    const bool on_grid = i % 4 == 3;
    const witness::Situation s = on_grid ? witness::degenerate_situation(random) : witness::random_situation(random);
    const auto fast = support_margin(s.part, s.track, s.supported_point);
    const auto slow = on_grid ? witness::margin_by_exact_generators(s.part, s.track, s.supported_point)
                              : witness::margin_by_boolean_operations(s.part, s.track, s.supported_point);
    degenerate += on_grid;
    unsupported += !slow.has_value();
    const double difference = fast && slow ? std::abs(*fast - *slow) : fast.has_value() == slow.has_value() ? 0 : 1e9;
    if (difference < 1e-6) {
      largest = std::fmax(largest, difference);
      continue;
    }
    ++wrong;
    std::printf("configuration %ld: %.12g against %.12g\n", i, fast.value_or(NAN), slow.value_or(NAN));
  }
  std::printf(
      "%ld configurations, %ld of them degenerate, %ld without any support: %ld disagree; largest difference of the "
      "others %.3g mm\n",
      count, degenerate, unsupported, wrong, largest);
  return wrong == 0 ? 0 : 1;
}
