#include "optimize/near_pool.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "optimize/random_stream.hpp"

using namespace formotion;

TEST_CASE("the pool holds the best candidate, and no two that are near to each other") {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    RandomStream random(seed, 3, 4);
    NearPool pool(10, 0.15);
    double least = 10;
    for (int i = 1; i <= 500; ++i) {
      const double violation = random.uniform();
      least = std::min(least, violation);
      pool.offer({i, {random.uniform(), random.uniform()}, violation});
    }
    const auto& members = pool.members();
    REQUIRE(members.size() == 10);
    CHECK(members.front().violation == least);
    for (std::size_t a = 0; a < members.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        CHECK(members[b].violation <= members[a].violation);
        const double apart = std::max(std::abs(members[a].unit[0] - members[b].unit[0]),
                                      std::abs(members[a].unit[1] - members[b].unit[1]));
        CHECK(apart >= 0.15);
      }
    }
  }
}

TEST_CASE("without variables the pool holds one candidate") {
  NearPool pool(10, 0.1);
  pool.offer({1, {}, 2});
  pool.offer({2, {}, 1});
  pool.offer({3, {}, 3});
  REQUIRE(pool.members().size() == 1);
  CHECK(pool.members()[0].number == 2);
}
