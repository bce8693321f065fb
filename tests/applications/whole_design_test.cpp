#include <catch2/catch.hpp>
#include <cstring>
#include <thread>

#include "analysis/geometry/boolean.hpp"
#include "witness/feeder_specs.hpp"
#include "witness/sampled_track.hpp"

using namespace formotion;
using namespace formotion::witness;

TEST_CASE("outcomes, margins, falls and tolerances of 300 random designs are those of the sampled witness") {
  Confirmation total;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Random random(seed);
    const feeder::FeederProblem problem(random_feeder(random));
    const Confirmation one = compare(problem, 0, {});
    for (const std::string& text : one.disagreements) {
      UNSCOPED_INFO("seed " << seed << " (" << problem.topologies()[0].label << "): " << text);
    }
    CHECK(one.disagreements.empty());
    total.outcomes += one.outcomes;
    total.margins += one.margins;
    total.falls += one.falls;
    total.tolerances += one.tolerances;
  }
  CHECK(total.outcomes > 1200);
  CHECK(total.margins > 1200);
  CHECK(total.falls > 250);
  CHECK(total.tolerances > 280);
}

TEST_CASE("the witness notices wrong answers") {
  // The same design on a track that the witness takes for another one.
  const feeder::FeederProblem narrow(feeder_spec(flat_part(el_outline(), true), {balcony(9, 60)}, 40));
  CHECK(confirm(narrow, 0, {}).empty());
  const std::vector<Loop> voids{rectangle(0, 0, 10, 10)};
  CHECK(std::abs(signed_area(moved_edges(voids, 1, true, 96).front())) > 140 + 3.1);
  CHECK(std::abs(signed_area(moved_edges(voids, -1, true, 96).front())) == Approx(64));
  CHECK(fits_by_trying({rectangle(0, 0, 10, 4), {}}, {1, 0}, 9, 3) == 1);
  CHECK(fits_by_trying({rectangle(0, 0, 10, 4), {}}, {0, 1}, 9, 3) == 0);
}

TEST_CASE("a candidate has the same score, bit for bit, on eight threads") {
  std::vector<feeder::FeederSpec> specs;
  for (std::uint64_t seed = 900; seed < 940; ++seed) {
    Random random(seed);
    specs.push_back(random_feeder(random));
  }
  const auto scores = [&specs] {
    std::vector<double> all;
    for (const feeder::FeederSpec& spec : specs) {
      const Score score = feeder::FeederProblem(spec).score({0, {}});
      all.push_back(score.violation);
      all.insert(all.end(), score.objectives.begin(), score.objectives.end());
    }
    return all;
  };
  const std::vector<double> alone = scores();
  std::vector<std::vector<double>> together(8);
  {
    std::vector<std::jthread> threads;
    for (std::vector<double>& mine : together) threads.emplace_back([&mine, &scores] { mine = scores(); });
  }
  for (const std::vector<double>& mine : together) {
    REQUIRE(mine.size() == alone.size());
    CHECK(std::memcmp(mine.data(), alone.data(), alone.size() * sizeof(double)) == 0);
  }
}
