// Compares the feeder's scorer with the sampled one on as many random designs as asked for:
//   witness_designs [COUNT] [SEED]
// Prints how much was compared, and each disagreement with the design's number.
#include <cstdio>
#include <cstdlib>

#include "witness/feeder_specs.hpp"
#include "witness/sampled_track.hpp"

int main(int argc, char** argv) {
  using namespace formotion;
  const long count = argc > 1 ? std::atol(argv[1]) : 1000;
  const std::uint64_t seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  witness::Confirmation total;
  long wrong = 0;
  for (long i = 0; i < count; ++i) {
    witness::Random random(seed + static_cast<std::uint64_t>(i));
    const feeder::FeederProblem problem(witness::random_feeder(random));
    const witness::Confirmation one = witness::compare(problem, 0, {});
    total.outcomes += one.outcomes;
    total.margins += one.margins;
    total.tolerances += one.tolerances;
    total.falls += one.falls;
    wrong += !one.disagreements.empty();
    for (const std::string& text : one.disagreements) {
      std::printf("seed %llu (%s): %s\n", static_cast<unsigned long long>(seed) + static_cast<unsigned long long>(i),
                  problem.topologies()[0].label.c_str(), text.c_str());
    }
  }
  std::printf("%ld designs: %d outcomes, %d margins, %d falls, %d tolerances compared; %ld designs disagree\n", count,
              total.outcomes, total.margins, total.falls, total.tolerances, wrong);
  return wrong == 0 ? 0 : 1;
}
