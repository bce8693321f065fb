#include "optimize/variation.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace formotion;

TEST_CASE("crossing stays within bounds and keeps the parents' middle in the mean") {
  RandomStream random(1, 2, 3);
  for (const auto& [a, b] : {std::pair{0.3, 0.7}, {0.5, 0.50001}, {0.45, 0.6}}) {
    double sum = 0;
    constexpr int kCount = 20000;
    for (int i = 0; i < kCount; ++i) {
      const double child = crossed(a, b, random);
      REQUIRE((child >= 0 && child <= 1));
      sum += (child - 0.5 * (a + b)) / std::abs(a - b);
    }
    CHECK(sum / kCount == Approx(0).margin(0.02));  // five standard deviations and the bounds' pull
  }
  for (const auto& [a, b] : {std::pair{0.0, 1.0}, {0.0, 0.2}, {1.0, 0.999}}) {
    for (int i = 0; i < 2000; ++i) {
      const double child = crossed(a, b, random);
      REQUIRE((child >= 0 && child <= 1));
    }
  }
  CHECK(crossed(0.25, 0.25, random) == 0.25);
}

TEST_CASE("far from the bounds half of the crossed children lie between their parents") {
  RandomStream random(4, 2, 3);
  int between = 0;
  constexpr int kCount = 20000;
  for (int i = 0; i < kCount; ++i) {
    const double child = crossed(0.499, 0.501, random);
    between += child >= 0.499 && child <= 0.501;
  }
  CHECK(static_cast<double>(between) / kCount == Approx(0.5).margin(0.02));
}

TEST_CASE("mutation stays within bounds and follows its distribution") {
  RandomStream random(7, 7, 7);
  for (const double at : {0.0, 1e-9, 0.2, 0.5, 1.0}) {
    int below = 0, near = 0;
    constexpr int kCount = 20000;
    for (int i = 0; i < kCount; ++i) {
      const double child = mutated(at, random);
      REQUIRE((child >= 0 && child <= 1));
      below += child < at;
      near += std::abs(child - at) <= 0.1;
    }
    CAPTURE(at);
    if (at == 0.5) {  // shifts of more than 0.1: (0.9^16 - 0.5^16) / (1 - 0.5^16)
      CHECK(static_cast<double>(near) / kCount == Approx(1 - std::pow(0.9, 16)).margin(0.02));
    }
    if (at > 1e-9 && at < 1) CHECK(static_cast<double>(below) / kCount == Approx(0.5).margin(0.02));
  }
}

TEST_CASE("a step that leaves the bounds ends before them") {
  RandomStream random(9, 9, 9);
  CHECK(stepped(0.25, 0.5, random) == 0.75);
  for (int i = 0; i < 1000; ++i) {
    const double over = stepped(0.75, 0.5, random), under = stepped(0.25, -0.5, random);
    REQUIRE((over >= 0.75 && over <= 1));
    REQUIRE((under >= 0 && under <= 0.25));
  }
}
