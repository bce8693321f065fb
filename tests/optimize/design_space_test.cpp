#include "optimize/design_space.hpp"

#include <catch2/catch.hpp>

#include "optimize/executor.hpp"
#include "toy_problem.hpp"

using namespace formotion;

namespace {

class FixedProblem final : public Problem {
 public:
  std::span<const Variable> variables() const override { return variables_; }
  std::span<const Topology> topologies() const override { return topologies_; }
  std::span<const Objective> objectives() const override { return objectives_; }
  Score score(const Candidate&, Memory*) const override { return {true, 0, {1}, {}, std::nullopt, 1}; }

 private:
  std::vector<Variable> variables_{{"a", 2, 2, std::nullopt}, {"b", -3, 5, 4.0}};
  std::vector<Topology> topologies_{{"t", {0, 1}}};
  std::vector<Objective> objectives_{{"o", true, 0, false}};
};

}  // namespace

TEST_CASE("variables with equal bounds are no dimensions, and keep their value") {
  const FixedProblem problem;
  const DesignSpace space(problem, 0);
  REQUIRE(space.dimensions() == 1);
  CHECK(space.at(std::vector<double>{0.25}).values == std::vector<double>{2, -1});
  CHECK(space.at(std::vector<double>{7}).values == std::vector<double>{2, 5});
  CHECK(space.start() == std::vector<double>{0.875});
}

TEST_CASE("spread points fill the unit square evenly: each of 64 cells holds its share of 6,400, within a fifth") {
  const ToyProblem problem;
  const DesignSpace space(problem, 1);
  std::vector<int> cells(64, 0);
  for (std::uint64_t i = 0; i < 6400; ++i) {
    const std::vector<double> p = space.spread_point(i, 3);
    ++cells[static_cast<std::size_t>(static_cast<int>(p[0] * 8) * 8 + static_cast<int>(p[1] * 8))];
  }
  for (const int count : cells) CHECK(std::abs(count - 100) <= 20);
}

TEST_CASE("work in parallel is done once each, for every number of threads, exceptions come through") {
  for (const int threads : {0, 1, 2, 7}) {
    std::vector<std::atomic<int>> done(100);
    run_parallel(100, threads, [&](int i) { ++done[static_cast<std::size_t>(i)]; });
    for (const auto& count : done) REQUIRE(count == 1);
    CHECK_THROWS_AS(run_parallel(50, threads,
                                 [](int i) {
                                   if (i == 20) throw std::runtime_error("piece 20");
                                 }),
                    std::runtime_error);
  }
  run_parallel(0, 2, [](int) { FAIL("nothing to do"); });
}
